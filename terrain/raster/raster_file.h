// One band of a georeferenced raster file, read through GDAL into memory as a whole.
//
// Formats: GeoTIFF, DTED, SRTM .hgt, ESRI ASCII grid (its system in a .prj beside it).
// Pixel-is-area and pixel-is-point files are told apart by GDAL. Files that point to other files
// (VRT) and remote names are not opened. There is no value where a sample is the file's nodata value,
// or not finite, or where a mask (in a GeoTIFF, or a TIFF "dem.tif.msk" beside "dem.tif") is 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
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

// What a raster file says of itself beside its samples.
struct RasterFacts {
  // What its heights count from: `gravity` is some mean sea level.
  enum class Heights { unsaid, ellipsoid, gravity };
  std::string format;                 // GDAL's short name: "GTiff", "DTED", "SRTMHGT", "AAIGrid"
  Heights heights = Heights::unsaid;  // of its coordinate reference system, or of its format
  std::string heights_name;           // "EGM96 height", where there is one
  std::vector<std::filesystem::path>
      files;  // the file itself, and those beside it that belong to it
};

// 100 million samples: 400 MB. A one-degree cell at one arc second has 13 million.
inline constexpr std::int64_t kMostSamples = 100'000'000;

// Throws InputError: E-IO (missing or unreadable file), E-PATH (a file of the same name beside it,
// such as its .prj, is a symbolic link out of the folder, which the raster itself may be, or a mask that
// is no TIFF), E-PARSE (not one of the formats, damaged, or shorter than it claims, a mask of another
// size), E-LIMIT (more than kMostSamples, found before anything is allocated), E-REF (no georeference),
// E-UNSUPPORTED (more than one band, complex numbers, or as PixelMap; heights not in metres, as the band,
// the vertical part of its system or the Zunits of an older .prj say).
RasterBand read_raster_band(const std::filesystem::path& path);

// SRTM .hgt and DTED always count from EGM96; other formats where their system has a vertical part.
// Throws InputError: E-IO, E-PATH, E-PARSE as above.
RasterFacts read_raster_facts(const std::filesystem::path& path);

}  // namespace fanbeam::terrain
