#include "terrain/height_field.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace fanbeam::terrain {

HeightField make_height_field(double west_m, double south_m, double east_m, double north_m,
                              double spacing_m) {
  constexpr double kMostPosts = 64.0e6;
  if (!(spacing_m > 0.0) || !(east_m > west_m) || !(north_m > south_m))
    core::throw_input_error(core::ErrorClass::range, "terrain spacing_m", spacing_m,
                            "a positive spacing and extent");
  const double columns = std::ceil((east_m - west_m) / spacing_m - 1e-9) + 1.0;
  const double rows = std::ceil((north_m - south_m) / spacing_m - 1e-9) + 1.0;
  if (columns * rows > kMostPosts)
    core::throw_input_error(core::ErrorClass::limit, "terrain posts", columns * rows,
                            "at most 64 million posts: a larger spacing_m or a smaller extent");
  HeightField field;
  field.west_m = west_m;
  field.south_m = south_m;
  field.spacing_m = spacing_m;
  field.columns = std::max(2, static_cast<int>(columns));
  field.rows = std::max(2, static_cast<int>(rows));
  field.height_m.assign(
      static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0);
  field.cell_material.assign(
      static_cast<std::size_t>(field.columns - 1) * static_cast<std::size_t>(field.rows - 1), 0);
  return field;
}

}  // namespace fanbeam::terrain
