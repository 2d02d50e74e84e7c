// How deep and how long a JSON text is, found without parsing it: parsers and the destructors of
// their trees recurse, and every value costs them up to some hundred bytes, so both must be refused
// before they see the text.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace fanbeam::core {

struct JsonLimits {
  int levels = 64;
  std::size_t values = 1'000'000;
};

struct JsonExcess {
  enum class Of { levels, values };
  Of of = Of::levels;
  std::size_t offset = 0;  // of the first byte that is too much
};

// Where open brackets and braces first exceed `limits.levels`, or beginnings of objects, lists and
// further members `limits.values` (there is at most one value more than that). What stands in
// strings does not count. Exact on valid JSON, and on invalid text up to its first error, where a
// parser stops anyway. One pass, no memory.
std::optional<JsonExcess> json_excess(std::string_view json, const JsonLimits& limits);

}  // namespace fanbeam::core
