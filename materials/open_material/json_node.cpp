#include <algorithm>

#include "core/files.h"
#include "core/json_size.h"
#include "core/spelling.h"
#include "core/text.h"
#include "materials/open_material/json_node_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using nlohmann::json;

// Line and column from 1.
core::Place place_of(const std::string& file, const std::string& text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  const auto line = std::count(text.begin(), end, '\n');
  const auto line_start = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {file, 1 + static_cast<int>(line), 1 + static_cast<int>(end - line_start)};
}

// Before parsing, so that no parser and no destructor sees the text.
void check_size(const std::string& file, const std::string& text) {
  const auto excess = core::json_excess(text, {kMostJsonLevels, kMostJsonValues});
  if (!excess) return;
  const core::Place place = place_of(file, text, excess->offset);
  if (excess->of == core::JsonExcess::Of::levels)
    core::throw_input_error(ErrorClass::limit, place, "nesting",
                            "deeper than " + std::to_string(kMostJsonLevels) + " levels",
                            "at most " + std::to_string(kMostJsonLevels));
  core::throw_input_error(ErrorClass::limit, place, "values",
                          "more than " + std::to_string(kMostJsonValues),
                          "at most " + std::to_string(kMostJsonValues));
}

// As found in the file, short enough for a message.
std::string shown(const json& value) {
  constexpr std::size_t kMostShown = 60;
  if (value.is_structured()) return value.is_array() ? "an array" : "an object";
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  return text.size() > kMostShown ? text.substr(0, kMostShown) + "..." : text;
}

// RFC 6901, section 3.
std::string escaped(const std::string& key) {
  std::string step;
  for (const char c : key.substr(0, 100)) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step += c;
  }
  return step;
}

json parsed(const std::string& text, const std::string& file) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::string words = error.what();
    core::throw_input_error(ErrorClass::parse,
                            place_of(file, text, error.byte > 0 ? error.byte - 1 : 0), "JSON text",
                            words.substr(words.find(']') + 2), "well-formed JSON in UTF-8");
  } catch (const json::exception&) {  // a number that overflows
    core::throw_input_error(ErrorClass::nonfinite, core::Place{file}, "JSON text",
                            "a number out of range", "numbers that a double holds");
  }
}

}  // namespace

std::optional<JsonFile> read_json_file(const std::filesystem::path& path,
                                       std::uint64_t largest_bytes, core::ProblemList& problems) {
  JsonFile file{{}, path.string()};
  try {
    const std::string text = core::read_file(path, largest_bytes);
    check_size(file.name, text);
    file.root = parsed(text, file.name);
    if (!file.root.is_object())
      core::throw_input_error(ErrorClass::parse, core::Place{file.name}, "JSON text",
                              shown(file.root), "an object");
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
  return file;
}

JsonNode::JsonNode(const JsonFile& file, core::ProblemList& problems)
    : file_(&file), problems_(&problems), value_(&file.root) {}

JsonNode::JsonNode(const JsonNode& parent, const json* value, const std::string& step)
    : file_(parent.file_),
      problems_(parent.problems_),
      value_(value != nullptr && value->is_null() ? nullptr : value),
      pointer_(parent.pointer_ + "/" + step) {}

JsonNode JsonNode::member(const std::string& key) const {
  const json* found = nullptr;
  if (present() && !value_->is_object()) {
    error(ErrorClass::parse, "an object");
  } else if (present()) {
    const auto at = value_->find(key);
    if (at != value_->end()) found = &*at;
  }
  return {*this, found, escaped(key)};
}

JsonNode JsonNode::required(const std::string& key) const {
  JsonNode node = member(key);
  if (present() && value_->is_object() && !node.present() && !problems_->is_full())
    problems_->error(ErrorClass::ref, place(), node.pointer_, "missing",
                     "it to be there" + core::names_there_text(key, keys()));
  return node;
}

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> keys;
  if (present() && value_->is_object())
    for (const auto& [key, value] : value_->items()) keys.push_back(key);
  return keys;
}

std::size_t JsonNode::size(std::size_t most) const {
  if (!present()) return 0;
  if (!value_->is_array()) {
    error(ErrorClass::parse, "an array");
    return 0;
  }
  if (value_->size() <= most) return value_->size();
  problems_->error(ErrorClass::limit, place(), pointer_,
                   std::to_string(value_->size()) + " elements", "at most " + std::to_string(most));
  return 0;
}

JsonNode JsonNode::element(std::size_t index) const {
  return {*this, &(*value_)[index], std::to_string(index)};
}

std::optional<double> JsonNode::number(const core::NumberRange& range) const {
  if (!present()) return std::nullopt;
  if (!value_->is_number()) {
    error(ErrorClass::parse, "a number, " + core::to_string(range));
    return std::nullopt;
  }
  const double number = value_->get<double>();
  if (number > range.high || number < range.low || (range.above_low && number == range.low)) {
    error(ErrorClass::range, core::to_string(range));
    return std::nullopt;
  }
  return number;
}

std::optional<std::string> JsonNode::text() const {
  if (!present()) return std::nullopt;
  if (!value_->is_string()) {
    error(ErrorClass::parse, "a text in quotes");
    return std::nullopt;
  }
  auto text = value_->get<std::string>();
  if (core::is_printable_text(text)) return text;
  error(ErrorClass::range, "a text without control characters");
  return std::nullopt;
}

std::vector<double> JsonNode::numbers(const core::NumberRange& range, std::size_t most) const {
  std::vector<double> numbers;
  const std::size_t count = size(most);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode node = element(i);
    if (!node.present())
      problems_->error(ErrorClass::parse, place(), node.pointer_, "null", "a number");
    if (const auto number = node.number(range)) numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::string> JsonNode::texts(std::size_t most) const {
  std::vector<std::string> texts;
  const std::size_t count = size(most);
  for (std::size_t i = 0; i < count; ++i)
    if (const auto text = element(i).text()) texts.push_back(*text);
  return texts;
}

void JsonNode::error(ErrorClass error_class, const std::string& expected) const {
  problems_->error(error_class, place(), pointer_, shown(*value_), expected);
}

}  // namespace fanbeam::materials
