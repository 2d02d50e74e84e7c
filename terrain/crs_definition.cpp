#include "terrain/crs_definition.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>

#include "core/errors.h"

namespace fanbeam::terrain {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

bool mentions_crs(std::string_view text) {
  constexpr std::string_view kName = "crs";
  return std::search(text.begin(), text.end(), kName.begin(), kName.end(),
                     [](unsigned char letter, char wanted) {
                       return std::tolower(letter) == wanted;
                     }) != text.end();
}

// `nadgrids=@null`, `EXTENSION["PROJ4_GRIDS","@null"]`: the one grid that is no file.
bool names_grid(const std::string& lower_text) {
  for (std::size_t at = lower_text.find("grids"); at != std::string::npos;
       at = lower_text.find("grids", at + 1)) {
    const std::size_t value = lower_text.find_first_not_of(" \t\r\n\"=,", at + 5);
    if (value == std::string::npos || lower_text.compare(value, 5, "@null") != 0) return true;
    const std::size_t end = value + 5;
    if (end < lower_text.size() && lower_text[end] == ',') return true;  // a list
  }
  return false;
}

}  // namespace

bool names_files(std::string_view definition) {
  std::string text = lower(definition);
  if (names_grid(text)) return true;
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](unsigned char letter) { return std::isspace(letter) != 0; }),
             text.end());
  for (const char* key : {"init=", "file=", "model=", "parameterfile"})
    if (text.find(key) != std::string::npos) return true;
  return false;
}

bool crs_names_files(std::string_view geojson, const std::string& file) {
  using Json = nlohmann::json;
  // Keys may be written with escapes.
  if (geojson.find('\\') == std::string_view::npos && !mentions_crs(geojson)) return false;
  int crs_depth = -1;  // of the member that is being read; below 0 outside
  bool found = false;
  // Answers false to drop what was read, so that no tree grows.
  const auto look = [&](int depth, Json::parse_event_t event, Json& parsed) {
    switch (event) {
      case Json::parse_event_t::key:
        if (crs_depth >= 0 && depth <= crs_depth) crs_depth = -1;
        if (crs_depth < 0 && lower(parsed.get_ref<const std::string&>()) == "crs")
          crs_depth = depth;
        return true;
      case Json::parse_event_t::value:
        if (crs_depth >= 0 && parsed.is_string())
          found = found || names_files(parsed.get_ref<const std::string&>());
        return false;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        if (depth < crs_depth) crs_depth = -1;
        return false;
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        return true;
    }
    return true;
  };
  try {
    [[maybe_unused]] const Json only_looked_at = Json::parse(geojson.begin(), geojson.end(), look);
  } catch (const Json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{file}, "GeoJSON with a crs",
                            error.what(), "strict JSON");
  }
  return found;
}

}  // namespace fanbeam::terrain
