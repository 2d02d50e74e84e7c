#include "scenes/new_scene/new_scene.h"

#include <algorithm>
#include <cmath>

#include "core/files.h"
#include "core/units.h"
#include "scenes/new_scene/elevation_guess.h"
#include "scenes/new_scene/scene_draft.h"
#include "scenes/new_scene/terrain_extent.h"
#include "scenes/new_scene/words.h"
#include "terrain/geoid.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::VerticalDatum;

constexpr double kAssumedWidth_m = 45.0;
constexpr double kSpare_m = 500.0;    // of terrain around what must be there
constexpr double kBeyond_m = 1500.0;  // of terrain around the approach, where there are data
constexpr double kPostSpacing_m = 10.0;
constexpr double kLargestGap_m = 30.0;  // of published and measured height of a runway's end

class SceneMaker {
 public:
  SceneMaker(const NewSceneRequest& request, core::ProblemList& problems)
      : request_(request), problems_(problems) {}

  std::optional<NewScene> make() {
    draft_.name = request_.name;
    draft_.source = request_.airport_source;
    draft_.start_distance_m = request_.start_distance_m;
    draft_.glide_path_deg = request_.glide_path_deg;
    draft_.threshold_crossing_height_m = request_.threshold_crossing_height_m;
    const bool landing = choose_runway();
    const bool terrain = read_elevation();
    if (!request_.buildings.empty()) add_buildings();
    if (landing && terrain) {
      describe_runway();
      const bool covered = place_heights();
      if (covered && !request_.track.empty()) add_track();
      if (covered && !problems_.has_errors()) choose_extent();
    }
    if (problems_.has_errors() || !landing || !terrain) return std::nullopt;
    scene_.text = scene_text(draft_);
    return std::move(scene_);
  }

 private:
  void note(std::string label, std::string text, bool guess = false) {
    scene_.notes.push_back({std::move(label), std::move(text), guess});
  }

  bool choose_runway() {
    if (!request_.airport) return false;
    const std::size_t before = problems_.all().size();
    const auto landing = choose_landing(*request_.airport, request_.runway, problems_);
    for (std::size_t i = before; i < problems_.all().size(); ++i)
      if (problems_.all()[i].is_error()) return false;
    if (!landing) return false;
    draft_.landing = *landing;
    draft_.title =
        safe_words(request_.airport->ident + " runway " + draft_.landing.threshold_end().name +
                   (request_.airport->name.empty() ? "" : ", ") + request_.airport->name);
    return true;
  }

  // The name of a file in the scene; it will be copied unless it lies in the data folder.
  std::string file_name(const std::filesystem::path& file, const char* folder) {
    if (!request_.data_folder.empty() && core::lies_inside(request_.data_folder, file))
      return std::filesystem::weakly_canonical(file)
          .lexically_relative(std::filesystem::weakly_canonical(request_.data_folder))
          .generic_string();
    const std::string name = std::string(folder) + "/" + safe_file_name(file.filename().string());
    scene_.files.push_back({file, name});
    return name;
  }

  bool read_elevation() {
    try {
      elevation_.emplace(request_.elevation);
    } catch (const core::InputError& error) {
      problems_.append(error.problems());
      return false;
    }
    const std::size_t before = scene_.files.size();
    draft_.elevation = file_name(request_.elevation, "terrain");
    if (scene_.files.size() > before)
      for (const std::filesystem::path& beside : elevation_->facts().files)
        if (beside.filename() != request_.elevation.filename()) file_name(beside, "terrain");
    draft_.fill_voids = elevation_->voids() > 0;
    draft_.quantisation_step_m = elevation_->whole_metres() ? 1.0 : 0.0;
    return true;
  }

  void add_buildings() {
    const auto guess = guess_buildings(request_.buildings, scene_.notes, problems_);
    if (!guess) return;
    draft_.buildings = *guess;
    draft_.buildings_file = file_name(request_.buildings, "buildings");
  }

  core::Geodetic threshold() const {
    const Landing& landing = draft_.landing;
    return terrain::geodesic_point(landing.threshold_end().pavement_end, landing.bearing_rad,
                                   landing.threshold_end().displaced_m);
  }

