#include "session/figure/runway_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/constants.h"
#include "sensors/cells.h"

namespace fanbeam::session {
namespace {

constexpr int kSteps = 256;  // of a centre line

std::optional<SeenPoint> seen_from(const sensors::AntennaFrame& antenna,
                                   const sensors::Sensor& sensor, const glm::dvec3& up,
                                   const glm::dvec3& point_m) {
  const glm::dvec3 away_m = point_m - antenna.position_m;
  const auto angles = sensors::angles(antenna, away_m, sensor);
  // Side lobes hear what is behind; no column of the picture is for it.
  const double ahead_rad = std::max(sensor.scan.field_of_view_rad / 2, core::kPi / 2);
  if (!angles || std::abs(angles->azimuth_rad) > ahead_rad) return std::nullopt;
  const double range_m = glm::length(away_m);
  return SeenPoint{range_m, angles->azimuth_rad, angles->elevation_rad,
                   std::asin(std::clamp(glm::dot(away_m, up) / range_m, -1.0, 1.0))};
}

RunwayView view_of(const scenes::RunwayPlace& runway, const sensors::Sensor& sensor,
                   const sensors::AntennaFrame& antenna, const glm::dvec3& up) {
  const glm::dvec3 along_m = runway.ends[1].threshold_m - runway.ends[0].threshold_m;
  const int near = glm::dot(along_m, antenna.forward) >= 0.0 ? 0 : 1;
  const glm::dvec3 from_m = runway.ends[near].threshold_m;
  const glm::dvec3 to_m = runway.ends[1 - near].threshold_m;
  RunwayView view;
  view.name = runway.ends[near].name;
  const std::optional<SeenPoint> threshold = seen_from(antenna, sensor, up, from_m);
  view.threshold_ahead = threshold.has_value();
  view.threshold = threshold.value_or(SeenPoint{glm::length(from_m - antenna.position_m)});
  for (int step = 0; step <= kSteps; ++step) {
    const double share = static_cast<double>(step) / kSteps;
    const auto point = seen_from(antenna, sensor, up, from_m + share * (to_m - from_m));
    if (point && sensors::range_row(sensor.range, point->range_m) != sensors::kOutside &&
        sensors::azimuth_column(sensor.scan, point->azimuth_rad) != sensors::kOutside)
      view.seen.push_back(*point);
  }
  return view;
}

}  // namespace

std::vector<RunwayView> runway_views(const std::vector<scenes::RunwayPlace>& runways,
                                     const sensors::Sensor& sensor,
                                     const sensors::AntennaFrame& antenna, const glm::dvec3& up) {
  std::vector<RunwayView> views;
  for (const scenes::RunwayPlace& runway : runways)
    views.push_back(view_of(runway, sensor, antenna, up));
  return views;
}

}  // namespace fanbeam::session
