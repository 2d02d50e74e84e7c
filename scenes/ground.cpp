#include "scenes/ground.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "core/parallel.h"
#include "core/units.h"
#include "scenes/airport/airport.h"
#include "scenes/elevation_voids.h"
#include "scenes/natural_ground.h"
#include "scenes/placed_problems.h"
#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

constexpr double kShortestRunway_m = 100.0;

std::string degrees_text(const core::Geodetic& position) {
  const auto text = [](double angle_rad) {
    return core::number_text(core::rounded_degrees(angle_rad));
  };
  return text(position.latitude_rad) + ", " + text(position.longitude_rad);
}

// "120 m east, -30 m north of the origin"
std::string local_text(glm::dvec2 position_m) {
  const auto whole = [](double value) {
    return core::number_text(std::round(value) + 0.0);
  };  // no -0
  return whole(position_m.x) + " m east, " + whole(position_m.y) + " m north of the origin";
}

}  // namespace

bool MaterialNames::knows(const std::string& name) const {
  return !sound_ || library_.index_of(name).has_value();
}

void MaterialNames::refuse(const std::string& name, const core::Place& place,
                           const std::string& field) const {
  refused_.insert(name);
  library_.find(name, place, field, problems_);
}

terrain::MaterialId MaterialNames::id(const std::string& name, const core::Place& place,
                                      const std::string& field) const {
  const std::optional<std::size_t> index = library_.index_of(name);
  if (index)
    used_.insert(*index);
  else if (sound_ && !refused_.contains(name))
    library_.find(name, place, field, problems_);
  return static_cast<terrain::MaterialId>(index.value_or(0));
}

Ground::Ground(const SceneDescription& scene, const terrain::LocalFrame& frame,
               const MaterialNames& names, core::ProblemList& problems)
    : scene_(scene), frame_(frame), problems_(problems) {
  const TerrainDescription& terrain = scene.terrain;
  try {
    field_ = terrain::make_height_field(terrain.west_m, terrain.south_m, terrain.east_m,
                                        terrain.north_m, terrain.spacing_m);
  } catch (const core::InputError& error) {  // without a ground nothing else can be judged
    append_placed(problems, error, terrain.place, "terrain");
    problems.throw_if_errors();
  }
  const NaturalGround natural(terrain, level_m(), names, problems);
  for (const RunwayDescription& runway : scene.runways)
    runways_.push_back(place_runway(runway, natural, names));
  if (!natural.usable()) return;
  tell_steps();
  shape(natural);
}

double Ground::level_m() const {
  if (scene_.runways.empty()) return scene_.origin.height_m;
  const RunwayEndDescription* const ends = scene_.runways[0].ends;
  return (ends[0].pavement_end.height_m + ends[1].pavement_end.height_m) / 2;
}

double Ground::elevation_on_ground_m(const RunwayDescription& description, int end,
                                     const NaturalGround& natural) const {
  constexpr int kSamples = 61;
  const core::Geodetic& from = description.ends[end].pavement_end;
  const terrain::GeodesicLine along =
      terrain::geodesic_between(from, description.ends[1 - end].pavement_end);
  double count = 0.0, t_sum = 0.0, tt_sum = 0.0, h_sum = 0.0, th_sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / (kSamples - 1);
    const core::Geodetic at = terrain::geodesic_point(from, along.azimuth_rad, t * along.length_m);
    const auto height_m = natural.height_m(at, local_m(at.latitude_rad, at.longitude_rad));
    if (!height_m) continue;
    count += 1.0;
    t_sum += t;
    tt_sum += t * t;
    h_sum += *height_m;
    th_sum += t * *height_m;
  }
  const double spread = count * tt_sum - t_sum * t_sum;
  if (!(spread > 0.0)) return scene_.origin.height_m;  // beyond the terrain: refused as such
  const double slope_m = (count * th_sum - t_sum * h_sum) / spread;
  return (h_sum - slope_m * t_sum) / count;
}

