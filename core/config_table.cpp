#include "core/config_table.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/files.h"
#include "core/spelling.h"
#include "core/toml_nesting.h"

namespace fanbeam::core {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 4U << 20U;
constexpr int kDeepestNesting = 64;

Place place_of(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::string value_text(const toml::node& node) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  node.visit([&](const auto& value) {
    if constexpr (toml::is_table<decltype(value)>) {
      stream << "a table";
    } else if constexpr (toml::is_array<decltype(value)>) {
      stream << "an array of " << value.size();
    } else if constexpr (toml::is_string<decltype(value)>) {
      stream << '"' << value.get().substr(0, 200) << '"';
    } else if constexpr (toml::is_floating_point<decltype(value)>) {
      stream << number_text(value.get());
    } else {
      stream << std::boolalpha << value.get();
    }
  });
  return stream.str();
}

bool holds(const NumberRange& range, double value) {
  return value >= range.low && value <= range.high && !(range.above_low && value == range.low);
}

// The likely meant key, or the ones that look most like it.
std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kLikelyMistyped = 3;  // edits
  constexpr std::size_t kMostNames = 5;
  const std::vector<std::string> nearest = nearest_names(name, known, kMostNames);
  if (nearest.empty()) return "";
  if (edit_distance(name.substr(0, 100), nearest.front()) <= kLikelyMistyped)
    return ", perhaps \"" + nearest.front() + "\"";
  std::string names;
  for (const std::string& each : nearest)
    names += (names.empty() ? ", such as \"" : "\", \"") + each;
  return names + "\"";
}

}  // namespace

struct ConfigTable::Document {
  toml::table root;
  std::string file;
  ProblemList* problems = nullptr;
  std::map<const void*, std::set<std::string, std::less<>>>
      asked;  // per table: keys that exist or could
  ResolvedConfig resolved;

  void report_unknown(const toml::table& table, const std::string& prefix);
};

std::string to_string(const NumberRange& range) {
  const bool has_low = range.low > -std::numeric_limits<double>::max();
  const bool has_high = range.high < std::numeric_limits<double>::max();
  if (!has_low && !has_high) return "a finite number";
  if (range.above_low)
    return "above " + number_text(range.low) +
           (has_high ? ", at most " + number_text(range.high) : "");
  if (!has_high) return "at least " + number_text(range.low);
  if (!has_low) return "at most " + number_text(range.high);
  return number_text(range.low) + " to " + number_text(range.high);
}

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

const void* ConfigTable::find(std::string_view key) {
  document_->asked[table_].insert(std::string(key));
  return table_ == nullptr ? nullptr : static_cast<const toml::table*>(table_)->get(key);
}

template <class T>
void ConfigTable::record(std::string_view key, T value) {
  document_->resolved.emplace_back(path(key), ConfigValue(std::move(value)));
}

bool ConfigTable::has(std::string_view key) const {
  return table_ != nullptr && static_cast<const toml::table*>(table_)->contains(key);
}

bool ConfigTable::is_text(std::string_view key) const {
  return has(key) && static_cast<const toml::table*>(table_)->get(key)->is_string();
}

std::optional<double> ConfigTable::checked_number(std::string_view key, NumberRange range) {
  const auto* node = static_cast<const toml::node*>(find(key));
  if (node == nullptr) return std::nullopt;
  if (!node->is_number()) {
    error(ErrorClass::parse, key, value_text(*node), "a number, " + to_string(range));
    return std::nullopt;
  }
  const double value = node->is_integer() ? static_cast<double>(node->as_integer()->get())
                                          : node->as_floating_point()->get();
  if (!std::isfinite(value)) {
    error(ErrorClass::nonfinite, key, number_text(value), to_string(range));
    return std::nullopt;
  }
  if (!holds(range, value)) {
    error(ErrorClass::range, key, number_text(value), to_string(range));
    return std::nullopt;
  }
  return value;
}

double ConfigTable::number(std::string_view key, NumberRange range, double fallback) {
  const double value = checked_number(key, range).value_or(fallback);
  record(key, value);
  return value;
}

std::optional<double> ConfigTable::optional_number(std::string_view key, NumberRange range) {
  const std::optional<double> value = checked_number(key, range);
  if (value) record(key, *value);
  return value;
}

double ConfigTable::required_number(std::string_view key, NumberRange range) {
  if (!has(key)) error(ErrorClass::ref, key, "missing", to_string(range));
  const double low = range.low > -std::numeric_limits<double>::max() ? range.low : 0.0;
  return number(key, range, low);
}

