#include <algorithm>
#include <charconv>

#include "core/config_document_private.h"
#include "core/files.h"
#include "core/spelling.h"
#include "core/toml_nesting.h"

namespace fanbeam::core {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 4U << 20U;
constexpr int kDeepestNesting = 64;

// The likely meant key, or the ones that look most like it, of those that the table lacks.
std::string suggestion(const std::string& name, std::vector<std::string> known,
                       const toml::table& table) {
  constexpr std::size_t kLikelyMistyped = 3;  // edits
  constexpr std::size_t kMostNames = 5;
  std::erase_if(known, [&](const std::string& key) { return table.contains(key); });
  const std::vector<std::string> nearest = nearest_names(name, known, kMostNames);
  if (nearest.empty()) return "";
  if (edit_distance(name.substr(0, 100), nearest.front()) <= kLikelyMistyped)
    return ", perhaps \"" + nearest.front() + "\"";
  std::string names;
  for (const std::string& each : nearest)
    names += (names.empty() ? ", such as \"" : "\", \"") + each;
  return names + "\"";
}

// Of the key at the end of "box[0].wall", or of the element that the path ends in. Keys may hold points and brackets.
const toml::source_region* region_at(const toml::table& table, std::string_view path) {
  for (const auto& [key, node] : table) {
    if (!path.starts_with(key.str())) continue;
    std::string_view rest = path.substr(key.str().size());
    if (rest.empty()) return &key.source();
    const toml::node* inner = &node;
    if (rest.front() == '[' && node.is_array()) {
      std::size_t index = 0;
      const char* const last = rest.data() + rest.size();
      const char* const end = std::from_chars(rest.data() + 1, last, index).ptr;
      if (end == rest.data() + 1 || end == last || *end != ']') continue;
      inner = node.as_array()->get(index);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.data()) + 1);
      if (inner == nullptr) continue;
      if (rest.empty()) return &inner->source();
    }
    if (!inner->is_table() || rest.front() != '.') continue;
    if (const auto* region = region_at(*inner->as_table(), rest.substr(1))) return region;
  }
  return nullptr;
}

}  // namespace

ConfigTable ConfigTable::from_file(const std::filesystem::path& file, ProblemList& problems) {
  try {
    return from_text(read_file(file, kLargestFile_bytes), file.string(), problems);
  } catch (const InputError& error) {
    problems.append(error.problems());
    ConfigTable empty = from_text("", file.string(), problems);
    empty.present_ = false;
    return empty;
  }
}

ConfigTable ConfigTable::from_text(std::string_view text, const std::string& file_name,
                                   ProblemList& problems) {
  ConfigTable table;
  table.document_ = std::make_shared<Document>();
  table.document_->file = file_name;
  table.document_->problems = &problems;
  table.table_ = &table.document_->root;
  if (const std::optional<TextPlace> deep = nested_deeper_than(text, kDeepestNesting)) {
    problems.error(ErrorClass::limit, {file_name, deep->line, deep->column}, "nesting",
                   "more than " + std::to_string(kDeepestNesting) + " levels",
                   "at most " + std::to_string(kDeepestNesting) + " levels");
    return table;
  }
  try {
    table.document_->root = toml::parse(text, file_name);
    table.present_ = true;
  } catch (const toml::parse_error& error) {
    problems.error(ErrorClass::parse, place_of(error.source(), file_name), "syntax",
                   std::string(error.description()), "TOML");
  }
  return table;
}

const void* ConfigTable::find(std::string_view key) const {
  document_->asked[table_].insert(std::string(key));
  return table_ == nullptr ? nullptr : static_cast<const toml::table*>(table_)->get(key);
}

bool ConfigTable::has(std::string_view key) const { return find(key) != nullptr; }

bool ConfigTable::is_text(std::string_view key) const {
  return has(key) && static_cast<const toml::table*>(table_)->get(key)->is_string();
}

bool ConfigTable::is_table(std::string_view key) const {
  return has(key) && static_cast<const toml::table*>(table_)->get(key)->is_table();
}

ConfigTable ConfigTable::table(std::string_view key) {
  const auto* node = static_cast<const toml::node*>(find(key));
  ConfigTable child;
  child.document_ = document_;
  child.prefix_ = path(key) + ".";
  child.nearby_ = place(key);
  if (node != nullptr && !node->is_table())
    error(ErrorClass::parse, key, value_text(*node), "a table");
  if (node != nullptr && node->is_table()) {
    child.table_ = node->as_table();
    child.present_ = true;
  }
  return child;
}

