#include "terrain/raster/land_cover_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/errors.h"
#include "terrain/raster/raster_file.h"

namespace fanbeam::terrain {
namespace {

std::int32_t class_of(float sample, const std::filesystem::path& file) {
  if (std::isnan(sample)) return kNoLandCover;
  const bool valid = sample >= 0.0F && sample <= static_cast<float>(kLargestLandCoverClass) &&
                     sample == std::floor(sample);
  if (!valid)
    core::throw_input_error(core::ErrorClass::range, core::Place{file.string()}, "land cover class",
                            core::number_text(static_cast<double>(sample)),
                            "a whole number from 0 to 65535");
  return static_cast<std::int32_t>(sample);
}

}  // namespace

LandCoverRaster::LandCoverRaster(const std::filesystem::path& file)
    : LandCoverRaster(file, read_raster_band(file)) {}

LandCoverRaster::LandCoverRaster(const std::filesystem::path& file, RasterBand band)
    : width_(band.width), height_(band.height), pixel_map_(std::move(band.pixel_map)) {
  std::vector<bool> occurs(static_cast<std::size_t>(kLargestLandCoverClass) + 1, false);
  pixels_.reserve(band.samples.size());
  for (const float sample : band.samples) {
    pixels_.push_back(class_of(sample, file));
    if (pixels_.back() != kNoLandCover) occurs[static_cast<std::size_t>(pixels_.back())] = true;
  }
  for (std::size_t i = 0; i < occurs.size(); ++i)
    if (occurs[i]) classes_.push_back(static_cast<int>(i));
}

int LandCoverRaster::class_at(double latitude_rad, double longitude_rad) const {
  const auto pixel = pixel_map_.pixel_at(latitude_rad, longitude_rad);
  if (!pixel) return kNoLandCover;
  const int column = std::min(static_cast<int>(pixel->column), width_ - 1);
  const int row = std::min(static_cast<int>(pixel->row), height_ - 1);
  return pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column)];
}

}  // namespace fanbeam::terrain
