#include "session/labels/place.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"

namespace fanbeam::session {

Eye::Eye(const scenes::Scene& scene, const core::Pose& pose)
    : scene_(scene), pose_(scene.pose_at(pose)), antenna_(renderer::antenna_of(sensor(), pose_)) {}

std::optional<sensors::AntennaAngles> Eye::angles_of(const glm::dvec3& at_m) const {
  return sensors::angles(antenna_, at_m - antenna_.position_m, sensor());
}

PictureSpot Eye::bscope_spot(double azimuth_rad, double range_m) const {
  const sensors::Sensor& by = sensor();
  PictureSpot spot;
  spot.at_px = {(azimuth_rad / by.scan.field_of_view_rad + 0.5) * by.scan.columns,
                by.range.cells - (range_m - by.range.minimum_m) / by.range.cell_m};
  spot.inside = spot.at_px.x >= 0.0 && spot.at_px.x < by.scan.columns && spot.at_px.y > 0.0 &&
                spot.at_px.y <= by.range.cells;
  return spot;
}

PictureSpot Eye::cscope_spot(double azimuth_rad, double elevation_rad, double range_m) const {
  const sensors::Sensor& by = sensor();
  PictureSpot spot;
  spot.at_px = {(azimuth_rad / by.scan.field_of_view_rad + 0.5) * by.scan.columns,
                (by.display.cscope_top_rad - elevation_rad) / by.display.cscope_span_rad *
                    by.display.cscope_rows};
  // It is made of the same echoes: those inside the gate.
  spot.inside = bscope_spot(azimuth_rad, range_m).inside && spot.at_px.y >= 0.0 &&
                spot.at_px.y < by.display.cscope_rows;
  return spot;
}

std::optional<PictureSpot> Eye::in_bscope(const glm::dvec3& at_m) const {
  const auto angles = angles_of(at_m);
  if (!angles) return std::nullopt;
  return bscope_spot(angles->azimuth_rad, glm::length(at_m - antenna_.position_m));
}

bool Eye::sees(const glm::dvec3& at_m, double clearance_m) const {
  return !scene_.world.surfaces().occluded(antenna_.position_m, at_m, clearance_m);
}

PlaceLabel Eye::look_at(const glm::dvec3& at_m) const {
  PlaceLabel label;
  label.position = scene_.frame.to_geodetic(at_m);
  const glm::dvec3 from_antenna_m = at_m - antenna_.position_m;
  label.range_m = glm::length(from_antenna_m);
  const glm::dvec3 ned = from_antenna_m * pose_.north_east_down;
  label.bearing_rad = core::radians(core::wrap_360_deg(core::degrees(std::atan2(ned.y, ned.x))));
  label.in_sight = sees(at_m + kSightHeight_m * -pose_.north_east_down[2]);
  if (const auto angles = angles_of(at_m)) {
    label.azimuth_rad = angles->azimuth_rad;
    label.elevation_rad = angles->elevation_rad;
    label.bscope = bscope_spot(angles->azimuth_rad, label.range_m);
    label.cscope = cscope_spot(angles->azimuth_rad, angles->elevation_rad, label.range_m);
  }
  return label;
}

}  // namespace fanbeam::session
