#include "renderer/stages/bounce_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/series.h"
#include "renderer/casting/ray_aim.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/bounce_limits.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {

// Where a lane's ray met a surface, from the caster's own floats: rounding of the ray is not an
// error of the point.
struct BounceTracer::Hit {
  glm::dvec3 direction{0.0};  // unit
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0};  // unit
  double distance_m = 0.0;
  double sin_grazing = 0.0;
  terrain::MaterialId material = 0;

  template <int N>
  Hit(const terrain::RayScene& surfaces, const terrain::RayPacket<N>& packet, int i) {
    const glm::dvec3 along(packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]);
    const glm::dvec3 origin_m(packet.origin_x[i], packet.origin_y[i], packet.origin_z[i]);
    const double length = glm::length(along);
    direction = along / length;
    point_m = surfaces.in_scene_m(origin_m + along * static_cast<double>(packet.distance[i]));
    distance_m = length * static_cast<double>(packet.distance[i]);
    normal = glm::normalize(glm::dvec3(packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]));
    sin_grazing = std::min(-glm::dot(direction, normal), 1.0);
    if (sin_grazing > 0.0)
      material = surfaces.material(packet.geometry[i], packet.primitive[i], point_m.x, point_m.y);
  }
};

// A mirrored ray on its way.
struct BounceTracer::Lane {
  std::size_t ray = 0;  // that it comes from
  glm::dvec3 mirror_m{0.0};
  glm::dvec3 first_direction{0.0};
  glm::dvec3 normal{0.0};  // of the mirror
  double first_m = 0.0;    // R1
  double reflection = 0.0;
  glm::dvec3 start_m{0.0};
  glm::dvec3 direction{0.0};
};

// From the antenna by way of the mirror to what was met.
struct BounceTracer::Way {
  double length_m = 0.0, m_per_rad = 0.0;  // and its derivative by the ray's elevation
  glm::dvec3 point_m_per_rad{0.0};         // that of the point
};

// The way back of a pair that would show.
struct BounceTracer::Return {
  std::size_t ray = 0;
  glm::dvec3 start_m{0.0};
};

// Of one thread, kept from call to call.
struct BounceTracer::Scratch {
  std::vector<Lane> lanes;
  std::vector<Return> returns;
};

namespace {

// Share of the wave's power whose field is perpendicular to the plane of incidence.
double perpendicular_share(const glm::dvec3& direction, const glm::dvec3& normal,
                           const glm::dvec3& up, core::Polarisation polarisation) {
  const glm::dvec3 field = glm::cross(direction, up);
  const glm::dvec3 across = glm::cross(direction, normal);
  const double squares = glm::dot(field, field) * glm::dot(across, across);
  if (!(squares > 1e-24)) return 1.0;  // head on, where both polarisations reflect alike
  const double product = glm::dot(field, across);
  const double share = std::min(product * product / squares, 1.0);
  return polarisation == core::Polarisation::horizontal ? share : 1.0 - share;
}

double power_left(double loss_dB) {
  constexpr double kNepersPerDB = 0.23025850929940456840;  // ln 10 / 10
  return core::series_decay(kNepersPerDB * loss_dB);
}

glm::dvec3 in_scene(const sensors::AntennaFrame& antenna, const AxisWeights& w) {
  return w.forward * antenna.forward + w.right * antenna.right + w.up * antenna.up;
}

AxisWeights ray_weights(const AntennaRay& ray, bool cone) {
  double ce = 0.0, se = 0.0, ca = 0.0, sa = 0.0;
  core::series_cosine_sine(ray.elevation_rad, ce, se);
  if (std::abs(ray.azimuth_rad) <= core::kPi / 2) {
    core::series_cosine_sine(ray.azimuth_rad, ca, sa);
  } else {  // of a fan wider than the series
    ca = std::cos(ray.azimuth_rad);
    sa = std::sin(ray.azimuth_rad);
  }
  return direction_weights(cone, ce, se, ca, sa);
}

// Cosines and sines of a direction's angles, from its parts along the axes.
struct AngleParts {
  double ce, se, ca, sa;
};
AngleParts angle_parts(const sensors::AntennaFrame& antenna, const glm::dvec3& direction,
                       bool cone) {
  const double forward = glm::dot(direction, antenna.forward);
  const double right = glm::dot(direction, antenna.right);
  const double up = glm::dot(direction, antenna.up);
  const double flat = std::sqrt(forward * forward + (cone ? up * up : right * right));
  const double inverse = flat > 1e-9 ? 1.0 / flat : 0.0;
  if (cone) return {forward * inverse, up * inverse, flat, right};
  return {flat, up, forward * inverse, right * inverse};
}

}  // namespace

