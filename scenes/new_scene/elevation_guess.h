// What an elevation file is, as far as it can be told from the file and from elevations published
// for the airport: what its heights count from, how they are rounded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"
#include "scenes/new_scene/note.h"
#include "terrain/raster/elevation_raster.h"
#include "terrain/raster/raster_file.h"

namespace fanbeam::scenes {

struct DatumGuess {
  core::VerticalDatum datum = core::VerticalDatum::egm96;
  std::string why;
  bool assumed = false;   // neither the file nor the published elevations tell
  bool doubtful = false;  // the file says one thing and the published elevations another
};

// `above_published_m`: the file's heights minus elevations above mean sea level that are published
// for the same places; may be empty. `geoid_m`: of the mean sea level above the ellipsoid there.
// What the file says of itself counts first; without that, the datum that the published elevations
// fit better, when the two are at least 10 m apart there and the fit is within 15 m; else EGM96.
DatumGuess guess_datum(const terrain::RasterFacts& facts,
                       const std::vector<double>& above_published_m, double geoid_m);

// A place whose elevation above mean sea level is published.
struct KnownElevation {
  core::Geodetic at;
  std::string what;  // "06"
};

class ElevationData {
 public:
  // Throws InputError as ElevationRaster and read_raster_facts.
  explicit ElevationData(const std::filesystem::path& file);

  // Decides the datum, and writes down what the file is.
  void guess(const std::vector<KnownElevation>& known, const core::Geodetic& near, Notes& notes);

  // In the file's own datum; nothing outside the file and in its holes.
  std::optional<double> height_m(const core::Geodetic& at) const;
  // Above mean sea level; after guess().
  std::optional<double> sea_level_height_m(const core::Geodetic& at) const;
  // From mean sea level to the file's datum, at a place; after guess().
  double from_sea_level_m(const core::Geodetic& at) const;

  const terrain::RasterFacts& facts() const { return facts_; }
  core::VerticalDatum datum() const { return datum_.datum; }
  const std::string& datum_why() const { return datum_.why; }
  bool whole_metres() const { return whole_metres_; }
  std::size_t voids() const { return voids_; }
  std::string extent_text() const;  // "47 to 48 N, 9 to 10 E"

 private:
  std::filesystem::path file_;
  terrain::RasterFacts facts_;
  bool whole_metres_ = false;
  std::size_t voids_ = 0;
  std::unique_ptr<terrain::ElevationRaster> raster_;
  DatumGuess datum_;
};

}  // namespace fanbeam::scenes
