#include "signal/receiver/two_ray.h"

#include <cmath>

#include "signal/checks_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

struct Rays {
  double direct_m, reflected_m;
};

Rays rays(double height_m, double other_height_m, double ground_distance_m) {
  for (const double value_m : {height_m, other_height_m}) check_not_negative("height_m", value_m);
  check_positive("ground_distance_m", ground_distance_m);
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
  check_positive("wavelength_m", wavelength_m);
  const Rays ray = rays(height_m, other_height_m, ground_distance_m);
  const double turns =
      path_difference_m(height_m, other_height_m, ground_distance_m) / wavelength_m;
  return std::norm(1.0 + reflection * (ray.direct_m / ray.reflected_m) * unit_phasor(-turns));
}

}  // namespace fanbeam::signal
