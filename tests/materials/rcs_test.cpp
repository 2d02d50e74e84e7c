#include "materials/rcs/rcs.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <vector>

#include "core/constants.h"
#include "core/units.h"
#include "tests/materials/error_class.h"
#include "tests/materials/ka_radar.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using core::kPi;
using core::radians;
using tests::kBoresight;
using tests::refuses;

double wavelength_m(double frequency_GHz) {
  return core::kSpeedOfLight_mps / (frequency_GHz * 1e9);
}
double level_dBsm(const RcsModel& model, const glm::dvec3& direction, double frequency_GHz) {
  return 10.0 * std::log10(rcs_m2(model, direction, wavelength_m(frequency_GHz)));
}

// Directions of the trihedral's edges as the header describes them: upper edge in the x-z plane.
std::array<glm::dvec3, 3> trihedral_edges() {
  const double along = 1.0 / std::sqrt(3.0);
  const double out = std::sqrt(2.0 / 3.0);
  const auto edge = [&](double angle_deg) {
    return glm::dvec3(along, out * std::sin(radians(angle_deg)),
                      out * std::cos(radians(angle_deg)));
  };
  return {edge(0.0), edge(120.0), edge(240.0)};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Part of a convex polygon to the left of the line from p to q.
std::vector<glm::dvec2> clipped(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p,
                                const glm::dvec2& q) {
  std::vector<glm::dvec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
    const double side_a = cross(q - p, a - p);
    const double side_b = cross(q - p, b - p);
    if (side_a >= 0.0) kept.push_back(a);
    if ((side_a > 0.0 && side_b < 0.0) || (side_a < 0.0 && side_b > 0.0))
      kept.push_back(a + (b - a) * (side_a / (side_a - side_b)));
  }
  return kept;
}

// Triple reflection returns a ray mirrored at the apex, so the effective aperture is what the
// projected mouth shares with its own mirror image.
double mirrored_aperture_m2(const glm::dvec3& direction, double edge_m) {
  const glm::dvec3 helper = std::abs(direction.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, direction));
  const glm::dvec3 v = glm::cross(direction, u);
  std::vector<glm::dvec2> mouth;
  for (const glm::dvec3& edge : trihedral_edges())
    mouth.emplace_back(edge_m * glm::dot(edge, u), edge_m * glm::dot(edge, v));
  if (cross(mouth[1] - mouth[0], mouth[2] - mouth[0]) < 0.0) std::swap(mouth[1], mouth[2]);
  std::vector<glm::dvec2> shared = mouth;
  for (std::size_t i = 0; i < 3; ++i) shared = clipped(shared, -mouth[i], -mouth[(i + 1) % 3]);
  double twice_area = 0.0;
  for (std::size_t i = 0; i < shared.size(); ++i)
    twice_area += cross(shared[i], shared[(i + 1) % shared.size()]);
  return 0.5 * twice_area;
}

TEST_CASE("Trihedral and plate of 0.1 m have the textbook peaks at 35, 76 and 94 GHz",
          "[materials][rcs]") {
  struct Row {
    double frequency_GHz, trihedral_dBsm, dihedral_dBsm, plate_dBsm, cylinder_dBsm;
  };
  // Evaluated independently from the closed forms, 0.001 dB; the cylinder has r = 0.05 m, L = 1 m.
  for (const Row& row :
       {Row{35.0, 7.566, 15.347, 12.337, 15.644}, Row{76.0, 14.301, 22.082, 19.072, 19.011},
        Row{94.0, 16.147, 23.929, 20.918, 19.935}}) {
    const double f = row.frequency_GHz;
    INFO(f << " GHz");
    REQUIRE(level_dBsm(TriangularTrihedral{0.1}, kBoresight, f) ==
            Approx(row.trihedral_dBsm).epsilon(0.0).margin(6e-4));
    REQUIRE(level_dBsm(Dihedral{0.1, 0.1}, kBoresight, f) ==
            Approx(row.dihedral_dBsm).epsilon(0.0).margin(6e-4));
    REQUIRE(level_dBsm(RectangularPlate{0.1, 0.1}, kBoresight, f) ==
            Approx(row.plate_dBsm).epsilon(0.0).margin(6e-4));
    REQUIRE(level_dBsm(Cylinder{0.05, 1.0}, kBoresight, f) ==
            Approx(row.cylinder_dBsm).epsilon(0.0).margin(6e-4));
  }
}

TEST_CASE("Published reflectors of a SAR calibration site come out to 0.01 dB",
          "[materials][rcs]") {
  // forum.step.esa.int topic 14333, 5.405 GHz: dihedral 1.5 m 46.17 dB, triangular trihedral 2.5 m
  // 47.26 dB.
  REQUIRE(level_dBsm(Dihedral{1.5, 1.5}, kBoresight, 5.405) ==
          Approx(46.17).epsilon(0.0).margin(0.01));
  REQUIRE(level_dBsm(TriangularTrihedral{2.5}, kBoresight, 5.405) ==
          Approx(47.26).epsilon(0.0).margin(0.01));
}

TEST_CASE("Trihedral's area off boresight equals the mouth's overlap with its mirror image",
          "[materials][rcs]") {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const double lambda_m = wavelength_m(35.0);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator)));
    double least = 1.0;
    for (const glm::dvec3& edge : trihedral_edges())
      least = std::min(least, glm::dot(edge, direction));
    const double rcs = rcs_m2(TriangularTrihedral{0.3}, direction, lambda_m);
    if (least <= 0.0) {
      REQUIRE(rcs == 0.0);
      continue;
    }
    ++inside;
    const double area_m2 = mirrored_aperture_m2(direction, 0.3);
    const double expected = 4.0 * kPi * area_m2 * area_m2 / (lambda_m * lambda_m);
    REQUIRE(rcs == Approx(expected).epsilon(1e-9).margin(1e-12));
  }
  // An eighth of the sphere.
  REQUIRE(inside == Approx(2500).epsilon(0.0).margin(200));
}

