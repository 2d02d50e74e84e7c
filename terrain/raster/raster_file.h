// One band of a georeferenced raster file, read through GDAL into memory as a whole.
//
// Formats: GeoTIFF, DTED, SRTM .hgt, ESRI ASCII grid (its system in a .prj beside it).
// Pixel-is-area and pixel-is-point files are told apart by GDAL. Files that point to other files
// (VRT) and remote names are not opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "terrain/pixel_map.h"

namespace fanbeam::terrain {

struct RasterBand {
  int width = 0;
  int height = 0;
  std::vector<float> samples;  // row by row, the first row first; NaN where the file has no value
  PixelMap pixel_map;

  float at(int column, int row) const {
    return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(column)];
  }
};

// 100 million samples: 400 MB. A one-degree cell at one arc second has 13 million.
inline constexpr std::int64_t kMostSamples = 100'000'000;

// Throws InputError: E-IO (missing or unreadable file), E-PATH (a file of the same name beside it,
// such as its .prj, is a symbolic link out of the folder), E-PARSE (not one of the formats, damaged,
// or shorter than it claims), E-LIMIT (more than kMostSamples, found before anything is allocated),
// E-REF (no georeference), E-UNSUPPORTED (more than one band, complex numbers, heights not in
// metres, or as PixelMap).
RasterBand read_raster_band(const std::filesystem::path& path);

}  // namespace fanbeam::terrain
