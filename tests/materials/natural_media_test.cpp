#include <catch2/catch.hpp>
#include <cmath>

#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/fresnel.h"
#include "materials/dielectric/snow.h"
#include "materials/dielectric/soil.h"
#include "materials/dielectric/water_ice.h"
#include "tests/data_rows.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using tests::refuses;

TEST_CASE("Wet snow equals the published figures at both ends of its frequencies",
          "[materials][permittivity]") {
  for (const tests::DataRow& row : tests::data_rows("wet_snow_figures.csv")) {
    const Permittivity eps = wet_snow_permittivity({250.0, row.number("water_percent") / 100.0},
                                                   row.number("frequency_GHz") * 1e9);
    INFO(row.text("frequency_GHz") << " GHz, " << row.text("water_percent") << " %");
    REQUIRE(eps.real == Approx(row.number("permittivity_real")).epsilon(0.0).margin(1e-3));
    REQUIRE(eps.loss == Approx(row.number("permittivity_loss")).epsilon(0.0).margin(1e-3));
  }
}

TEST_CASE(
    "Water makes snow lossy: ten times the reflectivity of dry snow is not reached, its "
    "loss is",
    "[materials][permittivity]") {
  const Permittivity wet = wet_snow_permittivity({}, 35e9);
  const Permittivity dry = dry_snow_permittivity(240.0);
  REQUIRE(dry.loss == 0.0);
  REQUIRE(wet.loss == Approx(0.1914).epsilon(0.0).margin(5e-5));
  REQUIRE(normal_reflectivity(wet) < 10.0 * normal_reflectivity(dry));
  // More water, more of both.
  const Permittivity wetter = wet_snow_permittivity({240.0, 0.10}, 35e9);
  REQUIRE(wetter.real > wet.real);
  REQUIRE(wetter.loss > wet.loss);
}

TEST_CASE("Soil follows ITU-R P.527 from 10 to 37 GHz", "[materials][permittivity]") {
  for (const tests::DataRow& row : tests::data_rows("soil_permittivity.csv")) {
    Soil soil;
    soil.sand_mass_fraction = row.number("sand");
    soil.clay_mass_fraction = row.number("clay");
    soil.grain_density_kg_per_m3 = row.number("grain_g_per_cm3") * 1000.0;
    soil.bulk_density_kg_per_m3 = row.number("bulk_g_per_cm3") * 1000.0;
    soil.moisture_volume_fraction = row.number("moisture");
    const double frequency_GHz = row.number("frequency_GHz");
    const Permittivity eps = soil_permittivity(soil, frequency_GHz * 1e9, 296.15);
    INFO(row.text("soil") << ", " << frequency_GHz << " GHz, " << row.text("moisture"));
    // What the term for low frequencies that we leave out is worth, falling as 1 / f^2.
    const double allowed = 0.008 * std::pow(10.0 / frequency_GHz, 2.0) + 4e-4;
    REQUIRE(eps.real == Approx(row.number("permittivity_real")).epsilon(allowed));
    REQUIRE(eps.loss == Approx(row.number("permittivity_loss")).epsilon(allowed));
  }
}

TEST_CASE("Soil permittivity grows with moisture and stays between dry soil and water",
          "[materials][permittivity]") {
  const Permittivity water = water_permittivity(35e9, 293.15);
  double last = 1.0;
  for (const double moisture : {0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5}) {
    Soil soil;
    soil.moisture_volume_fraction = moisture;
    const Permittivity eps = soil_permittivity(soil, 35e9, 293.15);
    REQUIRE(eps.real > last);
    REQUIRE(eps.real < water.real);
    REQUIRE(eps.loss < water.loss);
    last = eps.real;
  }
}

