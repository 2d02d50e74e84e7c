#include "scenes/new_scene/words.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/text.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

std::string with_side(double value_deg, const char* positive, const char* negative) {
  return rounded(std::abs(value_deg), 6) + (value_deg < 0.0 ? negative : positive);
}

std::string span_text(double from_deg, double to_deg, const char* positive, const char* negative) {
  const std::string from = rounded(std::abs(from_deg), 2), to = rounded(std::abs(to_deg), 2);
  if (from_deg < 0.0 && to_deg <= 0.0) return to + " to " + from + negative;
  return from + (from_deg < 0.0 ? negative : "") + " to " + to + positive;
}

}  // namespace

std::string rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const double near = std::round(value * scale) / scale + 0.0;  // no -0
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), near,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  std::string text(buffer.data(), end);
  if (text.find('.') == std::string::npos) return text + ".0";
  while (text.ends_with('0') && !text.ends_with(".0")) text.pop_back();
  return text;
}

std::string tenths(double value) { return rounded(value, 1); }

std::string whole(double value) {
  const std::string text = rounded(value, 0);
  return text.substr(0, text.find('.'));
}

std::string position_text(double latitude_rad, double longitude_rad) {
  return with_side(core::degrees(latitude_rad), " N ", " S ") +
         with_side(core::degrees(longitude_rad), " E", " W");
}

std::string box_text(double south_rad, double north_rad, double west_rad, double east_rad) {
  return span_text(core::degrees(south_rad), core::degrees(north_rad), " N", " S") + ", " +
         span_text(core::degrees(west_rad), core::degrees(east_rad), " E", " W");
}

std::string safe_words(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  return core::printable_text(text.substr(0, kLongest));
}

std::string safe_file_name(std::string_view name) {
  std::string safe;
  for (const char letter : name.substr(0, 200)) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') || letter == '.' || letter == '-';
    safe += plain ? letter : '_';
  }
  if (safe.empty() || safe.front() == '.') safe.insert(0, "_");
  return safe;
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : core::printable_text(text)) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + "\"";
}

}  // namespace fanbeam::scenes
