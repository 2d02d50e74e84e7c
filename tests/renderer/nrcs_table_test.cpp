// The table that the ray loop reads, against the models it was made of.
#include "renderer/surfaces/nrcs_table.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/units.h"
#include "materials/library/material_library.h"

namespace fanbeam::renderer {
namespace {

using materials::NrcsCurve;
using materials::PhongNrcs;
using materials::SurfaceModel;

// Largest relative error of the table from `lowest_deg` up to the normal.
double largest_error(const NrcsCurve& curve, double lowest_deg) {
  const NrcsTable table(curve);
  const double lowest = std::sin(core::radians(lowest_deg));
  double largest = 0.0;
  constexpr int kPlaces = 20000;
  for (int i = 0; i <= kPlaces; ++i) {
    const double sine = lowest * std::pow(1.0 / lowest, static_cast<double>(i) / kPlaces);
    const double exact = curve.sigma0(sine) / sine;
    largest = std::max(largest, std::abs(table.sigma0_over_sine(sine) / exact - 1.0));
  }
  return largest;
}

TEST_CASE("The NRCS table keeps every shipped row to 1e-4", "[renderer][nrcs-table]") {
  core::ProblemList problems;
  const auto library = materials::MaterialLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/library.toml", problems);
  REQUIRE(problems.all().empty());
  const auto curves =
      library.curves(materials::SurfaceState::dry, core::Polarisation::horizontal, 35e9);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    INFO(library[i].name);
    CHECK(largest_error(curves[i], 0.01) < 1e-4);
  }
}

TEST_CASE("The NRCS table keeps models with an angle of their own to 0.02 dB, at their kinks too",
          "[renderer][nrcs-table]") {
  using namespace materials;
  for (const SurfaceModel& model :
       {SurfaceModel(KuleminSurface{KuleminTerrain::concrete}),
        SurfaceModel(KuleminSurface{KuleminTerrain::urban}),
        SurfaceModel(GitLandSurface{GitTerrain::trees}), SurfaceModel(NrlSeaSurface{0.0}),
        SurfaceModel(OhSurface{DielectricMedium::concrete, 2e-4, 288.15}),
        SurfaceModel(RoughMetal{}), SurfaceModel(ConstantGammaSurface{GammaTerrain::woods})}) {
    INFO(name_of(model));
    const NrcsCurve curve(model, Polarisation::horizontal, 35e9);
    // Their laws change at 0.1 and at 60 deg.
    CHECK(largest_error(curve, 0.05) < 5e-3);
    CHECK(largest_error(curve, 0.2) < 2e-3);
  }
}

// Largest error from 60 deg to the normal, in dB.
double steep_error_dB(const SurfaceModel& model) {
  const NrcsCurve curve(model, core::Polarisation::horizontal, 35e9);
  const NrcsTable table(curve);
  double largest_dB = 0.0;
  for (int i = 0; i <= 30000; ++i) {
    const double sine = std::sin(core::radians(60.0 + 1e-3 * i));
    const double exact = curve.sigma0(sine) / sine;
    largest_dB =
        std::max(largest_dB, std::abs(10.0 * std::log10(table.sigma0_over_sine(sine) / exact)));
  }
  return largest_dB;
}

SurfaceModel tabulated(const std::vector<double>& grazing_deg,
                       const std::vector<double>& level_dB) {
  std::vector<materials::NrcsSample> rows;
  for (std::size_t i = 0; i < grazing_deg.size(); ++i)
    rows.push_back({core::radians(grazing_deg[i]), std::pow(10.0, level_dB[i] / 10.0)});
  return materials::TabulatedSurface{materials::TabulatedNrcs(std::move(rows)), {1e9, 100e9}, {}};
}

TEST_CASE("The NRCS table follows lobes about the normal, of metal and of measurements",
          "[renderer][nrcs-table]") {
  // Steps of 1/4096 of the sine alone, the last of which is 1.3 deg, miss these by 3, 0.6 and 6 dB.
  CHECK(steep_error_dB(materials::RoughMetal{.rms_slope = 0.01}) < 0.01);
  CHECK(steep_error_dB(materials::RoughMetal{.rms_slope = 0.02}) < 0.05);
  CHECK(steep_error_dB(tabulated({5, 60, 80, 85, 90}, {-30, -20, -12, -8, 0})) < 0.05);
  // 14 dB per degree.
  CHECK(steep_error_dB(tabulated({5, 60, 80, 85, 88, 89, 89.5, 90},
                                 {-30, -20, -15, -10, 0, 10, 17, 20})) < 0.2);
  CHECK(steep_error_dB(tabulated({5, 80, 82, 84, 90}, {-30, -30, 0, -30, -30})) < 0.6);
}

TEST_CASE("The NRCS table bears every Phong exponent and the ends of the angle range",
          "[renderer][nrcs-table]") {
  for (const double c : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
    const NrcsTable table(PhongNrcs(0.0, 0.01, c));
    INFO("c = " << c);
    CHECK(largest_error(PhongNrcs(0.0, 0.01, c), 0.1) < 1e-4);
    for (const double sine : {1e-300, 1e-12, 1e-5, 1.0 / 32.0, 1.0, 1.0 + 1e-12})
      CHECK(std::isfinite(table.sigma0_over_sine(sine)));
    CHECK(table.sigma0_over_sine(0.0) == 0.0);
    CHECK(table.sigma0_over_sine(-0.5) == 0.0);
    CHECK(table.sigma0_over_sine(1.0) == Approx(0.01).epsilon(1e-14));
  }
  CHECK(NrcsTable(NrcsCurve()).sigma0_over_sine(0.5) == 0.0);
  for (const double sine : {1.0, 1.5, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    double share = 0.0;
    CHECK(NrcsTable::index_of(sine, share) + 2 == NrcsTable::kEntries);
    CHECK(share == 0.0);
  }
  // Constant gamma has no error but rounding: a stays a.
  const NrcsTable flat(PhongNrcs(0.02, 0.0, 1.0));
  for (const double sine : {1e-9, 0.001, 0.0313, 0.4, 1.0})
    CHECK(flat.sigma0_over_sine(sine) == Approx(0.02).epsilon(1e-15));
}

}  // namespace
}  // namespace fanbeam::renderer