TEST_CASE("Trihedral falls to half about 20 degrees off its axis", "[materials][rcs]") {
  // Robertson 1947: the triangular corner has a half-power width of about 40 deg.
  const glm::dvec3 tilted(std::cos(radians(20.0)), std::sin(radians(20.0)), 0.0);
  const double loss_dB = level_dBsm(TriangularTrihedral{0.1}, kBoresight, 35.0) -
                         level_dBsm(TriangularTrihedral{0.1}, tilted, 35.0);
  REQUIRE(loss_dB == Approx(3.0).epsilon(0.0).margin(0.8));
}

TEST_CASE("Plate has its first null at sin t = lambda / 2w and is dark behind",
          "[materials][rcs]") {
  const double lambda_m = wavelength_m(35.0);
  const RectangularPlate plate{0.2, 0.1};
  const double peak = rcs_m2(plate, kBoresight, lambda_m);
  const double null_y = lambda_m / (2.0 * plate.width_m);
  const double null_z = lambda_m / (2.0 * plate.height_m);
  REQUIRE(rcs_m2(plate, {std::sqrt(1 - null_y * null_y), null_y, 0}, lambda_m) < 1e-25 * peak);
  REQUIRE(rcs_m2(plate, {std::sqrt(1 - null_z * null_z), 0, null_z}, lambda_m) < 1e-25 * peak);
  // Half of the first null: sinc^2(pi/2) = 4/pi^2, times cos^2.
  const double half = 0.5 * null_y;
  REQUIRE(rcs_m2(plate, {std::sqrt(1 - half * half), half, 0}, lambda_m) ==
          Approx(peak * 4.0 / (kPi * kPi) * (1.0 - half * half)).epsilon(1e-12));
  REQUIRE(rcs_m2(plate, {-1.0, 0.0, 0.0}, lambda_m) == 0.0);
  REQUIRE(rcs_m2(plate, {0.0, 1.0, 0.0}, lambda_m) == 0.0);
}

TEST_CASE("Dihedral is broad across its crease, narrow along it, and zero beyond 45 degrees",
          "[materials][rcs]") {
  const double lambda_m = wavelength_m(35.0);
  const Dihedral dihedral{0.1, 0.1};
  const double peak = rcs_m2(dihedral, kBoresight, lambda_m);
  const auto azimuth = [&](double angle_deg) {
    return rcs_m2(dihedral, {std::cos(radians(angle_deg)), std::sin(radians(angle_deg)), 0.0},
                  lambda_m);
  };
  // (sin 30 / sin 45)^2 = 1/2 at 15 deg, on both sides.
  REQUIRE(azimuth(15.0) == Approx(0.5 * peak).epsilon(1e-12));
  REQUIRE(azimuth(-15.0) == Approx(0.5 * peak).epsilon(1e-12));
  REQUIRE(azimuth(45.1) == 0.0);
  const double null_z = lambda_m / 0.2;
  REQUIRE(rcs_m2(dihedral, {std::sqrt(1 - null_z * null_z), 0, null_z}, lambda_m) < 1e-25 * peak);
}

TEST_CASE("Cylinder looks the same all around and flashes at broadside", "[materials][rcs]") {
  const double lambda_m = wavelength_m(35.0);
  const Cylinder pole{0.05, 2.0};
  const double broadside = rcs_m2(pole, kBoresight, lambda_m);
  REQUIRE(rcs_m2(pole, {-0.6, 0.8, 0.0}, lambda_m) == Approx(broadside).epsilon(1e-12));
  REQUIRE(rcs_m2(pole, {std::cos(0.01), 0.0, std::sin(0.01)}, lambda_m) < 0.01 * broadside);
  REQUIRE(rcs_m2(pole, {0.0, 0.0, 1.0}, lambda_m) == 0.0);
}

TEST_CASE("Point-scatterer input: any length of direction, but no nonsense", "[materials][rcs]") {
  const double lambda_m = wavelength_m(35.0);
  REQUIRE(rcs_m2(ConstantRcs{10.0}, {0.0, 0.0, -5.0}, lambda_m) == 10.0);
  REQUIRE(rcs_m2(TriangularTrihedral{0.1}, kBoresight * 4000.0, lambda_m) ==
          Approx(rcs_m2(TriangularTrihedral{0.1}, kBoresight, lambda_m)).epsilon(1e-14));
  REQUIRE(refuses([&] { rcs_m2(ConstantRcs{}, {0, 0, 0}, lambda_m); }, ErrorClass::range));
  REQUIRE(refuses(
      [&] {
        rcs_m2(ConstantRcs{}, {std::nan(""), 0, 0}, lambda_m);
      },
      ErrorClass::nonfinite));
  REQUIRE(refuses([] { rcs_m2(ConstantRcs{}, {1, 0, 0}, 0.0); }, ErrorClass::range));
  REQUIRE(refuses([] { check_rcs_model(ConstantRcs{-1.0}); }, ErrorClass::range));
  REQUIRE(refuses([] { check_rcs_model(TriangularTrihedral{0.0}); }, ErrorClass::range));
  REQUIRE(refuses(
      [] {
        check_rcs_model(RectangularPlate{0.1, std::nan("")});
      },
      ErrorClass::nonfinite));
}

}  // namespace
}  // namespace fanbeam::materials
