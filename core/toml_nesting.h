// How deep a TOML text nests, found without parsing it: the parser and the destructors of its tree
// recurse, so hostile depth must be refused before they see the text.
#pragma once

#include <optional>
#include <string_view>

namespace fanbeam::core {

struct TextPlace {
  int line = 1;
  int column = 1;
};

// Where open brackets and braces, or the parts of one dotted key, first exceed `most` levels.
// Strings and comments do not count. Exact on valid TOML and on invalid text up to its first error,
// where a parser stops anyway.
std::optional<TextPlace> nested_deeper_than(std::string_view text, int most);

}  // namespace fanbeam::core
