#include "materials/rcs/rcs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/number_range.h"
#include "materials/rcs/lobe.h"
#include "materials/rcs/round_wire.h"
#include "materials/rcs/sphere.h"
#include "materials/rcs/trihedral.h"

namespace fanbeam::materials {
namespace {

using core::kPi;

// Cross-section of a flat aperture of the given area that sends everything back.
double aperture_rcs_m2(double area_m2, double wavelength_m) {
  return 4.0 * kPi * area_m2 * area_m2 / (wavelength_m * wavelength_m);
}

double evaluate(const ConstantRcs& constant, const glm::dvec3&, double) { return constant.rcs_m2; }

double evaluate(const Sphere& sphere, const glm::dvec3&, double wavelength_m) {
  return sphere_rcs_m2(sphere.radius_m, wavelength_m);
}

double evaluate(const TriangularTrihedral& trihedral, const glm::dvec3& direction,
                double wavelength_m) {
  const double edge2_m2 = trihedral.edge_m * trihedral.edge_m;
  return aperture_rcs_m2(edge2_m2 * triangular_trihedral_area_m2(direction), wavelength_m);
}

double evaluate(const SquareTrihedral& trihedral, const glm::dvec3& direction,
                double wavelength_m) {
  const double edge2_m2 = trihedral.edge_m * trihedral.edge_m;
  return aperture_rcs_m2(edge2_m2 * square_trihedral_area_m2(direction), wavelength_m);
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

double coherent_length_m(const RoundWire& wire) {
  return wire.coherence_length_m > 0.0 ? wire.coherence_length_m : wire.length_m;
}

double evaluate(const RoundWire& wire, const glm::dvec3& direction, double wavelength_m) {
  const double coherent_m = coherent_length_m(wire);
  return wire.length_m / coherent_m *
         round_wire_rcs_m2(wire.radius_m, coherent_m, wire.polarisation_rad, direction.z,
                           wavelength_m);
}

double evaluate(const LobedRcs& object, const glm::dvec3& direction, double) {
  return lobed_rcs_m2(object, direction);
}

const glm::dvec3 kBroadside(1.0, 0.0, 0.0);

template <class Shape>
double largest(const Shape& shape, double wavelength_m) {
  return evaluate(shape, kBroadside, wavelength_m);
}

double largest(const RoundWire& wire, double wavelength_m) {
  const double coherent_m = coherent_length_m(wire);
  return wire.length_m / coherent_m *
         largest_round_wire_rcs_m2(wire.radius_m, coherent_m, wire.polarisation_rad, wavelength_m);
}

double largest(const LobedRcs& object, double) {
  double most_m2 = object.floor_m2;
  for (const AspectLobe& lobe : object.lobes) most_m2 = std::max(most_m2, lobe.peak_m2);
  return most_m2;
}

double square(double value) { return value * value; }

// D^2 of far_field_distance_m.
double squared_size_m2(const ConstantRcs&) { return 0.0; }
double squared_size_m2(const Sphere&) { return 0.0; }
double squared_size_m2(const LobedRcs&) { return 0.0; }
double squared_size_m2(const TriangularTrihedral& t) { return 2.0 * square(t.edge_m); }
// From the tip of one plate to the end of the edge across.
double squared_size_m2(const SquareTrihedral& t) { return 3.0 * square(t.edge_m); }
double squared_size_m2(const Dihedral& d) { return 2.0 * square(d.width_m) + square(d.height_m); }
double squared_size_m2(const RectangularPlate& p) { return square(p.width_m) + square(p.height_m); }
double squared_size_m2(const Cylinder& c) { return square(c.length_m); }
double squared_size_m2(const RoundWire& w) { return square(coherent_length_m(w)); }

void check_size(const char* field, double size_m) {
  core::require_range(field, size_m, {1e-6, 1e3});
}

void check(const ConstantRcs& constant) {
  core::require_range("rcs_m2", constant.rcs_m2, {0.0, 1e9});
}
void check(const Sphere& sphere) { check_size("radius_m", sphere.radius_m); }
void check(const TriangularTrihedral& trihedral) { check_size("edge_m", trihedral.edge_m); }
void check(const SquareTrihedral& trihedral) { check_size("edge_m", trihedral.edge_m); }
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
void check(const RoundWire& wire) {
  check_size("radius_m", wire.radius_m);
  check_size("length_m", wire.length_m);
  core::require_range("polarisation_rad", wire.polarisation_rad, {-2.0 * kPi, 2.0 * kPi});
  if (wire.coherence_length_m != 0.0) check_size("coherence_length_m", wire.coherence_length_m);
}
void check(const LobedRcs& object) {
  core::require_range("floor_m2", object.floor_m2, {0.0, 1e9});
  for (const AspectLobe& lobe : object.lobes) {
    core::require_range("azimuth_rad", lobe.azimuth_rad, {-2.0 * kPi, 2.0 * kPi});
    core::require_range("azimuth_width_rad", lobe.azimuth_width_rad, {0.0, 100.0});
    core::require_range("elevation_rad", lobe.elevation_rad, {-kPi / 2.0, kPi / 2.0});
    core::require_range("elevation_width_rad", lobe.elevation_width_rad, {1e-6, 100.0});
    core::require_range("peak_m2", lobe.peak_m2, {0.0, 1e9});
  }
}

}  // namespace

void check_rcs_model(const RcsModel& model) {
  std::visit([](const auto& shape) { check(shape); }, model);
}

double rcs_m2(const RcsModel& model, const glm::dvec3& direction_to_radar_in_target_axes,
              double wavelength_m) {
  core::require_range("wavelength_m", wavelength_m, {1e-6, 1e3});
  const double length = glm::length(direction_to_radar_in_target_axes);
  core::require_range("length of direction_to_radar", length, {1e-100, 1e100});
  const glm::dvec3 direction = direction_to_radar_in_target_axes / length;
  return std::visit([&](const auto& shape) { return evaluate(shape, direction, wavelength_m); },
                    model);
}

double largest_rcs_m2(const RcsModel& model, double wavelength_m) {
  core::require_range("wavelength_m", wavelength_m, {1e-6, 1e3});
  return std::visit([&](const auto& shape) { return largest(shape, wavelength_m); }, model);
}

double far_field_distance_m(const RcsModel& model, double wavelength_m) {
  core::require_range("wavelength_m", wavelength_m, {1e-6, 1e3});
  return std::visit([](const auto& shape) { return 2.0 * squared_size_m2(shape); }, model) /
         wavelength_m;
}

}  // namespace fanbeam::materials