TEST_CASE("A soil without free-water loss has a loss of zero, never a gain",
          "[materials][permittivity]") {
  // The regression's conductivity is -1.9 S/m here and outweighs the water's own loss.
  Soil sand;
  sand.sand_mass_fraction = 1.0;
  sand.clay_mass_fraction = 0.0;
  sand.bulk_density_kg_per_m3 = 1000.0;
  sand.moisture_volume_fraction = 0.01;
  REQUIRE(soil_permittivity(sand, 4e9, 293.15).loss == 0.0);
}

TEST_CASE("Snow and soil are refused outside the measurements behind them",
          "[materials][permittivity]") {
  const auto snow = [](double density_kg_per_m3, double water, double frequency_Hz) {
    return [=] { wet_snow_permittivity({density_kg_per_m3, water}, frequency_Hz); };
  };
  REQUIRE(refuses(snow(240.0, 0.05, 94e9), ErrorClass::range));
  REQUIRE(refuses(snow(240.0, 0.0, 35e9), ErrorClass::range));
  REQUIRE(refuses(snow(240.0, 0.2, 35e9), ErrorClass::range));
  REQUIRE(refuses(snow(500.0, 0.05, 35e9), ErrorClass::range));
  REQUIRE(refuses(snow(std::nan(""), 0.05, 35e9), ErrorClass::nonfinite));
  REQUIRE_NOTHROW(snow(90.0, 0.01, 3e9)());
  REQUIRE_NOTHROW(snow(380.0, 0.12, 37e9)());

  const auto soil = [](double moisture, double frequency_Hz, double temperature_K) {
    return [=] {
      Soil wet;
      wet.moisture_volume_fraction = moisture;
      soil_permittivity(wet, frequency_Hz, temperature_K);
    };
  };
  REQUIRE(refuses(soil(0.2, 76e9, 293.15), ErrorClass::range));
  REQUIRE(refuses(soil(0.2, 1e9, 293.15), ErrorClass::range));
  REQUIRE(refuses(soil(0.2, 35e9, 260.0), ErrorClass::range));
  REQUIRE(refuses(soil(0.0, 35e9, 293.15), ErrorClass::range));
  REQUIRE(refuses(soil(0.9, 35e9, 293.15), ErrorClass::range));
  REQUIRE(refuses(
      [] {
        Soil too_much;
        too_much.sand_mass_fraction = 0.6;
        too_much.clay_mass_fraction = 0.6;
        soil_permittivity(too_much, 35e9, 293.15);
      },
      ErrorClass::range));
}

TEST_CASE("Published points of concrete, water and asphalt lie where the models say",
          "[materials][permittivity]") {
  // Concrete is printed as 4 (60 GHz) and as 6.495 - 0.428 j (57.5 GHz, 14 months after pouring):
  // P.2040 lies between, and the reflected power with it between 0.11 and 0.20.
  const Permittivity concrete = building_permittivity(BuildingMaterial::concrete, 57.5e9);
  REQUIRE(concrete.real > 4.0);
  REQUIRE(concrete.real < 6.495);
  REQUIRE(normal_reflectivity({4.0, 0.0}) == Approx(0.111).epsilon(0.0).margin(1e-3));
  REQUIRE(normal_reflectivity({6.495, 0.428}) == Approx(0.191).epsilon(0.0).margin(1e-3));
  REQUIRE(normal_reflectivity(concrete) == Approx(0.154).epsilon(0.0).margin(1e-3));
  // Water at 60 GHz is printed as 11.1; the temperature is not, and 18.5 to 22 C give it.
  REQUIRE(water_permittivity(60e9, 291.15).real < 11.1);
  REQUIRE(water_permittivity(60e9, 295.15).real > 11.1);
  // Asphalt cores and slabs (Olkkonen 2016): 5.01 to 5.27 at 7 to 17 GHz.
  for (const double frequency_Hz : {7e9, 17e9}) {
    const double asphalt =
        building_permittivity(BuildingMaterial::asphalt_concrete, frequency_Hz).real;
    REQUIRE(asphalt == Approx(5.14).epsilon(0.07));
  }
}

}  // namespace
}  // namespace fanbeam::materials