double Ground::ellipsoidal_m(double height_m, double latitude_rad, double longitude_rad,
                             core::VerticalDatum datum) const {
  if (datum == core::VerticalDatum::scene) datum = scene_.datum;
  return terrain::ellipsoidal_height_m({latitude_rad, longitude_rad, height_m}, datum);
}

glm::dvec2 Ground::local_m(double latitude_rad, double longitude_rad) const {
  glm::dvec3 local = frame_.to_local_m({latitude_rad, longitude_rad, scene_.origin.height_m});
  if (frame_.model() == terrain::EarthModel::plane) return local;
  // East and north depend a little on height: settle on the ground there.
  for (int i = 0; i < 2; ++i) {
    const double up_m = field_.height_at(local.x, local.y).value_or(local.z);
    const double height_m = frame_.to_geodetic({local.x, local.y, up_m}).height_m;
    local = frame_.to_local_m({latitude_rad, longitude_rad, height_m});
  }
  return local;
}

terrain::Runway Ground::place_runway(const RunwayDescription& description,
                                     const NaturalGround& natural,
                                     const MaterialNames& names) const {
  terrain::Runway runway;
  for (const int end : {0, 1}) {
    const RunwayEndDescription& from = description.ends[end];
    core::Geodetic position = from.pavement_end;
    if (from.on_ground && natural.usable())
      position.height_m = elevation_on_ground_m(description, end, natural);
    runway.ends[end] = {local_m(position), from.displaced_m, position.height_m};
  }
  runway.width_m = description.width_m;
  runway.shoulder_m = description.shoulder_m;
  runway.markings = description.markings;
  runway.strip_half_width_m = description.strip_half_width_m;
  runway.blend_m = description.blend_m;
  // A library of the user's own may lack one that the scene never wrote.
  const auto material = [&](const char* field, const std::string& name, const std::string& usual) {
    return names.id(name, description.place,
                    std::string("runway.") + field + (name == usual ? ", the default" : ""));
  };
  const RunwayDescription usual;
  runway.materials = {material("surface", description.surface, usual.surface),
                      material("shoulder", description.shoulder_material, usual.shoulder_material),
                      material("marking", description.marking_material, usual.marking_material)};
  if (runway.length_m() < kShortestRunway_m) {
    problems_.error(ErrorClass::range, description.place, "runway length",
                    core::number_text(runway.length_m()) + " m", "ends at least 100 m apart");
    // What else is wrong is looked for on a runway that has a direction.
    runway.ends[1].pavement_end_m =
        runway.ends[0].pavement_end_m + glm::dvec2(0.0, kShortestRunway_m);
  }
  const RunwayEndDescription* const ends = description.ends;
  check_displaced(ends[0].displaced_m + ends[1].displaced_m, runway.length_m(),
                  ends[ends[1].displaced_m > ends[0].displaced_m ? 1 : 0].displaced_place,
                  problems_);
  for (const terrain::RunwayEnd& end : runway.ends)
    if (!field_.height_at(end.pavement_end_m.x, end.pavement_end_m.y))
      problems_.error(ErrorClass::range, description.place, "runway end",
                      local_text(end.pavement_end_m), "a place on the scene's terrain");
  return runway;
}

void Ground::tell_steps() const {
  // Files of airports have ends to a foot or a metre, and nothing to be done about it.
  constexpr double kTold_m = 0.5, kToldOfAirports_m = 2.0;
  const auto name = [&](std::size_t i) {
    const RunwayEndDescription* const ends = scene_.runways[i].ends;
    return ends[0].name + "/" + ends[1].name;
  };
  for (std::size_t i = 1; i < runways_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double step_m = terrain::largest_step_m(runways_[k], runways_[i]);
      const bool airports = scene_.runways[i].from_airport && scene_.runways[k].from_airport;
      if (step_m > kTold_m && (!airports || step_m >= kToldOfAirports_m))
        problems_.warning(
            "OVERLAP", scene_.runways[i].place, "runway",
            name(k) + " and " + name(i) + " differ by " +
                core::number_text(std::round(step_m * 10.0) / 10.0) +
                " m where their strips overlap",
            "blended between their pavements, and along them where these cross; check "
            "the ends' elevations; strip_half_width_m of [[runway]] makes a strip "
            "narrower");
    }
}