std::int64_t ConfigTable::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                  std::int64_t fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  const std::string expected =
      "a whole number, " + std::to_string(low) + " to " + std::to_string(high);
  std::int64_t value = fallback;
  if (node != nullptr && !node->is_integer()) {
    error(ErrorClass::parse, key, value_text(*node), expected);
  } else if (node != nullptr &&
             (node->as_integer()->get() < low || node->as_integer()->get() > high)) {
    error(ErrorClass::range, key, value_text(*node), expected);
  } else if (node != nullptr) {
    value = node->as_integer()->get();
  }
  record(key, static_cast<double>(value));
  return value;
}

bool ConfigTable::boolean(std::string_view key, bool fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  bool value = fallback;
  if (node != nullptr && !node->is_boolean()) {
    error(ErrorClass::parse, key, value_text(*node), "true or false");
  } else if (node != nullptr) {
    value = node->as_boolean()->get();
  }
  record(key, value);
  return value;
}

std::optional<std::string> ConfigTable::optional_text(std::string_view key) {
  const auto* node = static_cast<const toml::node*>(find(key));
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) {
    error(ErrorClass::parse, key, value_text(*node), "a text in quotes");
    return std::nullopt;
  }
  record(key, node->as_string()->get());
  return node->as_string()->get();
}

std::string ConfigTable::text(std::string_view key, std::string_view fallback) {
  const std::optional<std::string> value = optional_text(key);
  if (!value) record(key, std::string(fallback));
  return value.value_or(std::string(fallback));
}

std::string ConfigTable::required_text(std::string_view key) {
  if (!has(key)) error(ErrorClass::ref, key, "missing", "a text in quotes");
  return optional_text(key).value_or("");
}

std::size_t ConfigTable::choice(std::string_view key, std::initializer_list<std::string_view> names,
                                std::size_t fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::size_t index = fallback;
  if (node != nullptr) {
    const std::string value = node->is_string() ? node->as_string()->get() : "";
    const auto* const found = std::find(names.begin(), names.end(), value);
    if (found != names.end()) {
      index = static_cast<std::size_t>(found - names.begin());
    } else {
      std::string list;
      for (const std::string_view name : names)
        list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
      error(node->is_string() ? ErrorClass::range : ErrorClass::parse, key, value_text(*node),
            "one of " + list);
    }
  }
  record(key, std::string(names.begin()[index]));
  return index;
}

std::vector<double> ConfigTable::numbers(std::string_view key, NumberRange range,
                                         std::size_t fewest, std::size_t most) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::vector<double> values;
  if (node == nullptr) return values;
  const std::string expected =
      (fewest == most ? std::to_string(fewest)
                      : std::to_string(fewest) + " to " + std::to_string(most)) +
      " numbers, each " + to_string(range);
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() < fewest || array->size() > most) {
    error(array == nullptr ? ErrorClass::parse : ErrorClass::range, key, value_text(*node),
          expected);
    return values;
  }
  for (const toml::node& element : *array) {
    const std::optional<double> value =
        element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || !holds(range, *value)) {
      const bool nonfinite = value && !std::isfinite(*value);
      document_->problems->error(!value      ? ErrorClass::parse
                                 : nonfinite ? ErrorClass::nonfinite
                                             : ErrorClass::range,
                                 place_of(element.source(), document_->file), path(key),
                                 value_text(element), expected);
      return {};
    }
    values.push_back(*value);
    record(std::string(key) + "[" + std::to_string(values.size() - 1) + "]", *value);
  }
  return values;
}

std::vector<std::string> ConfigTable::texts(std::string_view key) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::vector<std::string> values;
  if (node == nullptr) return values;
  const toml::array* array = node->as_array();
  const bool all_text = array != nullptr &&
                        std::all_of(array->begin(), array->end(),
                                    [](const toml::node& element) { return element.is_string(); });
  if (!all_text) {
    error(ErrorClass::parse, key, value_text(*node), "an array of texts");
    return values;
  }
  for (const toml::node& element : *array) {
    values.push_back(element.as_string()->get());
    record(std::string(key) + "[" + std::to_string(values.size() - 1) + "]", values.back());
  }
  return values;
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

ProblemList& ConfigTable::problems() { return *document_->problems; }

void ConfigTable::Document::report_unknown(const toml::table& table, const std::string& prefix) {
  const auto& known = asked[&table];
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (!known.contains(name)) {
      if (problems->is_full()) return;
      problems->error(ErrorClass::ref, place_of(key.source(), file), prefix + name, "unknown key",
                      "a key of this table" + suggestion(name, {known.begin(), known.end()}));
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

const ResolvedConfig& ConfigTable::resolved() const { return document_->resolved; }

}  // namespace fanbeam::core
