// A position on WGS 84 and the datum its height counts from.
#pragma once

namespace fanbeam::core {

// latitude in [-pi/2, pi/2], longitude any finite angle, height above the ellipsoid unless a datum
// says otherwise.
struct Geodetic {
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
};

// What a height in a file counts from. `scene`: an unknown datum that terrain and aircraft share.
enum class VerticalDatum { ellipsoid, egm96, scene };

}  // namespace fanbeam::core
