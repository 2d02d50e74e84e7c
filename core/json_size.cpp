#include "core/json_size.h"

namespace fanbeam::core {

std::optional<JsonExcess> json_excess(std::string_view json, const JsonLimits& limits) {
  int level = 0;
  std::size_t values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
      continue;
    }
    in_string = c == '"';
    const bool opens = c == '[' || c == '{';
    if (opens) ++level;
    if (c == ']' || c == '}') --level;
    if (opens || c == ',') ++values;
    if (level > limits.levels) return JsonExcess{JsonExcess::Of::levels, i};
    if (values > limits.values) return JsonExcess{JsonExcess::Of::values, i};
  }
  return std::nullopt;
}

}  // namespace fanbeam::core