  void describe_runway() {
    const Landing& landing = draft_.landing;
    const AirportRunway& runway = landing.runway;
    const bool has_width = runway.width_m > 0.0;
    draft_.width_m = has_width ? runway.width_m : kAssumedWidth_m;
    note("runway",
         safe_words(request_.airport->ident) + " " + runway.ends[0].name + "/" +
             runway.ends[1].name + ", " + whole(landing.length_m) + " x " + tenths(draft_.width_m) +
             " m" + (has_width ? "" : " (width assumed)") + ", landing on " +
             landing.threshold_end().name + " at " + tenths(core::degrees(landing.bearing_rad)) +
             " deg true",
         !has_width);
    const RunwaySurface& surface = runway.surface;
    note("surface",
         surface.material + (surface.known ? ": the data say " + safe_words(surface.as_found)
                                           : ", assumed: the data do not say"),
         !surface.known);
    std::string others;
    for (const AirportRunway& other : request_.airport->runways)
      if (other.ends[0].name != runway.ends[0].name)
        others += (others.empty() ? "" : ", ") + other.ends[0].name + "/" + other.ends[1].name;
    if (!others.empty()) note("left out", "the airport's other runways: " + safe_words(others));
  }

  // Datum of the elevation data, and heights of both ends in it.
  bool place_heights() {
    const AirportRunway& runway = draft_.landing.runway;
    std::vector<KnownElevation> known;
    for (const AirportRunwayEnd& end : runway.ends)
      if (end.elevation_m)
        known.push_back(
            {{end.pavement_end.latitude_rad, end.pavement_end.longitude_rad, *end.elevation_m},
             end.name});
    if (known.empty() && request_.airport->elevation_m)
      for (const AirportRunwayEnd& end : runway.ends)
        known.push_back({{end.pavement_end.latitude_rad, end.pavement_end.longitude_rad,
                          *request_.airport->elevation_m},
                         "airport"});
    core::Geodetic at = threshold();
    elevation_->guess(known, at, scene_.notes);
    draft_.datum = elevation_->datum();
    draft_.datum_why = elevation_->datum_why();
    bool covered = true;
    for (const int end : {0, 1}) covered = place_end(end) && covered;
    if (!covered) {
      report_elsewhere();
      return false;
    }
    const Landing& landing = draft_.landing;
    const double rise_m = draft_.end_height_m[1 - landing.end] - draft_.end_height_m[landing.end];
    at.height_m = draft_.end_height_m[landing.end] +
                  rise_m * landing.threshold_end().displaced_m / landing.length_m;
    draft_.origin = at;
    return true;
  }

  bool place_end(int index) {
    const AirportRunwayEnd& end = draft_.landing.runway.ends[index];
    const std::optional<double> found_m = elevation_->height_m(end.pavement_end);
    if (!found_m) return false;
    draft_.end_height_known[index] = end.elevation_m.has_value();
    if (!end.elevation_m) {
      draft_.end_height_m[index] = *found_m;
      note("elevation of " + end.name,
           tenths(*found_m) + " m, from the terrain: the data have none", true);
      return true;
    }
    const double published_m = *end.elevation_m + elevation_->from_sea_level_m(end.pavement_end);
    draft_.end_height_m[index] = published_m;
    const double above_m = published_m - *found_m;
    note("elevation of " + end.name,
         tenths(*end.elevation_m) + " m above mean sea level, " + tenths(std::abs(above_m)) +
             " m " + (above_m < 0.0 ? "below" : "above") + " the terrain file" +
             (std::abs(above_m) > kLargestGap_m ? ": look whether both are of this place" : ""),
         std::abs(above_m) > kLargestGap_m);
    return true;
  }

  // The runway is not, or not wholly, on the elevation data.
  void report_elsewhere() {
    for (const AirportRunwayEnd& end : draft_.landing.runway.ends) {
      const core::Geodetic& at = end.pavement_end;
      if (elevation_->height_m(at)) continue;
      const bool exchanged = std::abs(at.longitude_rad) <= core::kPi / 2 &&
                             elevation_->height_m({at.longitude_rad, at.latitude_rad, 0.0});
      problems_.error(ErrorClass::range, draft_.landing.runway.place, "runway end " + end.name,
                      position_text(at.latitude_rad, at.longitude_rad) +
                          (exchanged ? ", latitude and longitude exchanged" : ""),
                      "a place on the elevation data: " + elevation_->extent_text());
    }
  }

