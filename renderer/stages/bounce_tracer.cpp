#include "renderer/stages/bounce_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/plan/largest_echo.h"
#include "sensors/cells.h"
#include "sensors/display/grey_scale.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {
namespace {

using Packet = terrain::RayPacket<BounceTracer::kAtOnce>;

// Where a lane's ray met a surface, from the caster's own floats: rounding of the ray is not an
// error of the point.
struct Hit {
  glm::dvec3 direction{0.0};  // unit
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0};  // unit
  double distance_m = 0.0;
  double sin_grazing = 0.0;

  Hit(const terrain::RayScene& surfaces, const Packet& packet, int i) {
    const glm::dvec3 along(packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]);
    const glm::dvec3 origin_m(packet.origin_x[i], packet.origin_y[i], packet.origin_z[i]);
    const double length = glm::length(along);
    direction = along / length;
    point_m = surfaces.in_scene_m(origin_m + along * static_cast<double>(packet.distance[i]));
    distance_m = length * static_cast<double>(packet.distance[i]);
    normal = glm::normalize(glm::dvec3(packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]));
    sin_grazing = std::min(-glm::dot(direction, normal), 1.0);
  }
};

// Share of the wave's power whose field is perpendicular to the plane of incidence.
double perpendicular_share(const Hit& hit, const glm::dvec3& up, core::Polarisation polarisation) {
  const glm::dvec3 field = glm::cross(hit.direction, up);
  const glm::dvec3 across = glm::cross(hit.direction, hit.normal);
  const double squares = glm::dot(field, field) * glm::dot(across, across);
  if (!(squares > 1e-24)) return 1.0;  // head on, where both polarisations reflect alike
  const double product = glm::dot(field, across);
  const double share = std::min(product * product / squares, 1.0);
  return polarisation == core::Polarisation::horizontal ? share : 1.0 - share;
}

}  // namespace

// The mirrored ray on its way.
struct BounceTracer::Lane {
  glm::dvec3 mirror_m{0.0};
  double first_m = 0.0;  // R1
  double reflection = 0.0;
  glm::dvec3 start_m{0.0};
  glm::dvec3 direction{0.0};
};

namespace {

std::vector<BistaticNrcs> tables(const std::vector<materials::NrcsCurve>& curves) {
  std::vector<BistaticNrcs> tables;
  for (const materials::NrcsCurve& curve : curves) tables.emplace_back(NrcsTable(curve));
  return tables;
}

// The mirror in which even the brightest surface of the world stays black. Filling the whole
// elevation beam of one range cell it returns at most 4 K rho gamma w_az w_el / R^2, to be held
// against the floor of the display. A hundredth of that: 0.04 dB on a cell that is just not black,
// and room for a B that lies at a tenth of the range where its echo appears.
double faintest_mirror(const sensors::Sensor& sensor, const std::vector<BistaticNrcs>& nrcs) {
  constexpr double kShareOfFloor = 0.01;
  double brightest = 0.0;
  for (const BistaticNrcs& surface : nrcs)
    brightest = std::max(brightest, surface.monostatic().largest());
  const double beam_W_m2 = 4.0 * sensor.radar_constant_W_m2() * brightest *
                           azimuth_width_rad(sensor) * elevation_width_rad(sensor);
  const sensors::GreyScale scale(sensor);
  double faintest = 1.0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double range_m = sensors::range_middle_m(sensor.range, row);
    faintest = std::min(faintest,
                        kShareOfFloor * scale.bscope_floor_W(row) * range_m * range_m / beam_W_m2);
  }
  return faintest;
}

}  // namespace

BounceTracer::BounceTracer(const World& world)
    : world_(world),
      nrcs_(tables(world.nrcs)),
      mirrors_(world.specular, nrcs_, world.sensor.wavelength_m()),
      elevation_gain_(world.sensor.antenna.elevation),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()),
      faintest_(faintest_mirror(world.sensor, nrcs_)) {}

std::uint64_t BounceTracer::trace(const sensors::AntennaFrame& antenna, const AntennaRay* rays,
                                  int count, Bounce* bounces) const {
  const double far_m = world_.sensor.range.maximum_m();
  alignas(32) int active[kAtOnce];
  Packet packet;
  for (int i = 0; i < kAtOnce; ++i) {
    const AntennaRay& ray = rays[std::min(i, count - 1)];
    active[i] = i < count ? -1 : 0;
    packet.aim(
        i, world_.surfaces->in_caster_m(antenna.position_m),
        sensors::direction(antenna, ray.azimuth_rad, ray.elevation_rad, world_.sensor.scan.surface),
        far_m);
  }
  world_.surfaces->intersect(active, packet);
  auto cast = static_cast<std::uint64_t>(count);
  Lane lanes[kAtOnce];
  Packet mirrored;
  bool any = false;
  for (int i = 0; i < kAtOnce; ++i) {
    if (i < count) bounces[i] = Bounce{};
    const bool follow = active[i] != 0 && mirror(antenna, packet, i, lanes[i]);
    active[i] = follow ? -1 : 0;
    // B is nearer to p than the farthest range: R2 <= R1 + R3 and R1 + R2 + R3 <= 2 range.
    mirrored.aim(i, world_.surfaces->in_caster_m(follow ? lanes[i].start_m : antenna.position_m),
                 follow ? lanes[i].direction : antenna.forward, far_m);
    if (follow) ++cast;
    any = any || follow;
  }
  if (!any) return cast;
  world_.surfaces->intersect(active, mirrored);
  for (int i = 0; i < count; ++i)
    if (active[i] != 0 && mirrored.geometry[i] != terrain::kNoHit &&
        weigh(antenna, rays[i], lanes[i], mirrored, i, bounces[i]))
      ++cast;
  return cast;
}

