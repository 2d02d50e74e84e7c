#include "core/relative_uri.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/files.h"

namespace fanbeam::core {
namespace {

namespace fs = std::filesystem;

// In every locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_of_scheme(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
}

}  // namespace

PercentDecoded percent_decoded(std::string_view text) {
  PercentDecoded decoded;
  decoded.bytes.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded.bytes += static_cast<char>(byte);
      i += 2;
      continue;
    }
    if (text[i] == '%') decoded.wrong = std::min(decoded.wrong, i);
    decoded.bytes += text[i];
  }
  return decoded;
}

bool has_uri_scheme(std::string_view text) {
  constexpr std::array<std::string_view, 5> kKnown = {"data", "file", "ftp", "http", "https"};
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  std::string scheme(text.substr(0, colon));
  if (!is_letter(scheme.front()) || !std::all_of(scheme.begin(), scheme.end(), is_of_scheme))
    return false;
  if (text.substr(colon + 1).starts_with("//")) return true;
  for (char& c : scheme)
    if (is_letter(c)) c = static_cast<char>(c | 32);
  return std::find(kKnown.begin(), kKnown.end(), scheme) != kKnown.end();
}

fs::path file_of_uri(const fs::path& allowed_folder, const fs::path& from_file,
                     const std::string& uri, const Place& place, const std::string& field) {
  const std::string decoded = percent_decoded(uri).bytes;
  // Looked for here because behind a folder name a scheme would pass for a part of the path. An empty one is one.
  if (has_uri_scheme(decoded) || uri.starts_with(':'))
    throw_input_error(ErrorClass::path, place, field, "\"" + uri + "\"",
                      "a relative path, not a URI scheme");
  std::error_code status;
  const fs::path folder =
      fs::weakly_canonical(fs::absolute(from_file, status).parent_path(), status);
  const fs::path from_allowed_folder =
      folder.lexically_relative(fs::weakly_canonical(allowed_folder, status));
  return path_inside(allowed_folder, (from_allowed_folder / decoded).string(), place, field);
}

}  // namespace fanbeam::core
