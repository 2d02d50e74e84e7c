// Peaks, half-power points, nulls and limits of the standard shapes, against closed forms,
// committed rows and rays traced into the corners.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>

#include "core/constants.h"
#include "core/units.h"
#include "materials/rcs/rcs.h"
#include "tests/data_rows.h"
#include "tests/decibel.h"
#include "tests/materials/error_class.h"
#include "tests/materials/ka_radar.h"

namespace fanbeam::materials {
namespace {

using core::kPi;
using core::radians;
using tests::dB;
using tests::kBoresight;
using tests::kLambda_m;

const double kWaveNumber_per_m = 2.0 * kPi / kLambda_m;
// Where (sin x / x)^2 is one half.
constexpr double kHalfPower = 1.3915573782515103;

// At the sine of an angle in the x-z plane, and in the x-y plane.
double up(const RcsModel& model, double sine) {
  return rcs_m2(model, {std::sqrt(1.0 - sine * sine), 0.0, sine}, kLambda_m);
}
double aside(const RcsModel& model, double sine) {
  return rcs_m2(model, {std::sqrt(1.0 - sine * sine), sine, 0.0}, kLambda_m);
}

RcsModel shape_named(const std::string& name) {
  if (name == "triangular_trihedral") return TriangularTrihedral{0.1};
  if (name == "square_trihedral") return SquareTrihedral{0.1};
  if (name == "dihedral") return Dihedral{0.1, 0.1};
  if (name == "plate") return RectangularPlate{0.1, 0.1};
  if (name == "sphere") return Sphere{0.1};
  REQUIRE(name == "cylinder");
  return Cylinder{0.05, 1.0};
}

TEST_CASE("Peaks of all shapes at 35, 76 and 94 GHz are those of the committed rows",
          "[materials][rcs]") {
  const auto rows = tests::data_rows("rcs_peaks.csv");
  REQUIRE(rows.size() == 18);
  for (const tests::DataRow& row : rows) {
    INFO(row.text("shape") << " " << row.text("frequency_GHz") << " GHz");
    const double lambda_m = core::kSpeedOfLight_mps / (row.number("frequency_GHz") * 1e9);
    // The sphere at 35 GHz has ka = 73, where geometrical optics is used.
    REQUIRE(dB(rcs_m2(shape_named(row.text("shape")), kBoresight, lambda_m)) ==
            Approx(row.number("rcs_dBsm")).epsilon(0.0).margin(6e-4));
  }
}

TEST_CASE("Plate, dihedral and cylinder have their half power and first null where sinc^2 has",
          "[materials][rcs]") {
  // k D s = 1.3916 and pi: 0.443 lambda / D off the axis, or a full width of 0.886 lambda / 2D for
  // the two-way path.
  struct Case {
    const char* name;
    RcsModel model;
    double size_m;
    double power_of_cosine;
    std::function<double(const RcsModel&, double)> at;
  };
  for (const Case& c : {Case{"plate, width", RectangularPlate{0.3, 0.1}, 0.3, 2.0, aside},
                        Case{"plate, height", RectangularPlate{0.3, 0.1}, 0.1, 2.0, up},
                        Case{"dihedral, crease", Dihedral{0.2, 0.4}, 0.4, 2.0, up},
                        Case{"cylinder", Cylinder{0.05, 0.5}, 0.5, 1.0, up}}) {
    INFO(c.name);
    const double peak_m2 = c.at(c.model, 0.0);
    const double half = kHalfPower / (kWaveNumber_per_m * c.size_m);
    const double slant = std::pow(1.0 - half * half, c.power_of_cosine / 2.0);
    CHECK(c.at(c.model, half) == Approx(0.5 * slant * peak_m2).epsilon(1e-12));
    CHECK(c.at(c.model, -half) == Approx(0.5 * slant * peak_m2).epsilon(1e-12));
    CHECK(c.at(c.model, kLambda_m / (2.0 * c.size_m)) < 1e-25 * peak_m2);
    // First side lobe, 13.26 dB down at k D s = 4.4934.
    const double side = 4.493409457909064 / (kWaveNumber_per_m * c.size_m);
    CHECK(dB(c.at(c.model, side) / peak_m2) ==
          Approx(-13.2615 + dB(std::pow(1.0 - side * side, c.power_of_cosine / 2.0)))
              .epsilon(0.0)
              .margin(1e-3));
  }
}

TEST_CASE(
    "Turned until one plate faces the radar, a dihedral has nothing left, and its peak is that "
    "of its mouth",
    "[materials][rcs]") {
  const Dihedral dihedral{0.2, 0.3};
  const double mouth_m = std::sqrt(2.0) * dihedral.width_m;
  CHECK(rcs_m2(dihedral, kBoresight, kLambda_m) ==
        Approx(rcs_m2(RectangularPlate{mouth_m, dihedral.height_m}, kBoresight, kLambda_m))
            .epsilon(1e-12));
  CHECK(aside(dihedral, std::sin(radians(44.999))) < 1e-8 * aside(dihedral, 0.0));
  // The aperture left of each plate is 2 w h sin(45 deg - az): half of the peak 15 deg off.
  CHECK(aside(dihedral, std::sin(radians(15.0))) ==
        Approx(0.5 * aside(dihedral, 0.0)).epsilon(1e-12));
}

// Follows a ray into three plates of edge 1 along the axes until it leaves. Tells whether it met
// all three.
bool comes_back(glm::dvec3 at, glm::dvec3 going, bool square) {
  std::array<bool, 3> met{};
  for (int bounce = 0; bounce < 4; ++bounce) {
    int plane = -1;
    double nearest = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      if (met[static_cast<std::size_t>(axis)] || going[axis] >= 0.0) continue;
      const double distance = -at[axis] / going[axis];
      const glm::dvec3 point = at + distance * going;
      const double u = point[(axis + 1) % 3];
      const double v = point[(axis + 2) % 3];
      const bool inside = u >= 0.0 && v >= 0.0 && (square ? u <= 1.0 && v <= 1.0 : u + v <= 1.0);
      if (inside && distance < nearest) {
        nearest = distance;
        plane = axis;
      }
    }
    if (plane < 0) break;
    at += nearest * going;
    at[plane] = 0.0;
    going[plane] = -going[plane];
    met[static_cast<std::size_t>(plane)] = true;
  }
  return met[0] && met[1] && met[2];
}

// Area of the beam of parallel rays that is sent back.
double traced_area_m2(const glm::dvec3& to_radar, bool square) {
  const glm::dvec3 helper = std::abs(to_radar.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, to_radar));
  const glm::dvec3 v = glm::cross(to_radar, u);
  constexpr int kSide = 500;
  constexpr double kHalf_m = 1.8;
  int back = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const double a = kHalf_m * (2.0 * (i + 0.5) / kSide - 1.0);
      const double b = kHalf_m * (2.0 * (j + 0.5) / kSide - 1.0);
      if (comes_back(5.0 * to_radar + a * u + b * v, -to_radar, square)) ++back;
    }
  return back * 4.0 * kHalf_m * kHalf_m / (kSide * kSide);
}

