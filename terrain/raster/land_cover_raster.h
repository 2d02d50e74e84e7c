// What covers the ground, as class numbers from a raster file (formats as read_raster_band).
// The class of a position is that of the pixel it lies in; classes are never interpolated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "terrain/pixel_map.h"

namespace fanbeam::terrain {

inline constexpr int kNoLandCover = -1;
inline constexpr int kLargestLandCoverClass = 65535;

class LandCoverRaster {
 public:
  // Throws InputError as read_raster_band, and E-RANGE for a value that is not a whole number from
  // 0 to kLargestLandCoverClass.
  explicit LandCoverRaster(const std::filesystem::path& file);

  // kNoLandCover outside the raster and where the file has no value. Thread-safe.
  int class_at(double latitude_rad, double longitude_rad) const;

  // Every class that occurs, ascending, so that a table of materials can be checked against it.
  const std::vector<int>& classes() const { return classes_; }
  int width() const { return width_; }
  int height() const { return height_; }
  const GeodeticBox& box() const { return pixel_map_.box(); }

 private:
  explicit LandCoverRaster(const std::filesystem::path& file, struct RasterBand band);

  int width_;
  int height_;
  PixelMap pixel_map_;
  std::vector<std::int32_t> pixels_;
  std::vector<int> classes_;
};

}  // namespace fanbeam::terrain