bool BounceTracer::mirror(const sensors::AntennaFrame& antenna, const Packet& packet, int i,
                          Lane& lane) const {
  if (packet.geometry[i] == terrain::kNoHit) return false;
  const Hit hit(*world_.surfaces, packet, i);
  if (!(hit.sin_grazing > 0.0 && hit.distance_m > 0.0)) return false;
  const terrain::MaterialId material = world_.surfaces->material(
      packet.geometry[i], packet.primitive[i], hit.point_m.x, hit.point_m.y);
  lane.reflection =
      mirrors_.power(material, hit.sin_grazing,
                     perpendicular_share(hit, antenna.up, world_.sensor.waveform.polarisation));
  if (!(lane.reflection >= faintest_)) return false;
  lane.mirror_m = hit.point_m;
  lane.first_m = hit.distance_m;
  lane.start_m = terrain::secondary_origin_m(hit.point_m, hit.normal, hit.distance_m);
  lane.direction = hit.direction + 2.0 * hit.sin_grazing * hit.normal;
  return true;
}

double BounceTracer::loss_factor(const glm::dvec3& a_m, const glm::dvec3& b_m,
                                 double length_m) const {
  double two_way = 1.0;
  if (!world_.attenuation.is_clear())
    two_way = world_.attenuation.two_way_power_factor(a_m.z, b_m.z, length_m);
  if (world_.rain_cells) two_way *= world_.rain_cells->two_way_power_factor(a_m, b_m);
  return std::sqrt(two_way);
}

bool BounceTracer::weigh(const sensors::AntennaFrame& antenna, const AntennaRay& ray,
                         const Lane& lane, const Packet& packet, int i, Bounce& bounce) const {
  const sensors::Sensor& sensor = world_.sensor;
  const double boresight_rad = sensor.antenna.boresight_elevation_rad;
  const Hit hit(*world_.surfaces, packet, i);
  bounce.met = true;
  if (!(hit.sin_grazing > 0.0)) return false;
  const terrain::MaterialId material = world_.surfaces->material(
      packet.geometry[i], packet.primitive[i], hit.point_m.x, hit.point_m.y);
  const BistaticNrcs& nrcs = nrcs_[material];
  const bool cone = sensor.scan.surface == sensors::ScanSurface::cone;
  const double jacobian = cone ? std::cos(ray.azimuth_rad) : 1.0;  // as in ray_caster.h
  const double first_gain = elevation_gain_(ray.elevation_rad - boresight_rad);
  const double there_m = lane.first_m + hit.distance_m;
  const double there = loss_factor(antenna.position_m, lane.mirror_m, lane.first_m) *
                       loss_factor(lane.mirror_m, hit.point_m, hit.distance_m);
  bounce.image = {there_m, ray.azimuth_rad, ray.elevation_rad,
                  radar_constant_W_m2_ * first_gain * lane.reflection * lane.reflection *
                      nrcs.monostatic().sigma0_over_sine(hit.sin_grazing) * there * there *
                      jacobian / (there_m * there_m)};

  const glm::dvec3 back_m = antenna.position_m - hit.point_m;
  const double back_length_m = glm::length(back_m);
  if (!(back_length_m > 0.0)) return false;
  const glm::dvec3 back = back_m / back_length_m;
  const glm::dvec3 half = back - hit.direction;
  const double half_length = glm::length(half);
  const auto last = sensors::angles(antenna, -back_m, sensor.scan.surface);
  if (!last || !(half_length > 0.0)) return false;
  // Exact for a Gaussian beam: g(x + d) g(x - d) = g(x)^2 g(d)^2.
  const double apart =
      sensors::two_way_gain(sensor.antenna.azimuth, (ray.azimuth_rad - last->azimuth_rad) / 2);
  const double gain =
      std::sqrt(first_gain * elevation_gain_(last->elevation_rad - boresight_rad)) * apart;
  const double scatter = nrcs.sigma0_over_sine(hit.sin_grazing, glm::dot(back, hit.normal),
                                               glm::dot(half, hit.normal) / half_length);
  const double density = 4.0 * radar_constant_W_m2_ * gain * lane.reflection * scatter * there *
                         loss_factor(hit.point_m, antenna.position_m, back_length_m) * jacobian /
                         (back_length_m * back_length_m);
  if (!(density > 0.0)) return false;
  const glm::dvec3 start_m = terrain::secondary_origin_m(hit.point_m, hit.normal, hit.distance_m);
  if (!world_.surfaces->occluded(start_m, antenna.position_m, 0.0))
    bounce.pair = {(there_m + back_length_m) / 2, (ray.azimuth_rad + last->azimuth_rad) / 2,
                   (ray.elevation_rad + last->elevation_rad) / 2, density};
  return true;
}

}  // namespace fanbeam::renderer
