#include "measure/figures.h"

#include <cmath>

namespace fanbeam::measure {

std::string_view name_of(Way way) {
  switch (way) {
    case Way::rays:
      return "rays";
    case Way::slices:
      return "slices";
    case Way::naive_dithered:
      return "naive_dithered";
    case Way::naive_plain:
      break;
  }
  return "naive_plain";
}

std::string_view words_of(Way way) {
  switch (way) {
    case Way::rays:
      return "fanbeam, rays";
    case Way::slices:
      return "fanbeam, slices";
    case Way::naive_dithered:
      return "uniform angles, dithered";
    case Way::naive_plain:
      break;
  }
  return "uniform angles, one azimuth per column";
}

std::string_view fineness_of(Way way) {
  return way == Way::slices ? "slices_per_column" : "rays_per_cell_and_column";
}

double EffectPrice::cost_error_ms() const { return std::hypot(with.error_ms, without.error_ms); }

}  // namespace fanbeam::measure