BounceTracer::BounceTracer(const World& world, bool noise)
    : world_(world),
      nrcs_(world.nrcs.bistatic()),
      mirrors_(world.specular, nrcs_, world.sensor.wavelength_m()),
      elevation_gain_(world.sensor.antenna.elevation),
      beam_tangent_(widest_tangent(world.sensor.antenna.azimuth)),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()),
      faintest_W_per_rad2_(faintest_echoes_W_per_rad2(world.sensor, noise)),
      faintest_mirror_(faintest_mirror(world.sensor, nrcs_, faintest_W_per_rad2_)) {}

// Casts any number of rays, N at a time.
template <int N>
class BounceTracer::Packets {
 public:
  explicit Packets(const terrain::RayScene& surfaces) : surfaces_(surfaces) {}

  // `aim(packet, lane, i)` makes ray i that lane's; `take(packet, lane, i)` sees what it has met.
  template <class Aim, class Take>
  void intersect(std::size_t count, const Aim& aim, const Take& take) {
    cast(count, aim, take, [this] { surfaces_.intersect(active_, packet_); });
  }
  template <class Aim, class Take>
  void find_occluded(std::size_t count, const Aim& aim, const Take& take) {
    cast(count, aim, take, [this] { surfaces_.find_occluded(active_, packet_); });
  }

 private:
  template <class Aim, class Take, class Cast>
  void cast(std::size_t count, const Aim& aim, const Take& take, const Cast& cast) {
    for (std::size_t first = 0; first < count; first += N) {
      const int some = static_cast<int>(std::min<std::size_t>(N, count - first));
      for (int lane = 0; lane < N; ++lane) {
        active_[lane] = lane < some ? -1 : 0;
        aim(packet_, lane, first + static_cast<std::size_t>(std::min(lane, some - 1)));
      }
      cast();
      for (int lane = 0; lane < some; ++lane)
        take(packet_, lane, first + static_cast<std::size_t>(lane));
    }
  }

  const terrain::RayScene& surfaces_;
  terrain::RayPacket<N> packet_;
  alignas(64) int active_[N];
};

std::uint64_t BounceTracer::trace(const sensors::AntennaFrame& antenna,
                                  const std::vector<AntennaRay>& rays,
                                  std::vector<Bounce>& bounces) const {
  return world_.surfaces().native_packet() == 16 ? trace_packets<16>(antenna, rays, bounces)
                                                 : trace_packets<8>(antenna, rays, bounces);
}

template <int N>
std::uint64_t BounceTracer::trace_packets(const sensors::AntennaFrame& antenna,
                                          const std::vector<AntennaRay>& rays,
                                          std::vector<Bounce>& bounces) const {
  thread_local Scratch scratch;
  scratch.lanes.clear();
  scratch.returns.clear();
  const std::size_t first = bounces.size();
  bounces.resize(rays.size());
  Packets<N> packets(world_.surfaces());
  find_mirrors(antenna, rays, first, packets, scratch.lanes);
  follow(antenna, rays, scratch.lanes, packets, bounces, scratch.returns);
  look_back(antenna, scratch.returns, packets, bounces);
  return rays.size() - first + scratch.lanes.size() + scratch.returns.size();
}

