#include "benchmarks/naive.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "renderer/casting/nrcs_table.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/stages/azimuth_beam.h"
#include "renderer/stages/point_targets.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"

namespace fanbeam::benchmarks {
namespace {

// Multiples of the golden ratio, shifted from sub-column to sub-column.
double dither(std::size_t index, std::size_t sub_column) {
  const double value = static_cast<double>(index) * 0.6180339887498949 +
                       static_cast<double>(sub_column) * 0.7548776662466927;
  return value - std::floor(value);
}

renderer::PathLossTable path_loss_of(const View& view) {
  // As high above the ground as the ray caster's table goes.
  constexpr double kObjects_m = 300.0;
  const auto& height_m = view.world().surfaces->terrain()->height_m;
  const auto [lowest, highest] = std::minmax_element(height_m.begin(), height_m.end());
  const double sensor_m = view.antenna.position_m.z;
  return {view.world().attenuation, sensor_m, std::min(sensor_m, *lowest),
          std::max(sensor_m, *highest) + kObjects_m};
}

}  // namespace

// Tables that the ray caster, too, makes for each frame.
struct NaiveRenderer::Shared {
  explicit Shared(const View& view)
      : elevation_gain(view.sensor().antenna.elevation),
        path_loss(path_loss_of(view)),
        radar_constant_W_m2(view.sensor().radar_constant_W_m2()) {}

  sensors::TwoWayTable elevation_gain;
  renderer::PathLossTable path_loss;
  double radar_constant_W_m2;
};

NaiveRenderer::NaiveRenderer(const View& view, NaiveKind kind, double rays,
                             const ElevationSpan& span)
    : view_(view),
      kind_(kind),
      sub_columns_(kind == NaiveKind::plain ? 1 : 4),
      all_sub_columns_(view.sensor().scan.columns * sub_columns_ +
                       2 * renderer::margin_sub_columns(view.sensor(), sub_columns_)) {
  const int elevations = std::max(1, static_cast<int>(std::lround(rays / all_sub_columns_)));
  step_rad_ = (span.highest_rad - span.lowest_rad) / elevations;
  for (int i = 0; i < elevations; ++i) {
    const double elevation_rad = span.lowest_rad + (i + 0.5) * step_rad_;
    elevations_rad_.push_back(elevation_rad);
    elevation_turns_.push_back({std::cos(elevation_rad), std::sin(elevation_rad)});
  }
  for (const materials::NrcsCurve& model : view.world().nrcs) nrcs_.emplace_back(model);
}

// Power per radian of azimuth, into the one cell and row that hold the hit.
void NaiveRenderer::cast_ray(const Shared& shared, const Turn& azimuth, std::size_t elevation,
                             double* range_W_per_rad, double* elevation_W_m3_per_rad) const {
  const sensors::Sensor& sensor = view_.sensor();
  const sensors::AntennaFrame& antenna = view_.antenna;
  const auto& [cosine, sine] = elevation_turns_[elevation];
  const bool cone = sensor.scan.surface == sensors::ScanSurface::cone;
  const glm::dvec3 direction =
      cone ? azimuth.cosine * (cosine * antenna.forward + sine * antenna.up) +
                 azimuth.sine * antenna.right
           : cosine * (azimuth.cosine * antenna.forward + azimuth.sine * antenna.right) +
                 sine * antenna.up;
  const auto hit =
      view_.world().surfaces->intersect(antenna.position_m, direction, sensor.range.maximum_m());
  if (!hit) return;
  const double range_m = hit->distance_m;
  const int cell = sensors::range_row(sensor.range, range_m);
  if (cell == sensors::kOutside) return;
  const double elevation_rad = elevations_rad_[elevation];
  const double power_W_per_rad =
      shared.radar_constant_W_m2 * step_rad_ * (cone ? azimuth.cosine : cosine) /
      (range_m * range_m) *
      nrcs_[hit->material].sigma0_over_sine(-glm::dot(hit->normal, direction)) *
      shared.elevation_gain(elevation_rad - sensor.antenna.boresight_elevation_rad) *
      shared.path_loss.two_way_factor(antenna.position_m.z + direction.z * range_m, range_m);
  range_W_per_rad[cell] += power_W_per_rad;
  const int row = sensors::cscope_row(sensor.display, elevation_rad);
  if (row != sensors::kOutside)
    elevation_W_m3_per_rad[row] += power_W_per_rad * range_m * range_m * range_m;
}

NaiveFrame NaiveRenderer::render() const {
  const sensors::Sensor& sensor = view_.sensor();
  const Shared shared(view_);
  renderer::FanSums sums;
  sums.sub_columns = all_sub_columns_;
  sums.step_rad = sensor.scan.column_width_rad() / sub_columns_;
  sums.first_azimuth_rad = -sensor.scan.field_of_view_rad / 2 -
                           renderer::margin_sub_columns(sensor, sub_columns_) * sums.step_rad;
  sums.cells = sensor.range.cells;
  sums.rows = sensor.display.cscope_rows;
  const auto columns = static_cast<std::size_t>(all_sub_columns_);
  const auto cells = static_cast<std::size_t>(sums.cells);
  const auto rows = static_cast<std::size_t>(sums.rows);
  sums.range_W_per_rad.assign(columns * cells, 0.0);
  sums.elevation_W_m3_per_rad.assign(columns * rows, 0.0);
  core::parallel_for(columns, [&](std::size_t column) {
    Turn azimuth{};
    for (std::size_t i = 0; i < elevations_rad_.size(); ++i) {
      if (i == 0 || kind_ == NaiveKind::dithered) {
        const double place = kind_ == NaiveKind::plain ? 0.5 : dither(i, column);
        const double azimuth_rad =
            sums.first_azimuth_rad + (static_cast<double>(column) + place) * sums.step_rad;
        azimuth = {std::cos(azimuth_rad), std::sin(azimuth_rad)};
      }
      cast_ray(shared, azimuth, i, &sums.range_W_per_rad[column * cells],
               &sums.elevation_W_m3_per_rad[column * rows]);
    }
  });
  NaiveFrame frame;
  frame.rays = columns * elevations_rad_.size();
  frame.power.bscope_W =
      renderer::apply_azimuth_beam(sums.range_W_per_rad, sums.cells, sums, sensor, sub_columns_);
  frame.power.cscope_W_m3 = renderer::apply_azimuth_beam(sums.elevation_W_m3_per_rad, sums.rows,
                                                         sums, sensor, sub_columns_);
  renderer::add_echoes(renderer::point_echoes(view_.world(), view_.antenna, view_.pose.time_s),
                       sensor, frame.power.bscope_W, frame.power.cscope_W_m3);
  const FrameGrey grey = grey_of(sensor, frame.power, view_.scene->noise());
  benchmark::DoNotOptimize(sensors::bscope_picture(sensor, grey.bscope));
  benchmark::DoNotOptimize(sensors::cscope_picture(sensor, grey.cscope));
  return frame;
}

}  // namespace fanbeam::benchmarks