std::vector<ConfigTable> ConfigTable::tables(std::string_view key, std::size_t most) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::vector<ConfigTable> children;
  if (node == nullptr) return children;
  const toml::array* array = node->as_array();
  if (array == nullptr || !std::all_of(array->begin(), array->end(),
                                       [](const toml::node& e) { return e.is_table(); })) {
    error(ErrorClass::parse, key, value_text(*node),
          "an array of tables, [[" + std::string(key) + "]]");
    return children;
  }
  if (array->size() > most) {
    error(ErrorClass::limit, key, value_text(*node), "at most " + std::to_string(most) + " tables");
    return children;
  }
  for (const toml::node& element : *array) {
    ConfigTable child;
    child.document_ = document_;
    child.prefix_ = path(key) + "[" + std::to_string(children.size()) + "].";
    child.table_ = element.as_table();
    child.present_ = true;
    children.push_back(std::move(child));
  }
  return children;
}

std::vector<std::string> ConfigTable::keys() const {
  std::vector<std::pair<std::pair<toml::source_index, toml::source_index>, std::string>> ordered;
  if (table_ == nullptr) return {};
  for (const auto& [key, node] : *static_cast<const toml::table*>(table_))
    ordered.push_back(
        {{key.source().begin.line, key.source().begin.column}, std::string(key.str())});
  std::sort(ordered.begin(), ordered.end());
  std::vector<std::string> names;
  for (auto& entry : ordered) names.push_back(std::move(entry.second));
  return names;
}

std::string ConfigTable::path(std::string_view key) const {
  if (key.empty())
    return prefix_.substr(0, prefix_.empty() ? 0 : prefix_.size() - 1);  // without the point
  return prefix_ + std::string(key);
}

Place ConfigTable::place(std::string_view key) const {
  if (table_ == nullptr) return nearby_;
  const auto* table = static_cast<const toml::table*>(table_);
  const auto entry = table->find(key);
  if (entry != table->end()) return place_of(entry->first.source(), document_->file);
  return table->source().begin ? place_of(table->source(), document_->file)
                               : Place{document_->file};
}

void ConfigTable::error(ErrorClass error_class, std::string_view key, std::string value,
                        std::string expected) {
  document_->problems->error(error_class, place(key), path(key), std::move(value),
                             std::move(expected));
}

void ConfigTable::warning(std::string_view name, std::string_view key, std::string value,
                          std::string done) {
  document_->problems->warning(name, place(key), path(key), std::move(value), std::move(done));
}

void ConfigTable::only_with(std::span<const std::string_view> keys, const std::string& other) {
  for (const std::string_view key : keys)
    if (has(key))
      error(ErrorClass::ref, key, value_text(*static_cast<const toml::node*>(find(key))),
            "no such key without " + other);
}

ProblemList& ConfigTable::problems() { return *document_->problems; }

void ConfigTable::Document::report_unknown(const toml::table& table, const std::string& prefix) {
  const auto& known = asked[&table];
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (!known.contains(name)) {
      if (problems->is_full()) return;
      problems->error(
          ErrorClass::ref, place_of(key.source(), file), prefix + name, "unknown key",
          "a key of this table" + suggestion(name, {known.begin(), known.end()}, table));
      continue;
    }
    if (const toml::table* child = node.as_table(); child != nullptr && asked.contains(child))
      report_unknown(*child, prefix + name + ".");
    if (const toml::array* array = node.as_array()) {
      for (std::size_t i = 0; i < array->size(); ++i)
        if (const toml::table* child = (*array)[i].as_table();
            child != nullptr && asked.contains(child))
          report_unknown(*child, prefix + name + "[" + std::to_string(i) + "].");
    }
  }
}

void ConfigTable::report_unknown_keys() { document_->report_unknown(document_->root, ""); }

KeyPlaces ConfigTable::key_places() const {
  return [document = document_](std::string_view path) -> std::optional<Place> {
    const toml::source_region* const region = region_at(document->root, path);
    if (region == nullptr) return std::nullopt;
    return place_of(*region, document->file);
  };
}

const ResolvedConfig& ConfigTable::resolved() const { return document_->resolved; }

}  // namespace fanbeam::core