Zone Ground::zone(glm::dvec2 position_m) const {
  Zone zone = Zone::open;
  for (const terrain::Runway& runway : runways_) {
    const glm::dvec2 relative = position_m - runway.ends[0].pavement_end_m;
    const double s_m = glm::dot(relative, runway.along());
    const double t_m = std::abs(relative.x * runway.along().y - relative.y * runway.along().x);
    const double beyond_m = std::max({-s_m, s_m - runway.length_m(), 0.0});
    const double keep_m = scene_.terrain.airfield_beyond_m;
    if (beyond_m < 60.0 + keep_m && t_m < runway.strip_half_width_m + keep_m) return Zone::airfield;
    // The first 3 km of the approach surfaces (ICAO Annex 14, 4.2: 15 % divergence) carry no trees.
    if (beyond_m < 3000.0 && t_m < runway.strip_half_width_m + 0.15 * beyond_m)
      zone = Zone::approach;
  }
  return zone;
}

void Ground::shape(const NaturalGround& natural) {
  std::mutex guard;
  std::size_t outside = 0, in_holes = 0;
  std::atomic<bool> covered{!natural.has_land_cover()};
  std::pair<std::size_t, std::string> first_outside{field_.height_m.size(), ""};  // post, position
  core::parallel_for(static_cast<std::size_t>(field_.rows), [&](std::size_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < field_.columns; ++i) {
      const glm::dvec2 p(field_.west_m + field_.spacing_m * i,
                         field_.south_m + field_.spacing_m * j);
      const std::optional<double> up_m = post_up_m(natural, p);
      if (!up_m) {
        const core::Geodetic at = frame_.to_geodetic({p, 0.0});
        const bool in_hole = is_in_hole(*natural.elevation(), at);
        const std::lock_guard<std::mutex> lock(guard);
        ++outside;
        if (in_hole) ++in_holes;
        first_outside = std::min(first_outside, {field_.post(i, j), degrees_text(at)});
        continue;
      }
      field_.height_m[field_.post(i, j)] = *up_m;
      if (i + 1 == field_.columns || j + 1 == field_.rows) continue;
      const glm::dvec2 middle = p + glm::dvec2(field_.spacing_m / 2);
      core::Geodetic at;  // land cover alone asks for it
      if (natural.has_land_cover()) at = frame_.to_geodetic({middle, *up_m});
      field_.cell_material[field_.cell(i, j)] = natural.material(at, middle, zone(middle));
      if (!covered && natural.is_covered(at)) covered = true;
    }
  });
  if (!covered)
    problems_.warning("OUTSIDE", scene_.terrain.land_cover_place, "terrain.land_cover.file",
                      scene_.terrain.land_cover.filename().string(),
                      "no ground of the scene lies on it: all is terrain.material");
  if (natural.elevation() != nullptr)
    tell_used_voids(scene_.terrain, *natural.elevation(), field_, frame_, problems_);
  if (outside == 0) return;
  const std::string holes =
      in_holes > 0 ? " (" + std::to_string(in_holes) + " in voids too wide to fill)" : "";
  problems_.error(ErrorClass::range, scene_.terrain.place, "terrain extent",
                  std::to_string(outside) + " posts without elevation" + holes + ", the first at " +
                      first_outside.second + " deg",
                  "a smaller extent, or elevation data that cover it");
}