// What the rays from `first` on meet, if that is a mirror.
template <int N>
void BounceTracer::find_mirrors(const sensors::AntennaFrame& antenna,
                                const std::vector<AntennaRay>& rays, std::size_t first,
                                Packets<N>& packets, std::vector<Lane>& lanes) const {
  const terrain::RayScene& surfaces = world_.surfaces();
  const bool cone = is_cone();
  const glm::dvec3 antenna_m = surfaces.in_caster_m(antenna.position_m);
  const double far_m = world_.sensor.range.maximum_m();
  packets.intersect(
      rays.size() - first,
      [&](terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        packet.aim(lane, antenna_m, in_scene(antenna, ray_weights(rays[first + i], cone)), far_m);
      },
      [&](const terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        if (packet.geometry[lane] == terrain::kNoHit) return;
        Lane mirrored;
        mirrored.ray = first + i;
        if (mirror(antenna, Hit(surfaces, packet, lane), mirrored)) lanes.push_back(mirrored);
      });
}

// How far behind the mirror an echo may come from: where R1 + R2 + R3 is twice the farthest range,
// R3 being the third side of a triangle. The image's range, R1 + R2, is no shorter there.
double BounceTracer::farthest_m(const Lane& lane) const {
  constexpr double kMargin_m = 1.0;  // of the mirror's place
  const sensors::RangeGate& gate = world_.sensor.range;
  const double range_m = gate.maximum_m() + kSpreadCells * gate.cell_m + kMargin_m;
  const double turn = glm::dot(lane.first_direction, lane.direction);
  return 2.0 * range_m * (range_m - lane.first_m) / (2.0 * range_m - lane.first_m * (1.0 - turn));
}

// What the mirrored rays meet, and which of it has a way back to look for.
template <int N>
void BounceTracer::follow(const sensors::AntennaFrame& antenna, const std::vector<AntennaRay>& rays,
                          const std::vector<Lane>& lanes, Packets<N>& packets,
                          std::vector<Bounce>& bounces, std::vector<Return>& returns) const {
  const terrain::RayScene& surfaces = world_.surfaces();
  packets.intersect(
      lanes.size(),
      [&](terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        packet.aim(lane, surfaces.in_caster_m(lanes[i].start_m), lanes[i].direction,
                   farthest_m(lanes[i]));
      },
      [&](const terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        if (packet.geometry[lane] == terrain::kNoHit) return;
        const Lane& mirrored = lanes[i];
        const Hit hit(surfaces, packet, lane);
        if (!(hit.sin_grazing > 0.0)) return;
        if (weigh(antenna, rays[mirrored.ray], mirrored, hit, bounces[mirrored.ray]))
          returns.push_back(
              {mirrored.ray, terrain::secondary_origin_m(hit.point_m, hit.normal, hit.distance_m)});
      });
}

// Takes back pairs whose B does not see O.
template <int N>
void BounceTracer::look_back(const sensors::AntennaFrame& antenna,
                             const std::vector<Return>& returns, Packets<N>& packets,
                             std::vector<Bounce>& bounces) const {
  const terrain::RayScene& surfaces = world_.surfaces();
  const glm::dvec3 antenna_m = surfaces.in_caster_m(antenna.position_m);
  packets.find_occluded(
      returns.size(),
      [&](terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        const glm::dvec3 start_m = surfaces.in_caster_m(returns[i].start_m);
        packet.aim(lane, start_m, antenna_m - start_m, 1.0);
      },
      [&](const terrain::RayPacket<N>& packet, int lane, std::size_t i) {
        if (packet.distance[lane] < 0.0F) bounces[returns[i].ray].pair = BounceEcho{};
      });
}

