#include "measure/regress/markup.h"

#include <cstdint>

#include "core/text.h"

namespace fanbeam::measure {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Whether XML knows the character, and a page may show it.
bool may_be_marked_up(const core::Character& character) {
  const std::uint32_t code = character.code;
  return character.valid && code >= 0x20 && !(code >= 0x7F && code < 0xA0) && code != 0xFFFE &&
         code != 0xFFFF;
}

}  // namespace

std::string markup_text(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const char c = bytes.front();
    const core::Character character = core::first_character(bytes);
    if (c == '\t' || c == '\n') {
      text += c;
    } else if (!may_be_marked_up(character)) {
      text += kReplacement;
    } else if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else if (c == '>') {
      text += "&gt;";
    } else if (c == '"') {
      text += "&quot;";
    } else if (c == '\'') {
      text += "&#39;";
    } else {
      text += bytes.substr(0, character.bytes);
    }
    bytes.remove_prefix(character.bytes);
  }
  return text;
}

}  // namespace fanbeam::measure
