#include <algorithm>

#include "materials/open_material/metadata_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_hexadecimal(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

// 8-4-4-4-12 hexadecimal digits.
bool is_uuid(const std::string& text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : !is_hexadecimal(text[i])) return false;
  }
  return true;
}

// "1.0.0"
bool is_version(const std::string& text) {
  int dots = 0;
  char before = '.';
  for (const char c : text) {
    if (c == '.' ? before == '.' : !is_digit(c)) return false;
    if (c == '.') ++dots;
    before = c;
  }
  return dots == 2 && before != '.';
}

void check_texts(const core::JsonNode& node) {
  if (!node.present()) return;
  if (node.texts(1000).empty() && node.is_array() && node.elements() == 0)
    node.error(ErrorClass::parse, "at least one text");
}

}  // namespace

std::string check_metadata(const core::JsonNode& root, const char* version_key) {
  const core::JsonNode metadata = root.required("metadata");
  const std::string name = metadata.required("name").text().value_or("");
  const core::JsonNode uuid = metadata.required("uuid");
  if (const auto text = uuid.text(); text && !is_uuid(*text))
    uuid.error(ErrorClass::parse, "32 hexadecimal digits as 8-4-4-4-12");
  const core::JsonNode version = metadata.required(version_key);
  if (const auto text = version.text(); text && !is_version(*text))
    version.error(ErrorClass::parse, "a version such as \"1.0.0\"");
  const core::JsonNode standard = metadata.required("openMaterial3dVersion");
  if (const auto text = standard.text()) {
    if (!is_version(*text))
      standard.error(ErrorClass::parse, "a version such as \"1.0.0\"");
    else if (!text->starts_with("1."))
      standard.error(ErrorClass::unsupported, "version 1 of the standard");
  }
  check_texts(metadata.required("copyrights"));
  metadata.required("license").text();
  check_texts(metadata.required("authors"));
  return name;
}

}  // namespace fanbeam::materials