// The image of the antenna looks along the mirrored ray, at the plane of the facet that was met.
BounceTracer::Way BounceTracer::way_to(const sensors::AntennaFrame& antenna, const Lane& lane,
                                       const Hit& hit) const {
  const AngleParts p = angle_parts(antenna, lane.first_direction, is_cone());
  glm::dvec3 higher = in_scene(antenna, elevation_derivative(is_cone(), p.ce, p.se, p.ca, p.sa));
  higher -= 2.0 * glm::dot(higher, lane.normal) * lane.normal;
  Way way;
  way.length_m = lane.first_m + hit.distance_m;
  way.m_per_rad = way.length_m * glm::dot(higher, hit.normal) / hit.sin_grazing;
  way.point_m_per_rad = way.length_m * higher + way.m_per_rad * hit.direction;
  return way;
}

// True when there is a pair.
bool BounceTracer::weigh(const sensors::AntennaFrame& antenna, const AntennaRay& ray,
                         const Lane& lane, const Hit& hit, Bounce& bounce) const {
  const Way way = way_to(antenna, lane, hit);
  const BounceEcho image = image_of(ray, lane, hit, way);
  const BounceEcho pair = pair_of(antenna, ray, lane, hit, way);
  const bool image_shows = shows(image), pair_shows = shows(pair);
  if (!image_shows && !pair_shows) return false;
  const double there_dB = loss_dB(antenna.position_m, lane.mirror_m, lane.first_m) +
                          loss_dB(lane.mirror_m, hit.point_m, hit.distance_m);
  if (image_shows) {
    bounce.image = image;
    bounce.image.left = power_left(2.0 * there_dB);
  }
  if (!pair_shows) return false;
  const double back_m = glm::distance(hit.point_m, antenna.position_m);
  bounce.pair = pair;
  bounce.pair.left = power_left(there_dB + loss_dB(hit.point_m, antenna.position_m, back_m));
  return true;
}

bool BounceTracer::mirror(const sensors::AntennaFrame& antenna, const Hit& hit, Lane& lane) const {
  if (!(hit.sin_grazing > 0.0 && hit.distance_m > 0.0)) return false;
  lane.reflection = mirrors_.power(hit.material, hit.sin_grazing,
                                   perpendicular_share(hit.direction, hit.normal, antenna.up,
                                                       world_.sensor.waveform.polarisation));
  if (!(lane.reflection >= faintest_mirror_)) return false;
  lane.mirror_m = hit.point_m;
  lane.first_m = hit.distance_m;
  lane.first_direction = hit.direction;
  lane.normal = hit.normal;
  lane.start_m = terrain::secondary_origin_m(hit.point_m, hit.normal, hit.distance_m);
  lane.direction = hit.direction + 2.0 * hit.sin_grazing * hit.normal;
  return true;
}

double BounceTracer::loss_dB(const glm::dvec3& a_m, const glm::dvec3& b_m, double length_m) const {
  double one_way_dB = 0.0;
  if (!world_.attenuation.is_clear())
    one_way_dB = world_.attenuation.one_way_dB(a_m.z, b_m.z, length_m);
  if (world_.rain_cells) one_way_dB += world_.rain_cells->one_way_dB(a_m, b_m);
  return one_way_dB;
}

// As in ray_caster.h.
double BounceTracer::jacobian(const AntennaRay& ray) const {
  return is_cone() ? std::cos(ray.azimuth_rad) : 1.0;
}

bool BounceTracer::shows(const BounceEcho& echo) const {
  const sensors::RangeGate& gate = world_.sensor.range;
  // What a ray stands for may reach beyond it by a cell or two.
  const double cell = (echo.range_m - gate.minimum_m) / gate.cell_m;
  if (!(cell > -kSpreadCells && cell < gate.cells + kSpreadCells)) return false;
  const auto at = static_cast<std::size_t>(std::clamp(cell, 0.0, gate.cells - 1.0));
  return echo.density_W_per_rad2 > faintest_W_per_rad2_[at];
}

