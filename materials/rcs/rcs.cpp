#include "materials/rcs/rcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "materials/checks.h"

namespace fanbeam::materials {
namespace {

using core::kPi;

double sinc_squared(double x) {
  if (std::abs(x) < 1e-8) return 1.0;
  const double sinc = std::sin(x) / x;
  return sinc * sinc;
}

// Cross-section of a flat aperture of the given area that sends everything back.
double aperture_rcs_m2(double area_m2, double wavelength_m) {
  return 4.0 * kPi * area_m2 * area_m2 / (wavelength_m * wavelength_m);
}

double evaluate(const ConstantRcs& constant, const glm::dvec3&, double) { return constant.rcs_m2; }

double evaluate(const TriangularTrihedral& trihedral, const glm::dvec3& direction,
                double wavelength_m) {
  const double along = direction.x / std::sqrt(3.0);
  std::array<double, 3> cosines = {
      along + direction.z * std::sqrt(2.0 / 3.0),
      along + direction.y / std::sqrt(2.0) - direction.z / std::sqrt(6.0),
      along - direction.y / std::sqrt(2.0) - direction.z / std::sqrt(6.0)};
  std::sort(cosines.begin(), cosines.end());
  const double l = cosines[0];
  const double m = cosines[1];
  const double n = cosines[2];
  if (l <= 0.0) return 0.0;
  const double sum = l + m + n;
  const double relative_area = l + m <= n ? 4.0 * l * m / sum : sum - 2.0 / sum;
  return aperture_rcs_m2(relative_area * trihedral.edge_m * trihedral.edge_m, wavelength_m);
}

double evaluate(const Dihedral& dihedral, const glm::dvec3& direction, double wavelength_m) {
  const double azimuth_rad = std::abs(std::atan2(direction.y, direction.x));
  if (azimuth_rad >= kPi / 4.0) return 0.0;
  const double area_m2 =
      2.0 * dihedral.width_m * dihedral.height_m * std::sin(kPi / 4.0 - azimuth_rad);
  const double cos2_elevation = 1.0 - std::min(1.0, direction.z * direction.z);
  const double phase_rad = 2.0 * kPi / wavelength_m * dihedral.height_m * direction.z;
  return aperture_rcs_m2(area_m2, wavelength_m) * cos2_elevation * sinc_squared(phase_rad);
}

double evaluate(const RectangularPlate& plate, const glm::dvec3& direction, double wavelength_m) {
  if (direction.x <= 0.0) return 0.0;
  const double wave_number_per_m = 2.0 * kPi / wavelength_m;
  return aperture_rcs_m2(plate.width_m * plate.height_m, wavelength_m) * direction.x * direction.x *
         sinc_squared(wave_number_per_m * plate.width_m * direction.y) *
         sinc_squared(wave_number_per_m * plate.height_m * direction.z);
}

double evaluate(const Cylinder& cylinder, const glm::dvec3& direction, double wavelength_m) {
  const double cos_elevation = std::sqrt(1.0 - std::min(1.0, direction.z * direction.z));
  const double phase_rad = 2.0 * kPi / wavelength_m * cylinder.length_m * direction.z;
  return 2.0 * kPi * cylinder.radius_m * cylinder.length_m * cylinder.length_m / wavelength_m *
         cos_elevation * sinc_squared(phase_rad);
}

void check_size(const char* field, double size_m) { require_range(field, size_m, 1e-6, 1e3); }

void check(const ConstantRcs& constant) { require_range("rcs_m2", constant.rcs_m2, 0.0, 1e9); }
void check(const TriangularTrihedral& trihedral) { check_size("edge_m", trihedral.edge_m); }
void check(const Dihedral& dihedral) {
  check_size("width_m", dihedral.width_m);
  check_size("height_m", dihedral.height_m);
}
void check(const RectangularPlate& plate) {
  check_size("width_m", plate.width_m);
  check_size("height_m", plate.height_m);
}
void check(const Cylinder& cylinder) {
  check_size("radius_m", cylinder.radius_m);
  check_size("length_m", cylinder.length_m);
}

}  // namespace

void check_rcs_model(const RcsModel& model) {
  std::visit([](const auto& shape) { check(shape); }, model);
}

double rcs_m2(const RcsModel& model, const glm::dvec3& direction_to_radar_in_target_axes,
              double wavelength_m) {
  require_range("wavelength_m", wavelength_m, 1e-6, 1e3);
  const double length = glm::length(direction_to_radar_in_target_axes);
  require_range("length of direction_to_radar", length, 1e-100, 1e100);
  const glm::dvec3 direction = direction_to_radar_in_target_axes / length;
  return std::visit([&](const auto& shape) { return evaluate(shape, direction, wavelength_m); },
                    model);
}

}  // namespace fanbeam::materials
