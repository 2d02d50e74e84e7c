#include "live/cigi_answers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "feeds/aircraft_state.h"
#include "scenes/ground_below.h"
#include "terrain/geoid.h"

namespace fanbeam::live {
namespace {

using feeds::cigi::HeightKind;

// Of a place above the ellipsoid: what `datum` lies above that.
double datum_height_m(const core::Geodetic& at, core::VerticalDatum datum) {
  core::Geodetic zero = at;
  zero.height_m = 0.0;
  return terrain::ellipsoidal_height_m(zero, datum);
}

// Where latitude, longitude and altitude, or an offset from an entity, are in the scene's frame.
std::optional<glm::dvec3> local_m(const scenes::Scene& scene, core::VerticalDatum datum,
                                  const glm::dvec3& place, bool is_offset,
                                  const std::optional<core::Pose>& entity) {
  constexpr double kMostOffset_m = 1e6;
  if (is_offset) {
    if (!entity || glm::length(place) > kMostOffset_m) return std::nullopt;
    return scene.frame.to_local_m(entity->position) +
           scene.frame.north_east_down_at(entity->position) * (entity->q_NB * place);
  }
  if (!feeds::is_on_earth(place.x, place.y, place.z)) return std::nullopt;
  core::Geodetic at = feeds::place_on_earth(place.x, place.y, place.z);
  at.height_m += datum_height_m(at, datum);
  return scene.frame.to_local_m(at);
}

struct Normal {
  double azimuth_rad = 0.0, elevation_rad = 0.0;
};

Normal normal_at(const scenes::Scene& scene, const core::Geodetic& at, const glm::dvec3& normal) {
  // Columns are north, east and down.
  const glm::dvec3 turned = glm::normalize(normal) * scene.frame.north_east_down_at(at);
  return {std::atan2(turned.y, turned.x), std::asin(std::clamp(-turned.z, -1.0, 1.0))};
}

struct Line {
  glm::dvec3 direction{0.0};  // unit, of the scene's frame
  double least_m = 0.0, most_m = 0.0;
};

// To the end of a segment, else along a direction: from true north and the horizon of the place, or of
// the entity's nose and wings.
std::optional<Line> line_of(const scenes::Scene& scene, core::VerticalDatum datum,
                            const feeds::cigi::SightRequest& request, const glm::dvec3& from_m,
                            const std::optional<core::Pose>& entity,
                            const std::optional<core::Pose>& end_entity) {
  if (request.segment) {
    const auto end_m = local_m(scene, datum, request.end, request.to_entity, end_entity);
    if (!end_m || !(glm::length(*end_m - from_m) > 0.0)) return std::nullopt;
    return Line{glm::normalize(*end_m - from_m), 0.0, glm::length(*end_m - from_m)};
  }
  const double level = std::cos(request.elevation_rad);
  glm::dvec3 direction{level * std::cos(request.azimuth_rad), level * std::sin(request.azimuth_rad),
                       -std::sin(request.elevation_rad)};
  if (request.from_entity) direction = entity->q_NB * direction;
  const core::Geodetic at =
      request.from_entity ? entity->position : scene.frame.to_geodetic(from_m);
  return Line{scene.frame.north_east_down_at(at) * direction, request.least_m, request.most_m};
}

}  // namespace

feeds::cigi::HeightResponse height_answer(const scenes::Scene& scene, core::VerticalDatum datum,
                                          const feeds::cigi::HeightRequest& request,
                                          const std::optional<core::Pose>& entity) {
  feeds::cigi::HeightResponse answer{request.request, false, request.kind};
  const auto place_m = local_m(scene, datum, request.place, request.of_entity, entity);
  if (!place_m) return answer;
  const core::Geodetic place = scene.frame.to_geodetic(*place_m);
  const auto foot = scenes::ground_below(scene, place);
  if (!foot) return answer;
  answer.valid = true;
  const double above_m = place.height_m - foot->height_m;
  answer.ground_m = foot->height_m - datum_height_m(*foot, datum);
  answer.height_m = request.kind == HeightKind::of ? answer.ground_m : above_m;
  if (request.kind != HeightKind::extended) return answer;
  const glm::dvec3 foot_m = scene.frame.to_local_m(*foot);
  const terrain::RayScene& surfaces = scene.world.surfaces();
  answer.material = surfaces.material(terrain::kTerrainGeometry, 0, foot_m.x, foot_m.y);
  constexpr double kOver_m = 0.3;
  const auto facet =
      surfaces.intersect(foot_m + glm::dvec3(0.0, 0.0, kOver_m), {0.0, 0.0, -1.0}, 2.0 * kOver_m);
  const Normal normal = normal_at(scene, *foot, facet ? facet->normal : glm::dvec3(0.0, 0.0, 1.0));
  answer.normal_azimuth_rad = normal.azimuth_rad;
  answer.normal_elevation_rad = normal.elevation_rad;
  return answer;
}

feeds::cigi::SightResponse sight_answer(const scenes::Scene& scene, core::VerticalDatum datum,
                                        const feeds::cigi::SightRequest& request,
                                        const std::optional<core::Pose>& entity,
                                        const std::optional<core::Pose>& end_entity) {
  constexpr double kMost_m = 200e3;  // of a line
  constexpr double kClear_m = 0.1;   // before its end: what stands there is not in between
  feeds::cigi::SightResponse answer{request.request, request.extended};
  const auto from_m = local_m(scene, datum, request.source, request.from_entity, entity);
  const auto line = from_m && !request.answer_in_entity
                        ? line_of(scene, datum, request, *from_m, entity, end_entity)
                        : std::nullopt;
  if (!line || !(line->most_m > line->least_m) || line->least_m < 0.0 || line->most_m > kMost_m)
    return answer;
  const terrain::RayScene& surfaces = scene.world.surfaces();
  const auto hit = surfaces.intersect(*from_m + line->least_m * line->direction, line->direction,
                                      line->most_m - line->least_m);
  const double range_m = hit ? line->least_m + hit->distance_m : line->most_m;
  answer.visible = request.segment && (!hit || range_m > line->most_m - kClear_m);
  answer.valid = request.segment || hit.has_value();
  if (!answer.valid) return answer;
  answer.range_m = range_m;
  const core::Geodetic at = scene.frame.to_geodetic(*from_m + range_m * line->direction);
  answer.point = {at.latitude_rad, at.longitude_rad, at.height_m - datum_height_m(at, datum)};
  if (!hit) return answer;
  answer.material = hit->material;
  const Normal normal = normal_at(scene, at, hit->normal);
  answer.normal_azimuth_rad = normal.azimuth_rad;
  answer.normal_elevation_rad = normal.elevation_rad;
  return answer;
}

}  // namespace fanbeam::live
