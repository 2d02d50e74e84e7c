#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/fresnel.h"
#include "materials/dielectric/snow.h"
#include "materials/dielectric/water_ice.h"
#include "tests/data_rows.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using tests::refuses;

Permittivity evaluate(const std::string& material, double frequency_Hz) {
  if (material == "water_20C") return water_permittivity(frequency_Hz, 293.15);
  if (material == "water_0C") return water_permittivity(frequency_Hz, 273.15);
  if (material == "ice_-5C") return ice_permittivity(frequency_Hz, 268.15);
  if (material == "dry_snow_rho0.3") return dry_snow_permittivity(300.0);
  if (material == "concrete")
    return building_permittivity(BuildingMaterial::concrete, frequency_Hz);
  if (material == "glass") return building_permittivity(BuildingMaterial::glass, frequency_Hz);
  REQUIRE(material == "metal");
  return building_permittivity(BuildingMaterial::metal, frequency_Hz);
}

TEST_CASE("Permittivities and normal reflectivities equal the check values at 35, 76 and 94 GHz",
          "[materials][permittivity]") {
  for (const tests::DataRow& row : tests::data_rows("fresnel_check_values.csv")) {
    const Permittivity eps = evaluate(row.text("material"), row.number("frequency_GHz") * 1e9);
    INFO(row.text("material") << " at " << row.text("frequency_GHz") << " GHz");
    // Half a unit of the last printed digit.
    REQUIRE(eps.real == Approx(row.number("permittivity_real")).epsilon(0.0).margin(6e-5));
    REQUIRE(eps.loss == Approx(row.number("permittivity_loss")).epsilon(0.0).margin(6e-5));
    REQUIRE(normal_reflectivity(eps) ==
            Approx(row.number("normal_reflectivity")).epsilon(0.0).margin(6e-6));
  }
}

TEST_CASE("Static permittivity of water at 25 degrees is 78.4", "[materials][permittivity]") {
  // CRC Handbook, 78.36 at 25 C; the model's fit is good to 0.1.
  REQUIRE(water_permittivity(1e6, 298.15).real == Approx(78.36).epsilon(0.0).margin(0.1));
}

TEST_CASE("Building materials are refused outside the recommendation's frequencies",
          "[materials][permittivity]") {
  const auto at = [](BuildingMaterial material, double frequency_Hz) {
    return [=] { building_permittivity(material, frequency_Hz); };
  };
  REQUIRE(refuses(at(BuildingMaterial::very_dry_ground, 35e9), ErrorClass::range));
  REQUIRE(refuses(at(BuildingMaterial::wet_ground, 10.1e9), ErrorClass::range));
  REQUIRE(refuses(at(BuildingMaterial::brick, 76e9), ErrorClass::range));
  REQUIRE(refuses(at(BuildingMaterial::concrete, 0.5e9), ErrorClass::range));
  REQUIRE(refuses(at(BuildingMaterial::concrete, std::nan("")), ErrorClass::nonfinite));
  REQUIRE_NOTHROW(building_permittivity(BuildingMaterial::brick, 40e9));
  REQUIRE(refuses([] { water_permittivity(35e9, 200.0); }, ErrorClass::range));
  REQUIRE(refuses([] { ice_permittivity(35e9, 280.0); }, ErrorClass::range));
  REQUIRE(refuses([] { dry_snow_permittivity(917.0); }, ErrorClass::range));
}

}  // namespace
}  // namespace fanbeam::materials