  void add_track() {
    const Landing& landing = draft_.landing;
    TrackReference reference;
    reference.threshold = draft_.origin;
    reference.threshold.height_m -= elevation_->from_sea_level_m(draft_.origin);
    reference.bearing_rad = landing.bearing_rad;
    reference.runway_length_m = landing.length_m - landing.threshold_end().displaced_m;
    reference.runway_slope =
        (draft_.end_height_m[1 - landing.end] - draft_.end_height_m[landing.end]) /
        landing.length_m;
    reference.geoid_m =
        terrain::egm96_geoid_height_m(draft_.origin.latitude_rad, draft_.origin.longitude_rad);
    reference.threshold_crossing_height_m = request_.threshold_crossing_height_m;
    reference.start_distance_m = request_.start_distance_m;
    reference.ground_m = [this](const core::Geodetic& at) {
      return elevation_->sea_level_height_m(at);
    };
    const auto guess = guess_track(request_.track, reference, scene_.notes, problems_);
    if (!guess) return;
    draft_.track = *guess;
    draft_.track_file = file_name(request_.track, "flight");
  }

  void choose_extent() {
    const Landing& landing = draft_.landing;
    std::vector<core::Geodetic> needed = {landing.runway.ends[0].pavement_end,
                                          landing.runway.ends[1].pavement_end};
    if (draft_.track_file.empty())
      needed.push_back(terrain::geodesic_point(draft_.origin, landing.bearing_rad + core::kPi,
                                               request_.start_distance_m));
    else
      needed.insert(needed.end(), draft_.track.path.begin(), draft_.track.path.end());
    const TerrainExtent least = extent_around(draft_.origin, needed, kSpare_m);
    const double most_m = request_.start_distance_m + kBeyond_m;
    const auto covers = [&](const core::Geodetic& at) {
      return elevation_->height_m(at).has_value();
    };
    const std::optional<TerrainExtent> extent =
        covered_extent(draft_.origin, least, {most_m, most_m, most_m, most_m}, covers);
    if (!extent) return report_uncovered(least);
    draft_.west_m = extent->west_m;
    draft_.east_m = extent->east_m;
    draft_.south_m = extent->south_m;
    draft_.north_m = extent->north_m;
    draft_.spacing_m = kPostSpacing_m;
    note("terrain", tenths((extent->west_m + extent->east_m) / 1e3) + " x " +
                        tenths((extent->south_m + extent->north_m) / 1e3) +
                        " km around the threshold, a post every " + whole(kPostSpacing_m) + " m");
  }

  void report_uncovered(const TerrainExtent& least) {
    const terrain::LocalFrame frame(draft_.origin);
    const core::Geodetic south_west = frame.to_geodetic({-least.west_m, -least.south_m, 0.0});
    const core::Geodetic north_east = frame.to_geodetic({least.east_m, least.north_m, 0.0});
    problems_.error(ErrorClass::range, core::Place{request_.elevation.string()}, "elevation data",
                    elevation_->extent_text(),
                    "all of " +
                        box_text(south_west.latitude_rad, north_east.latitude_rad,
                                 south_west.longitude_rad, north_east.longitude_rad) +
                        " for the approach from " + tenths(request_.start_distance_m / 1e3) +
                        " km and " + whole(kSpare_m) +
                        " m around it; a shorter one starts with --start-distance");
  }

  const NewSceneRequest& request_;
  core::ProblemList& problems_;
  NewScene scene_;
  SceneDraft draft_;
  std::optional<ElevationData> elevation_;
};

}  // namespace

std::optional<NewScene> make_new_scene(const NewSceneRequest& request,
                                       core::ProblemList& problems) {
  return SceneMaker(request, problems).make();
}

}  // namespace fanbeam::scenes
