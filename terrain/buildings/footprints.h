// Building footprints from a GeoJSON file (RFC 7946), read through GDAL.
//
// Polygons and the parts of multi-polygons become one footprint each, courtyards kept as holes.
// Rings that cross or touch themselves are repaired by GEOS (OGR's MakeValid): the area they
// enclose stays, ambiguous linework does not. Coordinates in another system than WGS 84 (the old
// "crs" member) are converted; heights of vertices are ignored. Features whose property hide_3d is true
// are left out: in the OpenMapTiles schema the outlines of buildings whose parts are features as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"

namespace fanbeam::terrain {

struct GeodeticPoint {
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
};

// At least three points; the last is not the first again.
using GeodeticRing = std::vector<GeodeticPoint>;

struct Footprint {
  GeodeticRing outer;               // counter-clockwise seen from above
  std::vector<GeodeticRing> holes;  // clockwise
  double min_height_m = 0.0;        // both above ground
  double height_m = 0.0;
  std::size_t feature = 0;  // place in the file, from 0; parts of a multi-polygon share it
};

struct FootprintOptions {
  std::string height_property = "render_height";
  std::string min_height_property = "render_min_height";
  // For features without the height property: the default of the OpenMapTiles schema.
  double default_height_m = 5.0;
};

inline constexpr std::uint64_t kLargestFootprintFile_bytes = 200'000'000;
// Edges that meet where they should not. The repair of an outline that crosses itself takes time
// with the cube of its crossings: a tangle of 12 kB took minutes.
inline constexpr std::size_t kMostPolygonCrossings = 1000;
inline constexpr std::size_t kMostFileCrossings = 10'000;

// Throws InputError: E-IO, E-LIMIT (larger than kLargestFootprintFile_bytes, more crossings than above,
// more corners than corner_budget.h allows), E-PARSE (no GeoJSON, or damaged), E-REF (a "crs" that is
// not on the Earth), E-RANGE (coordinates outside the Earth; heights that are no numbers or outside 0
// to 1000 m), all features together. Warnings, with counts: W-UNCLOSED rings, which do not end where
// they begin as RFC 7946 asks and are closed, W-REPAIRED rings, W-DEFAULT heights, W-SKIPPED features
// that are no polygons or have hide_3d, W-DEGENERATE footprints without area or height. Courtyards that are
// a single point are none.
std::vector<Footprint> read_footprints(const std::filesystem::path& file,
                                       const FootprintOptions& options,
                                       core::ProblemList& problems);

// Names of the properties that features of the file have, in the order of the file. Throws
// InputError as read_footprints for a file that cannot be opened.
std::vector<std::string> footprint_properties(const std::filesystem::path& file);

}  // namespace fanbeam::terrain
