#include "renderer/accuracy/column_error.h"

#include <cmath>
#include <cstddef>

#include "renderer/stages/antenna_image.h"
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

// `common` may be empty.
std::vector<double> over(const std::vector<double>& common, double noise,
                         std::vector<double> values) {
  for (double& value : values) value += noise;
  for (std::size_t i = 0; i < common.size(); ++i) values[i] += common[i];
  return values;
}

}  // namespace

ColumnError::ColumnError(const sensors::Sensor& sensor, bool noise)
    : sensor_(sensor),
      noise_W_(noise ? sensor.noise_power_W() : 0.0),
      noise_W_m3_(noise ? sensors::cscope_noise_W_m3(sensor) : 0.0) {}

void ColumnError::put_under(const FanSums& common) {
  common_W_ = image(common.range_W_per_rad, common.cells, common);
  common_W_m3_ = image(common.elevation_W_m3_per_rad, common.rows, common);
}

std::vector<double> ColumnError::image(const std::vector<double>& sums, int bins,
                                       const FanSums& fan) const {
  const double per_column = sensor_.scan.column_width_rad() / fan.step_rad;
  return through_antenna(sums, bins, fan, sensor_, static_cast<int>(std::lround(per_column)));
}

ColumnError::Squares ColumnError::between(const FanSums& one, const FanSums& other) const {
  const auto columns = static_cast<std::size_t>(sensor_.scan.columns);
  const auto bscope = [&](const FanSums& fan) {
    return sensors::bscope_grey(
        sensor_, over(common_W_, noise_W_, image(fan.range_W_per_rad, fan.cells, fan)));
  };
  const auto cscope = [&](const FanSums& fan) {
    return sensors::cscope_grey(
        sensor_, over(common_W_m3_, noise_W_m3_, image(fan.elevation_W_m3_per_rad, fan.rows, fan)));
  };
  return {mean_squares(bscope(one), bscope(other), columns),
          one.rows > 0 ? mean_squares(cscope(one), cscope(other), columns)
                       : std::vector<double>(columns, 0.0)};
}

}  // namespace fanbeam::renderer
