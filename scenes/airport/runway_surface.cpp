#include "scenes/airport/runway_surface.h"

#include <array>
#include <cctype>

namespace fanbeam::scenes {
namespace {

struct Kind {
  const char* material;
  bool paved;
};
constexpr Kind kAsphalt{"asphalt_worn", true}, kConcrete{"concrete", true},
    kGrass{"short_grass", false}, kEarth{"bare_soil", false}, kGravel{"gravel", false},
    kSnow{"snow_dry", false};

RunwaySurface surface_of(std::string as_found, const Kind& kind) {
  return {std::move(as_found), kind.material, kind.paved, true, false};
}

// How the words begin that stand for a kind, in capitals.
struct Word {
  std::string_view start;
  const Kind& kind;
};
constexpr std::array<Word, 33> kWords = {{
    {"ASP", kAsphalt},  {"BIT", kAsphalt},  {"TAR", kAsphalt},   {"MAC", kAsphalt},
    {"PEM", kAsphalt},  {"COP", kAsphalt},  {"PAV", kAsphalt},   {"BLACKTOP", kAsphalt},
    {"SEAL", kAsphalt}, {"CON", kConcrete}, {"CEM", kConcrete},  {"PSP", kConcrete},
    {"BRI", kConcrete}, {"GRASS", kGrass},  {"GRS", kGrass},     {"TURF", kGrass},
    {"SOD", kGrass},    {"TRF", kGrass},    {"GRAV", kGravel},   {"GRV", kGravel},
    {"GVL", kGravel},   {"COR", kGravel},   {"STONE", kGravel},  {"DIRT", kEarth},
    {"GRE", kEarth},    {"CLA", kEarth},    {"LAT", kEarth},     {"EARTH", kEarth},
    {"SAN", kEarth},    {"SOIL", kEarth},   {"UNPAVED", kEarth}, {"SNOW", kSnow},
    {"ICE", kSnow},
}};

}  // namespace

RunwaySurface surface_of_apt_code(int code) {
  const std::string as_found = "surface code " + std::to_string(code);
  if (code == 1 || (code >= 20 && code <= 38)) return surface_of(as_found, kAsphalt);
  if (code == 2 || (code >= 50 && code <= 57)) return surface_of(as_found, kConcrete);
  switch (code) {
    case 3:
      return surface_of(as_found, kGrass);
    case 4:
    case 12:  // dry lake bed
      return surface_of(as_found, kEarth);
    case 5:
      return surface_of(as_found, kGravel);
    case 13:
      return {as_found, "water_calm", false, true, true};
    case 14:
      return surface_of(as_found, kSnow);
    default:
      return {as_found, kAsphalt.material, true, false, false};
  }
}

RunwaySurface surface_of_text(std::string_view text) {
  std::string capitals;
  for (const char letter : text.substr(0, 100))
    capitals += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  const std::string as_found(text.substr(0, 100));
  for (std::size_t i = 0; i < capitals.size(); ++i) {
    const bool starts_word =
        std::isalpha(static_cast<unsigned char>(capitals[i])) != 0 &&
        (i == 0 || std::isalpha(static_cast<unsigned char>(capitals[i - 1])) == 0);
    if (!starts_word) continue;
    const std::string_view rest = std::string_view(capitals).substr(i);
    for (const Word& word : kWords)
      if (rest.starts_with(word.start)) return surface_of(as_found, word.kind);
    if (rest.starts_with("WAT")) return {as_found, "water_calm", false, true, true};
  }
  return {as_found, kAsphalt.material, true, false, false};
}

}  // namespace fanbeam::scenes