BounceEcho BounceTracer::image_of(const AntennaRay& ray, const Lane& lane, const Hit& hit,
                                  const Way& way) const {
  const double gain =
      elevation_gain_(ray.elevation_rad - world_.sensor.antenna.boresight_elevation_rad);
  BounceEcho echo;
  echo.range_m = way.length_m;
  echo.range_m_per_rad = way.m_per_rad;
  echo.azimuth_rad = ray.azimuth_rad;
  echo.elevation_rad = ray.elevation_rad;
  echo.elevation_rate = 1.0;
  echo.density_W_per_rad2 = radar_constant_W_m2_ * gain * lane.reflection * lane.reflection *
                            nrcs_[hit.material].monostatic().sigma0_over_sine(hit.sin_grazing) *
                            jacobian(ray) / (way.length_m * way.length_m);
  return echo;
}

// Whether the azimuths of two directions of a plane scan are so close that a beam between them sees
// both: most mirrored rays end elsewhere, and need no arc tangent.
bool BounceTracer::within_beam(const sensors::AntennaFrame& antenna, const glm::dvec3& first,
                               const glm::dvec3& last) const {
  const double forward = glm::dot(first, antenna.forward), right = glm::dot(first, antenna.right);
  const double last_forward = glm::dot(last, antenna.forward);
  const double last_right = glm::dot(last, antenna.right);
  const double along = forward * last_forward + right * last_right;
  return std::abs(forward * last_right - right * last_forward) <= beam_tangent_ * along;
}

BounceEcho BounceTracer::pair_of(const sensors::AntennaFrame& antenna, const AntennaRay& ray,
                                 const Lane& lane, const Hit& hit, const Way& way) const {
  const sensors::Sensor& sensor = world_.sensor;
  const double boresight_rad = sensor.antenna.boresight_elevation_rad;
  const bool cone = is_cone();
  const glm::dvec3 line_m = hit.point_m - antenna.position_m;
  const double back_m = glm::length(line_m);
  if (!(back_m > 0.0) || (!cone && !within_beam(antenna, lane.first_direction, line_m))) return {};
  const auto last = sensors::angles(antenna, line_m, sensor.scan.surface);
  if (!last) return {};
  const glm::dvec3 line = line_m / back_m;
  const glm::dvec3 half = -line - hit.direction;
  const double half_length = glm::length(half);
  if (!(half_length > 0.0)) return {};
  // Exact for a Gaussian beam: g(x + d) g(x - d) = g(x)^2 g(d)^2.
  const double apart =
      sensors::two_way_gain(sensor.antenna.azimuth, (ray.azimuth_rad - last->azimuth_rad) / 2);
  if (!(apart > 0.0)) return {};
  const double gain = std::sqrt(elevation_gain_(ray.elevation_rad - boresight_rad) *
                                elevation_gain_(last->elevation_rad - boresight_rad)) *
                      apart;
  const double scatter = nrcs_[hit.material].sigma0_over_sine(
      hit.sin_grazing, -glm::dot(line, hit.normal), glm::dot(half, hit.normal) / half_length);

  const glm::dvec3& moves = way.point_m_per_rad;
  const glm::dvec3 turns = (moves - glm::dot(moves, line) * line) / back_m;
  const AngleParts p = angle_parts(antenna, line, cone);
  const glm::dvec3 up = in_scene(antenna, elevation_derivative(cone, p.ce, p.se, p.ca, p.sa));

  BounceEcho echo;
  echo.range_m = (way.length_m + back_m) / 2;
  echo.range_m_per_rad = (way.m_per_rad + glm::dot(moves, line)) / 2;
  echo.azimuth_rad = (ray.azimuth_rad + last->azimuth_rad) / 2;
  echo.elevation_rad = (ray.elevation_rad + last->elevation_rad) / 2;
  echo.elevation_rate = (1.0 + glm::dot(turns, up) / std::max(glm::dot(up, up), 1e-6)) / 2;
  echo.density_W_per_rad2 = 4.0 * radar_constant_W_m2_ * gain * lane.reflection * scatter *
                            jacobian(ray) / (back_m * back_m);
  return echo;
}

}  // namespace fanbeam::renderer
