#include "core/json_node.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/files.h"
#include "core/spelling.h"
#include "core/text.h"

namespace fanbeam::core {
namespace {

using nlohmann::json;

// Line and column from 1.
Place place_of(const std::string& file, const std::string& text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  const auto line = std::count(text.begin(), end, '\n');
  const auto line_start = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {file, 1 + static_cast<int>(line), 1 + static_cast<int>(end - line_start)};
}

// Before parsing, so that no parser and no destructor sees the text.
void check_size(const std::string& file, const std::string& text, const JsonLimits& limits) {
  const auto excess = json_excess(text, limits);
  if (!excess) return;
  const bool deep = excess->of == JsonExcess::Of::levels;
  const std::string most =
      std::to_string(deep ? static_cast<std::size_t>(limits.levels) : limits.values);
  throw_input_error(
      ErrorClass::limit, place_of(file, text, excess->offset), deep ? "nesting" : "values",
      deep ? "deeper than " + most + " levels" : "more than " + most, "at most " + most);
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

const json& of(const void* value) { return *static_cast<const json*>(value); }

// The tree of a text, as its parser comes upon the values. Which of two members of one name counts is not said
// (RFC 8259, section 4): neither does. (A callback of json::parse would tell the names too, but goes through all of
// a list again for each object in it.)
class Tree : public json::json_sax_t {
 public:
  explicit Tree(std::string file, const std::string& text) : file_(std::move(file)), text_(text) {}

  json& root() { return root_; }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(json::number_integer_t value) override { return put(value); }
  bool number_unsigned(json::number_unsigned_t value) override { return put(value); }
  bool number_float(json::number_float_t value, const std::string&) override { return put(value); }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(json::binary_t& value) override { return put(std::move(value)); }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    const auto [member, first] = open_.back()->get_ref<json::object_t&>().try_emplace(name);
    if (!first)
      throw_input_error(ErrorClass::parse, Place{file_}, "JSON text",
                        shown(name) + " twice in one object", "every name once");
    member_ = &member->second;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const json::exception& error) override {
    if (dynamic_cast<const json::parse_error*>(&error) == nullptr)  // a number that overflows
      throw_input_error(ErrorClass::nonfinite, Place{file_}, "JSON text", "a number out of range",
                        "numbers that a double holds");
    const std::size_t byte = static_cast<const json::parse_error&>(error).byte;
    const std::string words = error.what();
    throw_input_error(ErrorClass::parse, place_of(file_, text_, byte > 0 ? byte - 1 : 0),
                      "JSON text", words.substr(words.find(']') + 2), "well-formed JSON in UTF-8");
  }

 private:
  bool put(json value) {
    placed(std::move(value));
    return true;
  }
  bool open(json value) {
    open_.push_back(placed(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  json* placed(json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    if (open_.back()->is_object()) return &(*member_ = std::move(value));
    open_.back()->push_back(std::move(value));
    return &open_.back()->back();
  }

  std::string file_;
  const std::string& text_;
  json root_;
  std::vector<json*> open_;  // objects and lists around the next value
  json* member_ = nullptr;   // of an object, whose value comes next
};

json parsed(const std::string& text, const std::string& file) {
  // The parser would take it for the end of the text, whatever stands behind it.
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
    throw_input_error(ErrorClass::parse, place_of(file, text, zero), "JSON text", "a zero byte",
                      "well-formed JSON in UTF-8");
  Tree tree(file, text);
  json::sax_parse(text, &tree);
  return std::move(tree.root());
}

}  // namespace

std::optional<JsonFile> parse_json(const std::string& text, const std::string& name,
                                   const JsonLimits& limits, ProblemList& problems) {
  try {
    check_size(name, text, limits);
    json root = parsed(text, name);
    if (!root.is_object())
      throw_input_error(ErrorClass::parse, Place{name}, "JSON text", shown(root), "an object");
    return JsonFile{std::make_shared<const json>(std::move(root)), name};
  } catch (const InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
}

std::optional<JsonFile> read_json_file(const std::filesystem::path& path,
                                       std::uint64_t largest_bytes, const JsonLimits& limits,
                                       ProblemList& problems) {
  std::string text;
  try {
    text = read_file(path, largest_bytes);
  } catch (const InputError& error) {
    problems.append(error.problems());
    return std::nullopt;
  }
  return parse_json(text, path.string(), limits, problems);
}

JsonNode::JsonNode(const JsonFile& file, ProblemList& problems)
    : file_(&file), problems_(&problems), value_(file.root.get()) {}

JsonNode::JsonNode(const JsonNode& parent, const void* value, const std::string& step)
    : file_(parent.file_),
      problems_(parent.problems_),
      value_(value != nullptr && of(value).is_null() ? nullptr : value),
      pointer_(parent.pointer_ + "/" + step) {}

bool JsonNode::is_object() const { return present() && of(value_).is_object(); }

bool JsonNode::is_array() const { return present() && of(value_).is_array(); }

JsonNode JsonNode::member(const std::string& key) const {
  const json* found = nullptr;
  if (present() && !of(value_).is_object()) {
    error(ErrorClass::parse, "an object");
  } else if (present()) {
    const auto at = of(value_).find(key);
    if (at != of(value_).end()) found = &*at;
  }
  return {*this, found, escaped(key)};
}

JsonNode JsonNode::required(const std::string& key) const {
  JsonNode node = member(key);
  if (!is_object() || node.present() || problems_->is_full()) return node;
  const bool null = of(value_).contains(key);
  // No likely one of those there, which may all be right: check_keys tells one that is misspelt.
  problems_->error(ErrorClass::ref, place(), node.pointer_, null ? "null" : "missing",
                   null ? "a value" : "it to be there" + names_there_text("", keys()));
  return node;
}

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> keys;
  if (is_object())
    for (const auto& [key, value] : of(value_).items()) keys.push_back(key);
  return keys;
}

void check_keys(const JsonNode& node, const std::vector<const char*>& known) {
  for (const std::string& key : node.keys()) {
    if (std::find(known.begin(), known.end(), key) != known.end() || node.problems().is_full())
      continue;
    node.problems().error(
        ErrorClass::ref, node.place(), node.pointer() + "/" + key, "unknown",
        "a member of the format" + names_there_text(key, {known.begin(), known.end()}));
  }
}

std::size_t JsonNode::size(std::size_t most) const {
  if (!present()) return 0;
  if (!of(value_).is_array()) {
    error(ErrorClass::parse, "an array");
    return 0;
  }
  if (of(value_).size() <= most) return of(value_).size();
  problems_->error(ErrorClass::limit, place(), pointer_,
                   std::to_string(of(value_).size()) + " elements",
                   "at most " + std::to_string(most));
  return 0;
}

std::size_t JsonNode::elements() const { return is_array() ? of(value_).size() : 0; }

JsonNode JsonNode::element(std::size_t index) const {
  return {*this, index < elements() ? &of(value_)[index] : nullptr, std::to_string(index)};
}

std::optional<double> JsonNode::number(const NumberRange& range) const {
  if (!present()) return std::nullopt;
  if (!of(value_).is_number()) {
    error(ErrorClass::parse, "a number, " + to_string(range));
    return std::nullopt;
  }
  const double number = of(value_).get<double>();
  if (number > range.high || number < range.low || (range.above_low && number == range.low)) {
    error(ErrorClass::range, to_string(range));
    return std::nullopt;
  }
  return number;
}

std::optional<int> JsonNode::whole(int low, int high) const {
  const auto number = this->number({static_cast<double>(low), static_cast<double>(high)});
  if (!number) return std::nullopt;
  if (*number == std::floor(*number)) return static_cast<int>(*number);
  error(ErrorClass::range,
        "a whole number, " + std::to_string(low) + " to " + std::to_string(high));
  return std::nullopt;
}

std::optional<bool> JsonNode::flag() const {
  if (!present()) return std::nullopt;
  if (of(value_).is_boolean()) return of(value_).get<bool>();
  error(ErrorClass::parse, "true or false");
  return std::nullopt;
}

std::optional<std::string> JsonNode::any_text() const {
  if (!present()) return std::nullopt;
  if (of(value_).is_string()) return of(value_).get<std::string>();
  error(ErrorClass::parse, "a text in quotes");
  return std::nullopt;
}

std::optional<std::string> JsonNode::text() const {
  std::optional<std::string> text = any_text();
  if (!text || is_printable_text(*text)) return text;
  error(ErrorClass::range, "a text without control characters");
  return std::nullopt;
}

std::vector<double> JsonNode::numbers(const NumberRange& range, std::size_t most) const {
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

std::string JsonNode::dumped() const {
  return present() ? of(value_).dump(-1, ' ', false, json::error_handler_t::replace) : "null";
}

void JsonNode::error(ErrorClass error_class, const std::string& expected) const {
  problems_->error(error_class, place(), pointer_, present() ? shown(of(value_)) : "nothing",
                   expected);
}

}  // namespace fanbeam::core
