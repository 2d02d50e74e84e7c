// From latitude and longitude to the pixels of a raster in any coordinate reference system.
//
// The projection (PROJ through GDAL) is evaluated once, on a lattice over the raster, and
// interpolated bilinearly between. The lattice is refined until it is good to kPixelMapAccuracy;
// for a raster in longitude and latitude it is exact to rounding.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fanbeam::terrain {

// Largest error of a mapped position, in pixels.
inline constexpr double kPixelMapAccuracy = 1e-3;

// Column 0, row 0 is the outer corner of the first pixel; its middle is (0.5, 0.5).
struct PixelPosition {
  double column = 0.0;
  double row = 0.0;
};

// Bounds on WGS 84. East may exceed pi where the date line is inside.
struct GeodeticBox {
  double south_rad = 0.0;
  double north_rad = 0.0;
  double west_rad = 0.0;
  double east_rad = 0.0;
};

class PixelMap {
 public:
  // `geotransform` is GDAL's: x = g0 + g1 column + g2 row, y = g3 + g4 column + g5 row, in the
  // system `crs_wkt` (well-known text). Throws InputError: E-REF when the two do not place the
  // raster on the Earth; E-UNSUPPORTED when it spans half the globe, surrounds a pole, or its
  // projection is too crooked for the lattice. `file` goes into the messages.
  PixelMap(const std::array<double, 6>& geotransform, const std::string& crs_wkt, int width,
           int height, const std::string& file);

  // Nothing outside the raster. Thread-safe.
  std::optional<PixelPosition> pixel_at(double latitude_rad, double longitude_rad) const;

  // Encloses the raster, with a margin of at most two pixels.
  const GeodeticBox& box() const { return box_; }

 private:
  int width_;
  int height_;
  GeodeticBox box_;
  std::size_t cells_ = 0;  // lattice cells along each side; (cells_ + 1)^2 nodes
  std::vector<PixelPosition> nodes_;
};

}  // namespace fanbeam::terrain
