// What runways are made of, from the codes of public airport data to materials of the library.
#pragma once

#include <string>
#include <string_view>

namespace fanbeam::scenes {

struct RunwaySurface {
  std::string as_found;  // "ASPH-G", "surface code 3"; any text, or empty
  std::string material;  // of the shipped material library
  bool paved = true;
  bool known = true;  // false: the code says nothing, `material` is an assumption
  bool water = false;
};

// Codes of row 100 of X-Plane's apt.dat (formats 850 to 1200).
RunwaySurface surface_of_apt_code(int code);

// The words of OurAirports and of national publications: "ASP", "CON", "Grass", "GRVL", "turf".
// The first known word decides.
RunwaySurface surface_of_text(std::string_view text);

}  // namespace fanbeam::scenes
