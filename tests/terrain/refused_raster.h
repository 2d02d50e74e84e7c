// What is said of elevation that is refused.
#pragma once

#include <filesystem>
#include <string>

#include "core/errors.h"
#include "terrain/raster/elevation_raster.h"

namespace fanbeam::tests {

inline std::string refusal_of_raster(const std::filesystem::path& file,
                                     const terrain::ElevationOptions& options = {}) {
  try {
    const terrain::ElevationRaster raster(file, options);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace fanbeam::tests