// Where a post lies is worked out as seldom as it may, and what stands there too: half of the time in which a scene is
// opened. On a round Earth a second round asks at the height that the first one found; on a plane one that is the same
// place.
std::optional<double> Ground::post_up_m(const NaturalGround& natural, glm::dvec2 position_m) const {
  const bool round_earth = frame_.model() != terrain::EarthModel::plane;
  const bool by_raster = natural.elevation() != nullptr;
  double up_m = 0.0, height_m = 0.0;
  core::Geodetic g = frame_.origin();  // where nobody asks for latitude and longitude
  for (int round = 0; round < (round_earth ? 2 : 1); ++round) {
    if (round_earth || by_raster || scene_.datum == core::VerticalDatum::egm96)
      g = frame_.to_geodetic({position_m, up_m});
    if (round == 0 || by_raster) {
      const std::optional<double> natural_m = natural.height_m(g, position_m);
      if (!natural_m) return std::nullopt;
      height_m = terrain::flattened_height_m(runways_, position_m, *natural_m) +
                 natural.canopy_m(position_m, zone(position_m));
    }
    up_m += ellipsoidal_m(height_m, g.latitude_rad, g.longitude_rad, scene_.datum) - g.height_m;
  }
  return up_m;
}

std::optional<Ground::LandingEnd> Ground::landing_end(const std::string& name) const {
  for (std::size_t i = 0; i < runways_.size(); ++i) {
    for (const int end : {0, 1}) {
      if (scene_.runways[i].ends[end].name != name) continue;
      const glm::dvec2 direction = end == 0 ? runways_[i].along() : -runways_[i].along();
      return LandingEnd{&runways_[i], &scene_.runways[i], end, runways_[i].threshold_m(end),
                        direction};
    }
  }
  return std::nullopt;
}

core::Geodetic Ground::threshold(const LandingEnd& end) const {
  return frame_.to_geodetic(on_ground_m(end.threshold_m, 0.0));
}

double Ground::bearing_rad(const LandingEnd& end) const {
  const auto& ends = end.description->ends;
  const double azimuth_rad =
      terrain::geodesic_between(ends[end.end].pavement_end, ends[1 - end.end].pavement_end)
          .azimuth_rad;
  return azimuth_rad < 0.0 ? azimuth_rad + 2.0 * core::kPi : azimuth_rad;
}

std::optional<glm::dvec2> Ground::local_m(const Spot& spot) const {
  glm::dvec2 position_m(0.0);
  if (spot.on_runway) {
    const std::optional<LandingEnd> end = landing_end(spot.runway_end);
    if (!end) return std::nullopt;
    position_m = end->threshold_m + end->direction * spot.behind_threshold_m +
                 glm::dvec2(-end->direction.y, end->direction.x) * spot.left_m;
  } else {
    position_m = local_m(spot.latitude_rad, spot.longitude_rad);
  }
  if (field_.height_at(position_m.x, position_m.y)) return position_m;
  problems_.error(ErrorClass::range, spot.place, spot.field, local_text(position_m),
                  "a place on the scene's terrain");
  return std::nullopt;
}

glm::dvec3 Ground::on_ground_m(glm::dvec2 position_m, double above_m) const {
  return {position_m, field_.height_at(position_m.x, position_m.y).value_or(0.0) + above_m};
}

glm::dvec3 Ground::at_height_m(glm::dvec2 position_m, double height_m) const {
  double up_m = 0.0;
  for (int round = 0; round < 3; ++round) {
    const core::Geodetic g = frame_.to_geodetic({position_m, up_m});
    up_m += ellipsoidal_m(height_m, g.latitude_rad, g.longitude_rad, scene_.datum) - g.height_m;
  }
  return {position_m, up_m};
}

glm::dvec3 Ground::local_m(const core::Geodetic& position) const {
  return frame_.to_local_m({position.latitude_rad, position.longitude_rad,
                            ellipsoidal_m(position.height_m, position.latitude_rad,
                                          position.longitude_rad, scene_.datum)});
}

}  // namespace fanbeam::scenes
