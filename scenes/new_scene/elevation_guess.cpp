#include "scenes/new_scene/elevation_guess.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "scenes/new_scene/words.h"
#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

using core::VerticalDatum;
using Heights = terrain::RasterFacts::Heights;

constexpr double kTellable_m = 10.0;  // geoids nearer to the ellipsoid drown in terrain errors
constexpr double kGoodFit_m = 15.0;

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::string fit_text(double above_m) {
  return tenths(std::abs(above_m)) + " m " + (above_m < 0.0 ? "below" : "above") +
         " the published elevations";
}

std::string said_by_file(const terrain::RasterFacts& facts) {
  if (facts.format == "SRTMHGT") return "as SRTM .hgt files have";
  if (facts.format == "DTED") return "as DTED files have";
  const std::string said = "the file says \"" + safe_words(facts.heights_name) + "\"";
  const bool other_geoid =
      facts.heights == Heights::gravity && facts.heights_name.find("EGM96") == std::string::npos;
  return other_geoid ? said + ", which is taken as EGM96: mostly the same within a metre" : said;
}

}  // namespace

DatumGuess guess_datum(const terrain::RasterFacts& facts,
                       const std::vector<double>& above_published_m, double geoid_m) {
  DatumGuess guess;
  const bool comparable = !above_published_m.empty();
  const double above_sea_m = comparable ? middle_of(above_published_m) : 0.0;
  const double above_ellipsoid_m = above_sea_m - geoid_m;
  const bool tellable = comparable && std::abs(geoid_m) >= kTellable_m;
  const bool fits_sea = std::abs(above_sea_m) <= std::abs(above_ellipsoid_m);
  const double best_m = fits_sea ? above_sea_m : above_ellipsoid_m;
  if (facts.heights != Heights::unsaid) {
    const bool says_sea = facts.heights == Heights::gravity;
    guess.datum = says_sea ? VerticalDatum::egm96 : VerticalDatum::ellipsoid;
    guess.why = said_by_file(facts);
    const double fit_m = says_sea ? above_sea_m : above_ellipsoid_m;
    if (comparable) guess.why += "; at the airport it is then " + fit_text(fit_m);
    guess.doubtful = tellable && says_sea != fits_sea && std::abs(best_m) <= kGoodFit_m &&
                     std::abs(fit_m) > 2 * kGoodFit_m;
    if (guess.doubtful)
      guess.why += std::string(", as ") + (fits_sea ? "egm96" : "ellipsoid") + " " +
                   fit_text(best_m) + ": look whether the file is right about itself";
    return guess;
  }
  if (tellable && std::abs(best_m) <= kGoodFit_m) {
    guess.datum = fits_sea ? VerticalDatum::egm96 : VerticalDatum::ellipsoid;
    guess.why = "the file does not say; so counted it is " + fit_text(best_m) +
                " of the airport, the other way " +
                fit_text(fits_sea ? above_ellipsoid_m : above_sea_m);
    return guess;
  }
  guess.assumed = true;
  guess.why = "assumed: the file does not say, and ";
  guess.why += !comparable ? "no elevation of the airport is published to compare with"
               : !tellable ? "geoid and ellipsoid are too close together here to tell"
                           : "it is " + fit_text(above_sea_m) + " of the airport";
  return guess;
}

ElevationData::ElevationData(const std::filesystem::path& file)
    : file_(file), facts_(terrain::read_raster_facts(file)) {
  {
    const terrain::RasterBand band = terrain::read_raster_band(file);
    const auto is_void = [](float sample) { return std::isnan(sample); };
    const auto is_whole = [](float sample) {
      return std::isnan(sample) || sample == std::floor(sample);
    };
    voids_ =
        static_cast<std::size_t>(std::count_if(band.samples.begin(), band.samples.end(), is_void));
    whole_metres_ = std::all_of(band.samples.begin(), band.samples.end(), is_whole);
  }
  raster_ = std::make_unique<terrain::ElevationRaster>(file, terrain::ElevationOptions{});
}

void ElevationData::guess(const std::vector<KnownElevation>& known, const core::Geodetic& near,
                          Notes& notes) {
  const double geoid_m = terrain::egm96_geoid_height_m(near.latitude_rad, near.longitude_rad);
  std::vector<double> above_m;
  for (const KnownElevation& place : known)
    if (const auto found_m = height_m(place.at)) above_m.push_back(*found_m - place.at.height_m);
  datum_ = guess_datum(facts_, above_m, geoid_m);
  std::string heights = whole_metres_ ? ", heights in whole metres" : "";
  if (voids_ > 0)
    heights += ", " + std::to_string(voids_) + " without a height, which are filled from around";
  notes.push_back({"elevation", safe_words(file_.filename().string()) + ": " + facts_.format +
                                    ", " + std::to_string(raster_->width()) + " x " +
                                    std::to_string(raster_->height()) + " posts, " + extent_text() +
                                    heights});
  notes.push_back({"vertical datum",
                   (datum_.datum == VerticalDatum::egm96 ? "egm96: " : "ellipsoid: ") + datum_.why,
                   datum_.assumed || datum_.doubtful});
}

std::optional<double> ElevationData::height_m(const core::Geodetic& at) const {
  return raster_->height_m(at.latitude_rad, at.longitude_rad);
}

double ElevationData::from_sea_level_m(const core::Geodetic& at) const {
  return datum_.datum == VerticalDatum::egm96
             ? 0.0
             : terrain::egm96_geoid_height_m(at.latitude_rad, at.longitude_rad);
}

std::optional<double> ElevationData::sea_level_height_m(const core::Geodetic& at) const {
  const std::optional<double> found_m = height_m(at);
  if (!found_m) return std::nullopt;
  return *found_m - from_sea_level_m(at);
}

std::string ElevationData::extent_text() const {
  const terrain::GeodeticBox& box = raster_->box();
  return box_text(box.south_rad, box.north_rad, box.west_rad, box.east_rad);
}

}  // namespace fanbeam::scenes