TEST_CASE("Both trihedrals send back the area that traced rays find", "[materials][rcs]") {
  // Edge directions of rcs.h: upper edge in the x-z plane.
  const auto in_target_axes = [](const glm::dvec3& cosines) {
    const glm::dvec3 first(1.0 / std::sqrt(3.0), 0.0, std::sqrt(2.0 / 3.0));
    const glm::dvec3 second(1.0 / std::sqrt(3.0), 1.0 / std::sqrt(2.0), -1.0 / std::sqrt(6.0));
    const glm::dvec3 third(1.0 / std::sqrt(3.0), -1.0 / std::sqrt(2.0), -1.0 / std::sqrt(6.0));
    return cosines.x * first + cosines.y * second + cosines.z * third;
  };
  for (const glm::dvec3& towards :
       {glm::dvec3(1, 1, 1), glm::dvec3(1, 1.3, 0.8), glm::dvec3(0.4, 1, 0.7),
        glm::dvec3(0.2, 0.3, 1), glm::dvec3(1, 0.1, 0.9), glm::dvec3(0.05, 1, 0.3)}) {
    const glm::dvec3 cosines = glm::normalize(towards);
    INFO("edge cosines " << cosines.x << " " << cosines.y << " " << cosines.z);
    for (const bool square : {false, true}) {
      const RcsModel model = square ? RcsModel(SquareTrihedral{1.0}) : TriangularTrihedral{1.0};
      const double sigma_m2 = rcs_m2(model, in_target_axes(cosines), kLambda_m);
      const double area_m2 = std::sqrt(sigma_m2 * kLambda_m * kLambda_m / (4.0 * kPi));
      INFO((square ? "square" : "triangular"));
      CHECK(area_m2 == Approx(traced_area_m2(cosines, square)).epsilon(0.01).margin(2e-3));
    }
  }
}

