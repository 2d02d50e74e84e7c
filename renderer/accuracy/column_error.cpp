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

}  // namespace

ColumnError::Squares ColumnError::between(const FanSums& one, const FanSums& other) const {
  const auto columns = static_cast<std::size_t>(sensor_.scan.columns);
  const auto picture = [&](const std::vector<double>& power, int bins, const FanSums& fan,
                           double noise) {
    std::vector<double> image = apply_azimuth_beam(power, bins, fan, sensor_, sub_columns_);
    add_azimuth_side_lobes(power, bins, fan, sensor_, image);
    for (double& pixel : image) pixel += noise;
    return image;
  };
  const auto bscope = [&](const FanSums& fan) {
    return sensors::bscope_grey(sensor_, picture(fan.range_W_per_rad, fan.cells, fan,
                                                 noise_ ? sensor_.noise_power_W() : 0.0));
  };
  const auto cscope = [&](const FanSums& fan) {
    return sensors::cscope_grey(sensor_,
                                picture(fan.elevation_W_m3_per_rad, fan.rows, fan,
                                        noise_ ? sensors::cscope_noise_W_m3(sensor_) : 0.0));
  };
  return {mean_squares(bscope(one), bscope(other), columns),
          one.rows > 0 ? mean_squares(cscope(one), cscope(other), columns)
                       : std::vector<double>(columns, 0.0)};
}

}  // namespace fanbeam::renderer
