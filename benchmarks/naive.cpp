#include "benchmarks/naive.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "renderer/azimuth_beam.h"
#include "renderer/nrcs_table.h"
#include "renderer/path_loss_table.h"
#include "renderer/point_targets.h"
#include "renderer/ray_caster.h"
#include "sensors/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display.h"

namespace fanbeam::benchmarks {
namespace {

// What a frame needs besides the scene, made anew for each frame as the ray caster does.
struct FrameTables {
  explicit FrameTables(const View& view)
      : world(view.world()),
        antenna(view.antenna),
        elevation_gain(world.sensor.antenna.elevation),
        path_loss(world.attenuation, antenna.position_m.z, lowest_m(), highest_m()),
        radar_constant_W_m2(world.sensor.radar_constant_W_m2()) {
    for (const materials::PhongNrcs& model : world.nrcs) nrcs.emplace_back(model);
  }

  double lowest_m() const {
    const auto& height_m = world.surfaces->terrain()->height_m;
    return std::min(antenna.position_m.z, *std::min_element(height_m.begin(), height_m.end()));
  }
  double highest_m() const {
    const auto& height_m = world.surfaces->terrain()->height_m;
    return std::max(antenna.position_m.z, *std::max_element(height_m.begin(), height_m.end())) + 300;
  }

  const renderer::World& world;
  const sensors::AntennaFrame& antenna;
  sensors::TwoWayTable elevation_gain;
  renderer::PathLossTable path_loss;
  std::vector<renderer::NrcsTable> nrcs;
  double radar_constant_W_m2;
};

// Multiples of the golden ratio, shifted from sub-column to sub-column.
double dither(int index, std::size_t sub_column) {
  const double value =
      index * 0.6180339887498949 + static_cast<double>(sub_column) * 0.7548776662466927;
  return value - std::floor(value);
}

// Power per radian of azimuth of one ray that stands for `step_rad` of elevation, into its cell.
void cast_ray(const FrameTables& tables, double azimuth_rad, double elevation_rad, double step_rad,
              double* range_W_per_rad, double* elevation_W_m3_per_rad) {
  const sensors::Sensor& sensor = tables.world.sensor;
  const glm::dvec3 direction =
      sensors::direction(tables.antenna, azimuth_rad, elevation_rad, sensor.scan.surface);
  const auto hit = tables.world.surfaces->intersect(tables.antenna.position_m, direction,
                                                    sensor.range.maximum_m());
  if (!hit) return;
  const double range_m = hit->distance_m;
  const int cell = sensors::range_row(sensor.range, range_m);
  if (cell == sensors::kOutside) return;
  const double height_m = tables.antenna.position_m.z + direction.z * range_m;
  const double jacobian = sensor.scan.surface == sensors::ScanSurface::cone
                              ? std::cos(azimuth_rad)
                              : std::cos(elevation_rad);
  const double power_W_per_rad =
      tables.radar_constant_W_m2 * step_rad * jacobian / (range_m * range_m) *
      tables.nrcs[hit->material].sigma0_over_sine(-glm::dot(hit->normal, direction)) *
      tables.elevation_gain(elevation_rad - sensor.antenna.boresight_elevation_rad) *
      tables.path_loss.two_way_factor(height_m, range_m);
  range_W_per_rad[cell] += power_W_per_rad;
  const int row = sensors::cscope_row(sensor.display, elevation_rad);
  if (row != sensors::kOutside)
    elevation_W_m3_per_rad[row] += power_W_per_rad * range_m * range_m * range_m;
}

}  // namespace

NaiveRenderer::NaiveRenderer(const View& view, NaiveKind kind, double rays,
                             const ElevationSpan& span)
    : view_(view),
      kind_(kind),
      sub_columns_(kind == NaiveKind::plain ? 1 : 4),
      all_sub_columns_(view.sensor().scan.columns * sub_columns_ +
                       2 * renderer::margin_sub_columns(view.sensor(), sub_columns_)),
      elevations_(std::max(1, static_cast<int>(std::lround(rays / all_sub_columns_)))),
      span_(span) {}

NaiveFrame NaiveRenderer::render() const {
  const sensors::Sensor& sensor = view_.sensor();
  const FrameTables tables(view_);
  renderer::FanSums sums;
  sums.sub_columns = all_sub_columns_;
  sums.step_rad = sensor.scan.column_width_rad() / sub_columns_;
  sums.first_azimuth_rad =
      -sensor.scan.field_of_view_rad / 2 -
      renderer::margin_sub_columns(sensor, sub_columns_) * sums.step_rad;
  sums.cells = sensor.range.cells;
  sums.rows = sensor.display.cscope_rows;
  const auto columns = static_cast<std::size_t>(all_sub_columns_);
  const auto cells = static_cast<std::size_t>(sums.cells);
  const auto rows = static_cast<std::size_t>(sums.rows);
  sums.range_W_per_rad.assign(columns * cells, 0.0);
  sums.elevation_W_m3_per_rad.assign(columns * rows, 0.0);
  const double step_rad = (span_.highest_rad - span_.lowest_rad) / elevations_;
  core::parallel_for(columns, [&](std::size_t column) {
    for (int i = 0; i < elevations_; ++i) {
      const double place = kind_ == NaiveKind::plain ? 0.5 : dither(i, column);
      const double azimuth_rad =
          sums.first_azimuth_rad + (static_cast<double>(column) + place) * sums.step_rad;
      cast_ray(tables, azimuth_rad, span_.lowest_rad + (i + 0.5) * step_rad, step_rad,
               &sums.range_W_per_rad[column * cells], &sums.elevation_W_m3_per_rad[column * rows]);
    }
  });
  NaiveFrame frame;
  frame.rays = columns * static_cast<std::uint64_t>(elevations_);
  frame.power.bscope_W = renderer::apply_azimuth_beam(sums.range_W_per_rad, sums.cells, sums,
                                                      sensor, sub_columns_);
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
