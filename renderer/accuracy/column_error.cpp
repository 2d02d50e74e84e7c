#include "renderer/accuracy/column_error.h"

#include <cstddef>

#include "renderer/stages/azimuth_beam.h"
#include "renderer/stages/side_lobes.h"
#include "sensors/display/display.h"

namespace fanbeam::renderer {
namespace {

std::vector<double> mean_squares(const std::vector<double>& one, const std::vector<double>& other,
                                 std::size_t columns) {
  std::vector<double> sums(columns, 0.0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double difference = one[i] - other[i];
    sums[i % columns] += difference * difference;
  }
  const double rows = static_cast<double>(one.size()) / static_cast<double>(columns);
  for (double& sum : sums) sum /= rows;
  return sums;
}

std::vector<double> plus(std::vector<double> values, const std::vector<double>& more) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += more[i];
  return values;
}

}  // namespace

ColumnError::ColumnError(const sensors::Sensor& sensor, int sub_columns_per_column,
                         const FanSums& common, bool noise)
    : sensor_(sensor), sub_columns_(sub_columns_per_column) {
  common_W_ = bscope_W(common);
  common_W_m3_ = cscope_W_m3(common);
  if (!noise) return;
  for (double& cell : common_W_) cell += sensor.noise_power_W();
  for (double& cell : common_W_m3_) cell += sensors::cscope_noise_W_m3(sensor);
}

std::vector<double> ColumnError::bscope_W(const FanSums& fan) const {
  std::vector<double> image =
      apply_azimuth_beam(fan.range_W_per_rad, fan.cells, fan, sensor_, sub_columns_);
  add_azimuth_side_lobes(fan.range_W_per_rad, fan.cells, fan, sensor_, image);
  return image;
}

std::vector<double> ColumnError::cscope_W_m3(const FanSums& fan) const {
  std::vector<double> image =
      apply_azimuth_beam(fan.elevation_W_m3_per_rad, fan.rows, fan, sensor_, sub_columns_);
  add_azimuth_side_lobes(fan.elevation_W_m3_per_rad, fan.rows, fan, sensor_, image);
  return image;
}

ColumnError::Squares ColumnError::between(const FanSums& one, const FanSums& other) const {
  const auto columns = static_cast<std::size_t>(sensor_.scan.columns);
  const auto bscope = [&](const FanSums& fan) {
    return sensors::bscope_grey(sensor_, plus(bscope_W(fan), common_W_));
  };
  const auto cscope = [&](const FanSums& fan) {
    return sensors::cscope_grey(sensor_, plus(cscope_W_m3(fan), common_W_m3_));
  };
  return {mean_squares(bscope(one), bscope(other), columns),
          one.rows > 0 ? mean_squares(cscope(one), cscope(other), columns)
                       : std::vector<double>(columns, 0.0)};
}

}  // namespace fanbeam::renderer
