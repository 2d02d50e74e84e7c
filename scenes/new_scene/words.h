// Numbers and foreign text as notes and scene files carry them.
#pragma once

#include <string>
#include <string_view>

namespace fanbeam::scenes {

// The value rounded to that many decimals, as a TOML float: "12.5", "3.0", never "-0.0".
std::string rounded(double value, int decimals);
std::string tenths(double value);  // rounded to one decimal
std::string whole(double value);   // rounded to none, without a point

// "47.675677 N 9.522717 E"
std::string position_text(double latitude_rad, double longitude_rad);
// "47.0 to 48.0 N, 9.0 to 10.0 E"
std::string box_text(double south_rad, double north_rad, double west_rad, double east_rad);

// At most 80 bytes, escaped as core::printable_text does.
std::string safe_words(std::string_view text);
// For names of copied files: letters, digits, '.' and '-' stay, the rest becomes '_', and so does a
// leading point. Unlike core::safe_word it keeps a long name's end, which tells the format.
std::string safe_file_name(std::string_view name);
// A basic string of TOML 1.0 in its quotation marks. What may not be printed becomes an escape that
// scene files take for plain letters: they refuse such texts.
std::string toml_text(std::string_view text);

}  // namespace fanbeam::scenes
