#include "renderer/accuracy/naive_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/errors.h"
#include "core/parallel.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/frame_path_loss.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/casting/sub_column.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
// What all rays of a frame share.
struct NaiveCaster::Frame {
  Frame(const World& world, const sensors::AntennaFrame& axes, bool cscope)
      : antenna(axes),
        path_loss(FramePathLoss(world).from(axes.position_m.z)),
        radar_constant_W_m2(world.sensor.radar_constant_W_m2()),
        with_cscope(cscope) {}

  const sensors::AntennaFrame& antenna;
  PathLossTable path_loss;
  double radar_constant_W_m2;
  bool with_cscope;
};

Sampling naive_sampling(NaiveKind kind, double rays_per_cell) {
  Sampling sampling;
  sampling.sub_columns = kind == NaiveKind::plain ? 1 : 4;
  sampling.rays_per_cell = rays_per_cell / sampling.sub_columns;
  return sampling;
}

ElevationSpan elevation_span(const World& world, const sensors::AntennaFrame& antenna) {
  ElevationSpan span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  const RayCaster caster(world, sampling_for(kDefaultRaysPerCell));
  for (const terrain::RayPacket<16>& packet : caster.packets(antenna)) {
    for (int i = 0; i < 16; ++i) {
      if (packet.near[i] > packet.distance[i]) continue;  // a lane without a ray
      const glm::dvec3 direction(packet.direction_x[i], packet.direction_y[i],
                                 packet.direction_z[i]);
      const auto angles = sensors::angles(antenna, direction, world.sensor.scan.surface);
      if (!angles) continue;
      span.lowest_rad = std::min(span.lowest_rad, angles->elevation_rad);
      span.highest_rad = std::max(span.highest_rad, angles->elevation_rad);
    }
  }
  return span.lowest_rad <= span.highest_rad ? span : ElevationSpan{};
}

NaiveCaster::NaiveCaster(const World& world, NaiveKind kind, double rays, const ElevationSpan& span)
    : world_(world), kind_(kind), elevation_gain_(world.sensor.antenna.elevation) {
  FanSums fan;
  lay_out_fan(world, naive_sampling(kind), false, fan);
  const int elevations = std::max(1, static_cast<int>(std::lround(rays / fan.sub_columns)));
  step_rad_ = (span.highest_rad - span.lowest_rad) / elevations;
  for (int i = 0; i < elevations; ++i) {
    const double elevation_rad = span.lowest_rad + (i + 0.5) * step_rad_;
    elevations_rad_.push_back(elevation_rad);
    elevation_turns_.push_back({std::cos(elevation_rad), std::sin(elevation_rad)});
  }
}

// Power per radian of azimuth, into the one cell and row that hold the hit.
void NaiveCaster::cast_ray(const Frame& frame, const Turn& azimuth, std::size_t elevation,
                           double* range_W_per_rad, double* elevation_W_m3_per_rad,
                           Counts& counts) const {
  const sensors::Sensor& sensor = world_.sensor;
  const sensors::AntennaFrame& antenna = frame.antenna;
  const auto& [cosine, sine] = elevation_turns_[elevation];
  const bool cone = sensor.scan.surface == sensors::ScanSurface::cone;
  const glm::dvec3 direction =
      cone ? azimuth.cosine * (cosine * antenna.forward + sine * antenna.up) +
                 azimuth.sine * antenna.right
           : cosine * (azimuth.cosine * antenna.forward + azimuth.sine * antenna.right) +
                 sine * antenna.up;
  const auto hit =
      world_.surfaces().intersect(antenna.position_m, direction, sensor.range.maximum_m());
  if (!hit) return;
  ++counts.hits;
  const double range_m = hit->distance_m;
  const int cell = sensors::range_row(sensor.range, range_m);
  if (cell == sensors::kOutside) {
    counts.blanked += range_m < sensor.range.minimum_m ? 1 : 0;
    return;
  }
  const double elevation_rad = elevations_rad_[elevation];
  double power_W_per_rad =
      frame.radar_constant_W_m2 * step_rad_ * (cone ? std::max(azimuth.cosine, 0.0) : 1.0) /
      (range_m * range_m) *
      world_.nrcs.tables()[hit->material].sigma0_over_sine(-glm::dot(hit->normal, direction)) *
      elevation_gain_(elevation_rad - sensor.antenna.boresight_elevation_rad) *
      frame.path_loss.two_way_factor(antenna.position_m.z + direction.z * range_m, range_m);
  if (world_.rain_cells)
    power_W_per_rad *= world_.rain_cells->two_way_power_factor(
        antenna.position_m, antenna.position_m + range_m * direction);
  range_W_per_rad[cell] += power_W_per_rad;
  const int row =
      frame.with_cscope ? sensors::cscope_row(sensor.display, elevation_rad) : sensors::kOutside;
  if (row != sensors::kOutside)
    elevation_W_m3_per_rad[row] += power_W_per_rad * range_m * range_m * range_m;
}

NaiveCaster::Counts NaiveCaster::cast_sub_column(const Frame& frame, std::size_t sub_column,
                                                 FanSums& sums) const {
  const auto cells = static_cast<std::size_t>(sums.cells);
  const auto rows = static_cast<std::size_t>(sums.rows);
  Counts counts;
  Turn azimuth{};
  for (std::size_t i = 0; i < elevations_rad_.size(); ++i) {
    if (i == 0 || kind_ == NaiveKind::dithered) {
      const double place = kind_ == NaiveKind::plain ? 0.5
                                                     : dither(static_cast<std::uint32_t>(i),
                                                              static_cast<int>(sub_column), 0);
      const double azimuth_rad =
          sums.first_azimuth_rad + (static_cast<double>(sub_column) + place) * sums.step_rad;
      azimuth = {std::cos(azimuth_rad), std::sin(azimuth_rad)};
    }
    cast_ray(frame, azimuth, i, sums.range_W_per_rad.data() + sub_column * cells,
             sums.elevation_W_m3_per_rad.data() + sub_column * rows, counts);
  }
  return counts;
}

void NaiveCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope, const CastPass& pass,
                       FanSums& sums, SightLines& sight) const {
  if (pass.level != 0 || pass.groups != nullptr)
    throw core::InternalError("a naive renderer refines nothing");
  sight.clear.assign(sight.to_m.size(), kAskRays);
  look_along_rays(world_.surfaces(), antenna.position_m, sight);
  lay_out_fan(world_, naive_sampling(kind_), with_cscope, sums);
  std::fill(sums.range_W_per_rad.begin(), sums.range_W_per_rad.end(), 0.0);
  std::fill(sums.elevation_W_m3_per_rad.begin(), sums.elevation_W_m3_per_rad.end(), 0.0);
  const Frame frame(world_, antenna, with_cscope);
  std::vector<Counts> counts(static_cast<std::size_t>(sums.sub_columns));
  core::parallel_for(counts.size(),
                     [&](std::size_t i) { counts[i] = cast_sub_column(frame, i, sums); });
  sums.rays = counts.size() * elevations_rad_.size();
  for (const Counts& count : counts) {
    sums.hits += count.hits;
    sums.blanked += count.blanked;
  }
}

}  // namespace fanbeam::renderer