// The angle off the axis at which the cross-section has fallen by half, upwards or sideways.
double half_power_deg(const RcsModel& model, double (*at)(const RcsModel&, double)) {
  double low = 0.0;
  double high = 35.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (at(model, std::sin(radians(middle))) > 0.5 * at(model, 0.0) ? low : high) = middle;
  }
  return low;
}

TEST_CASE(
    "The square trihedral is 9.54 dB stronger than the triangular one of the same edge, and "
    "narrower",
    "[materials][rcs]") {
  CHECK(dB(rcs_m2(SquareTrihedral{0.1}, kBoresight, kLambda_m) /
           rcs_m2(TriangularTrihedral{0.1}, kBoresight, kLambda_m)) ==
        Approx(dB(9.0)).epsilon(0.0).margin(1e-12));
  // Robertson 1947: about 40 deg between half-power points of the triangular corner.
  CHECK(2.0 * half_power_deg(TriangularTrihedral{0.1}, aside) ==
        Approx(38.94).epsilon(0.0).margin(0.01));
  CHECK(2.0 * half_power_deg(SquareTrihedral{0.1}, aside) ==
        Approx(20.67).epsilon(0.0).margin(0.01));
  CHECK(2.0 * half_power_deg(SquareTrihedral{0.1}, up) == Approx(22.34).epsilon(0.0).margin(0.01));
  CHECK(rcs_m2(SquareTrihedral{0.1}, {-1.0, 0.0, 0.0}, kLambda_m) == 0.0);
}

TEST_CASE("The lobe of a small plate is wide: integrated over angles the echo is pi A",
          "[materials][rcs]") {
  // The mean of a plate over a spread of angles, which typical objects rest on: the integral of
  // sigma over both direction cosines is pi A whatever the wavelength (side lobes beyond left out).
  const RectangularPlate plate{0.4, 0.3};
  double sum_m2 = 0.0;
  constexpr int kSide = 1600;
  constexpr double kReach = 0.6;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const double u = kReach * (2.0 * (i + 0.5) / kSide - 1.0);
      const double v = kReach * (2.0 * (j + 0.5) / kSide - 1.0);
      const double x2 = 1.0 - u * u - v * v;
      // cos^2 taken out: it belongs to the slant, not to the lobe.
      sum_m2 += rcs_m2(plate, {std::sqrt(x2), u, v}, kLambda_m) / x2;
    }
  sum_m2 *= std::pow(2.0 * kReach / kSide, 2);
  CHECK(sum_m2 == Approx(kPi * plate.width_m * plate.height_m).epsilon(0.01));
}

TEST_CASE("Far-field distances: 233 m for 1 m at 35 GHz, none for what has no size",
          "[materials][rcs]") {
  const auto distance = [](const RcsModel& model) {
    return far_field_distance_m(model, kLambda_m);
  };
  CHECK(distance(Cylinder{0.05, 1.0}) == Approx(233.49).epsilon(0.0).margin(0.01));
  // 1 m x 1 m: the diagonal counts.
  CHECK(distance(RectangularPlate{1.0, 1.0}) == Approx(2.0 * 233.49).epsilon(0.0).margin(0.02));
  CHECK(distance(Dihedral{1.0, 1.0}) == Approx(3.0 * 233.49).epsilon(0.0).margin(0.03));
  CHECK(distance(TriangularTrihedral{0.3}) == Approx(4.0 * 0.09 / kLambda_m));
  CHECK(distance(SquareTrihedral{0.3}) == Approx(6.0 * 0.09 / kLambda_m));
  CHECK(distance(RoundWire{0.01, 10.0, 0.0, 0.5}) == Approx(0.5 / kLambda_m));
  CHECK(distance(RoundWire{0.01, 10.0, 0.0, 0.0}) == Approx(200.0 / kLambda_m));
  CHECK(distance(ConstantRcs{1e6}) == 0.0);
  CHECK(distance(Sphere{5.0}) == 0.0);
  CHECK(tests::refuses([] { far_field_distance_m(Sphere{1.0}, 0.0); }, core::ErrorClass::range));
}

}  // namespace
}  // namespace fanbeam::materials
