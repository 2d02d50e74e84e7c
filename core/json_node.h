// A JSON file read member by member, with every wrong type and value reported under its JSON
// pointer (RFC 6901). The one reader of JSON input; glTF has its own rules (terrain/gltf/).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/json_size.h"
#include "core/number_range.h"

namespace fanbeam::core {

struct JsonFile {
  std::shared_ptr<const void> root;  // an object of the library that parses
  std::string name;
};

// Nothing after reporting: E-LIMIT (levels of nesting, values), E-PARSE with line and column (of a zero byte too,
// behind the value as before it), E-PARSE for a name that is twice in one object, E-NONFINITE (a number beyond double).
std::optional<JsonFile> parse_json(const std::string& text, const std::string& name,
                                   const JsonLimits& limits, ProblemList& problems);
// The same of a file: also E-IO, and E-LIMIT above `largest_bytes`.
std::optional<JsonFile> read_json_file(const std::filesystem::path& path,
                                       std::uint64_t largest_bytes, const JsonLimits& limits,
                                       ProblemList& problems);

// One value of the file, or a place where one is missing (a JSON null counts as missing). Answers
// about a missing one are empty and say nothing. Neither outlives the JsonFile.
class JsonNode {
 public:
  JsonNode(const JsonFile& file, ProblemList& problems);

  bool present() const { return value_ != nullptr; }
  bool is_object() const;
  bool is_array() const;
  const std::string& pointer() const { return pointer_; }
  Place place() const { return {file_->name}; }

  // E-PARSE when this is no object; required also E-REF when the member is missing, or null, which is told apart.
  JsonNode member(const std::string& key) const;
  JsonNode required(const std::string& key) const;
  std::vector<std::string> keys() const;

  // E-PARSE when this is no array, E-LIMIT above `most` elements: then it counts as empty.
  std::size_t size(std::size_t most) const;
  std::size_t elements() const;               // 0 where this is no array; says nothing
  JsonNode element(std::size_t index) const;  // missing where there are not so many

  // E-PARSE for another type, E-RANGE outside.
  std::optional<double> number(const NumberRange& range) const;
  std::optional<int> whole(int low, int high) const;  // E-RANGE also for a fraction
  std::optional<bool> flag() const;
  std::optional<std::string> text() const;  // E-RANGE also for control characters
  std::optional<std::string> any_text() const;
  std::vector<double> numbers(const NumberRange& range, std::size_t most) const;
  std::vector<std::string> texts(std::size_t most) const;
  // The value as JSON on one line, members sorted by name; "null" where it is missing. Says nothing.
  std::string dumped() const;

  // Reports the value as it stands in the file, or as missing.
  void error(ErrorClass error_class, const std::string& expected) const;
  ProblemList& problems() const { return *problems_; }

 private:
  JsonNode(const JsonNode& parent, const void* value, const std::string& step);

  const JsonFile* file_;
  ProblemList* problems_;
  const void* value_;  // of the library that parses, which stays in the source
  std::string pointer_;
};

// E-REF for each member of an object that is not among those known, with those like it.
void check_keys(const JsonNode& node, const std::vector<const char*>& known);

}  // namespace fanbeam::core
