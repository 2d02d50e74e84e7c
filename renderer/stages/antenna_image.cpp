#include "renderer/stages/antenna_image.h"

#include "renderer/stages/side_lobes.h"

namespace fanbeam::renderer {

std::vector<double> through_antenna(const std::vector<double>& sums, int bins, const FanSums& fan,
                                    const sensors::Sensor& sensor, int sub_columns_per_column,
                                    const FilledBlocks* filled) {
  std::vector<double> image =
      apply_azimuth_beam(sums, bins, fan, sensor, sub_columns_per_column, filled);
  add_azimuth_side_lobes(sums, bins, fan, sensor, image);
  return image;
}

}  // namespace fanbeam::renderer
