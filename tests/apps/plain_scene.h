// Level grass under an antenna, and nothing else.
#pragma once

#include <string>

namespace fanbeam::tests {

// 60 m over level grass that ends 3 km north of the antenna.
inline const std::string kPlain = R"([scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
[terrain]
half_extent_m = 3000.0
spacing_m = 100.0
)";
inline const std::string kOverGrass = R"([trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)";
inline const std::string kPlainOverGrass = kPlain + kOverGrass;

}  // namespace fanbeam::tests
