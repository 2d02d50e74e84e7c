#include "renderer/accuracy/column_error.h"

#include <cmath>
#include <cstddef>

#include "renderer/stages/antenna_image.h"
#include "sensors/display/display.h"
#include "sensors/shadow/shadow_cscope.h"

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

ColumnError::ColumnError(const sensors::Sensor& sensor, bool noise, double drawn_from_m)
    : sensor_(sensor),
      noise_W_(noise ? sensor.noise_power_W() : 0.0),
      noise_W_m3_(noise ? sensors::cscope_noise_W_m3(sensor) : 0.0),
      drawn_from_m_(drawn_from_m) {}

void ColumnError::put_under(const FanSums& common) {
  common_W_ = image(common.range_W_per_rad, common.cells, common);
  common_W_m3_ = image(common.elevation_W_m3_per_rad, common.rows, common);
}

std::vector<double> ColumnError::image(const std::vector<double>& sums, int bins,
                                       const FanSums& fan) const {
  const double per_column = sensor_.scan.column_width_rad() / fan.step_rad;
  return through_antenna(sums, bins, fan, sensor_, static_cast<int>(std::lround(per_column)));
}

bool ColumnError::raises() const {
  return drawn_from_m_ > 0.0 && sensor_.display.cscope_mode == sensors::Display::CScopeMode::shadow;
}

std::vector<double> ColumnError::cscope_grey(const FanSums& fan,
                                             const std::vector<double>& received_W,
                                             bool raised) const {
  if (!(drawn_from_m_ > 0.0))
    return sensors::cscope_grey(
        sensor_, over(common_W_m3_, noise_W_m3_, image(fan.elevation_W_m3_per_rad, fan.rows, fan)));
  std::vector<sensors::ShadowObstacle> obstacles;
  if (raised) obstacles = sensors::shadow_obstacles(sensor_, received_W, drawn_from_m_);
  return sensors::cscope_grey(
      sensor_, sensors::shadow_cscope_W_m3(sensor_, received_W, drawn_from_m_, obstacles));
}

ColumnError::Squares ColumnError::between(const FanSums& one, const FanSums& other) const {
  const auto columns = static_cast<std::size_t>(sensor_.scan.columns);
  const auto received_W = [&](const FanSums& fan) {
    return over(common_W_, noise_W_, image(fan.range_W_per_rad, fan.cells, fan));
  };
  const std::vector<double> one_W = received_W(one), other_W = received_W(other);
  const auto cscopes_apart = [&](bool raised) {
    return mean_squares(cscope_grey(one, one_W, raised), cscope_grey(other, other_W, raised),
                        columns);
  };
  Squares apart{mean_squares(sensors::bscope_grey(sensor_, one_W),
                             sensors::bscope_grey(sensor_, other_W), columns),
                std::vector<double>(columns, 0.0), std::vector<double>(columns, 0.0)};
  if (!(drawn_from_m_ > 0.0) && one.rows == 0) return apart;
  apart.unraised_grey2 = cscopes_apart(false);
  apart.cscope_grey2 = raises() ? cscopes_apart(true) : apart.unraised_grey2;
  return apart;
}

}  // namespace fanbeam::renderer
