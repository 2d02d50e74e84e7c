// A JSON file read member by member, with every wrong type and value reported under its JSON
// pointer (RFC 6901). Private: carries nlohmann-json's type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"

namespace fanbeam::materials {

struct JsonFile {
  nlohmann::json root;  // an object
  std::string name;
};

inline constexpr int kMostJsonLevels = 32;
inline constexpr std::size_t kMostJsonValues = 4'000'000;

// Nothing after reporting: E-IO, E-LIMIT (bytes, levels of nesting, values), E-PARSE with line and column,
// E-NONFINITE (a number beyond double).
std::optional<JsonFile> read_json_file(const std::filesystem::path& path,
                                       std::uint64_t largest_bytes, core::ProblemList& problems);

// One value of the file, or a place where one is missing (a JSON null counts as missing). Answers
// about a missing one are empty and say nothing.
class JsonNode {
 public:
  JsonNode(const JsonFile& file, core::ProblemList& problems);

  bool present() const { return value_ != nullptr; }
  const nlohmann::json& value() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  core::Place place() const { return {file_->name}; }

  // E-PARSE when this is no object; required also E-REF when the member is missing.
  JsonNode member(const std::string& key) const;
  JsonNode required(const std::string& key) const;
  std::vector<std::string> keys() const;

  // E-PARSE when this is no array, E-LIMIT above `most` elements: then it counts as empty.
  std::size_t size(std::size_t most) const;
  JsonNode element(std::size_t index) const;

  // E-PARSE for another type, E-RANGE outside.
  std::optional<double> number(const core::NumberRange& range) const;
  std::optional<std::string> text() const;
  std::vector<double> numbers(const core::NumberRange& range, std::size_t most) const;
  std::vector<std::string> texts(std::size_t most) const;

  // Reports the value as it stands in the file.
  void error(core::ErrorClass error_class, const std::string& expected) const;
  core::ProblemList& problems() const { return *problems_; }

 private:
  JsonNode(const JsonNode& parent, const nlohmann::json* value, const std::string& step);

  const JsonFile* file_;
  core::ProblemList* problems_;
  const nlohmann::json* value_;
  std::string pointer_;
};

}  // namespace fanbeam::materials
