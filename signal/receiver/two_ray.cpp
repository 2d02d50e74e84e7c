#include "signal/receiver/two_ray.h"

#include <cmath>

#include "core/constants.h"
#include "core/errors.h"

namespace fanbeam::signal {
namespace {

struct Rays {
  double direct_m, reflected_m;
};

Rays rays(double height_m, double other_height_m, double ground_distance_m) {
  for (const double value_m : {height_m, other_height_m})
    if (!(std::isfinite(value_m) && value_m >= 0.0))
      core::throw_input_error(core::ErrorClass::range, "height_m", value_m, "0 or above");
  if (!(std::isfinite(ground_distance_m) && ground_distance_m > 0.0))
    core::throw_input_error(core::ErrorClass::range, "ground_distance_m", ground_distance_m,
                            "above 0");
  return {std::hypot(ground_distance_m, height_m - other_height_m),
          std::hypot(ground_distance_m, height_m + other_height_m)};
}

}  // namespace

double path_difference_m(double height_m, double other_height_m, double ground_distance_m) {
  const Rays ray = rays(height_m, other_height_m, ground_distance_m);
  return 4.0 * height_m * other_height_m / (ray.direct_m + ray.reflected_m);
}

double two_ray_factor(double height_m, double other_height_m, double ground_distance_m,
                      double wavelength_m, std::complex<double> reflection) {
  if (!(std::isfinite(wavelength_m) && wavelength_m > 0.0))
    core::throw_input_error(core::ErrorClass::range, "wavelength_m", wavelength_m, "above 0");
  const Rays ray = rays(height_m, other_height_m, ground_distance_m);
  const double turns =
      path_difference_m(height_m, other_height_m, ground_distance_m) / wavelength_m;
  return std::norm(1.0 + reflection * (ray.direct_m / ray.reflected_m) *
                             std::polar(1.0, -2.0 * core::kPi * turns));
}

}  // namespace fanbeam::signal
