#include <algorithm>
#include <cmath>

#include "core/spelling.h"
#include "core/text.h"
#include "scenes/json_reader_private.h"

namespace fanbeam::scenes {

using core::ErrorClass;
using nlohmann::json;

void JsonReader::error(ErrorClass kind, const std::string& path, const std::string& value,
                       const std::string& expected) {
  problems_.error(kind, place_, path, value, expected);
}

std::string JsonReader::joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string JsonReader::entry(const std::string& path, const char* key, std::size_t index) {
  return joined(path, key) + "[" + std::to_string(index) + "]";
}

std::string JsonReader::shown(const json& value) {
  constexpr std::size_t kMostShown = 40;
  return value.is_structured() ? value.type_name() : value.dump().substr(0, kMostShown);
}

const json* JsonReader::member(const json& owner, const std::string& path, const char* key) {
  if (!owner.is_object()) {
    error(ErrorClass::parse, path, owner.type_name(), "an object");
    return nullptr;
  }
  const auto found = owner.find(key);
  if (found != owner.end()) return &*found;
  if (problems_.is_full()) return nullptr;
  std::vector<std::string> there;
  for (const auto& [name, value] : owner.items()) there.push_back(name);
  error(ErrorClass::parse, joined(path, key), "nothing",
        "a value" + core::names_there_text(key, there));
  return nullptr;
}

double JsonReader::number(const json* value, const std::string& path, double least, double most) {
  if (value == nullptr) return least;
  if (!value->is_number()) {
    error(ErrorClass::parse, path, shown(*value), "a number");
    return least;
  }
  const double result = value->get<double>();
  if (!std::isfinite(result)) {
    error(ErrorClass::nonfinite, path, core::number_text(result), "a finite number");
    return least;
  }
  if (result < least || result > most)
    error(ErrorClass::range, path, core::number_text(result),
          core::number_text(least) + " to " + core::number_text(most));
  return std::clamp(result, least, most);
}

double JsonReader::number(const json& owner, const std::string& path, const char* key, double least,
                          double most) {
  return number(member(owner, path, key), joined(path, key), least, most);
}

int JsonReader::whole(const json& owner, const std::string& path, const char* key, int least,
                      int most) {
  const double result = number(owner, path, key, least, most);
  if (result != std::floor(result))
    error(ErrorClass::range, joined(path, key), core::number_text(result),
          "a whole number, " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(result);
}

bool JsonReader::flag(const json& value, const std::string& path) {
  if (value.is_boolean()) return value.get<bool>();
  error(ErrorClass::parse, path, shown(value), "true or false");
  return false;
}

std::string JsonReader::text(const json& owner, const std::string& path, const char* key) {
  const json* value = member(owner, path, key);
  if (value == nullptr) return {};
  if (!value->is_string()) {
    error(ErrorClass::parse, joined(path, key), shown(*value), "a text");
    return {};
  }
  auto text = value->get<std::string>();
  if (core::is_printable_text(text)) return text;
  error(ErrorClass::range, joined(path, key), shown(*value), "a text without control characters");
  return {};
}

const json& JsonReader::list(const json& owner, const std::string& path, const char* key) {
  static const json kEmpty = json::array();
  const json* value = member(owner, path, key);
  if (value == nullptr) return kEmpty;
  if (!value->is_array()) {
    error(ErrorClass::parse, joined(path, key), value->type_name(), "a list");
    return kEmpty;
  }
  if (value->size() <= kMostEntries) return *value;
  error(ErrorClass::limit, joined(path, key), std::to_string(value->size()),
        "at most " + std::to_string(kMostEntries) + " entries");
  return kEmpty;
}

std::array<double, 2> JsonReader::forward_right(const json& owner, const std::string& path,
                                                const char* key) {
  const json& pair = list(owner, path, key);
  if (pair.size() != 2) {
    error(ErrorClass::parse, joined(path, key), std::to_string(pair.size()) + " entries",
          "two numbers");
    return {};
  }
  return {number(&pair[0], joined(path, key) + "[0]", -kMost, kMost),
          -number(&pair[1], joined(path, key) + "[1]", -kMost, kMost)};
}

}  // namespace fanbeam::scenes
