#include "materials/dielectric/dielectric_medium.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/fresnel.h"
#include "tests/materials/error_class.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;
using tests::refuses;

TEST_CASE("Every named medium has its name, a permittivity at 35 GHz and refuses other frequencies",
          "[materials][permittivity]") {
  const std::vector<std::string> names = dielectric_medium_names();
  REQUIRE(names.size() == 15);
  REQUIRE(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  for (const std::string& name : names) {
    INFO(name);
    const auto medium = dielectric_medium_named(name);
    REQUIRE(medium);
    REQUIRE(name_of(*medium) == name);
    const double temperature_K = name == "ice" ? 268.15 : 283.15;
    const Permittivity eps = permittivity_of(*medium, 35e9, temperature_K);
    REQUIRE_NOTHROW(check_permittivity(eps));
    REQUIRE(normal_reflectivity(eps) > 0.005);

    const Interval range_Hz = valid_frequency_Hz(*medium);
    REQUIRE(range_Hz.contains(35e9));
    REQUIRE_NOTHROW(permittivity_of(*medium, range_Hz.low, temperature_K));
    REQUIRE_NOTHROW(permittivity_of(*medium, range_Hz.high, temperature_K));
    for (const double outside_Hz : {range_Hz.low * 0.99, range_Hz.high * 1.01})
      REQUIRE(
          refuses([&] { permittivity_of(*medium, outside_Hz, temperature_K); }, ErrorClass::range));
    REQUIRE(refuses([&] { permittivity_of(*medium, std::nan(""), temperature_K); },
                    ErrorClass::nonfinite));
  }
  REQUIRE_FALSE(dielectric_medium_named("unobtainium"));
  REQUIRE_FALSE(dielectric_medium_named(""));
}

TEST_CASE("Named media reflect in the order that a radar sees at 35 GHz",
          "[materials][permittivity]") {
  const auto reflectivity = [](DielectricMedium medium, double temperature_K) {
    return normal_reflectivity(permittivity_of(medium, 35e9, temperature_K));
  };
  using enum DielectricMedium;
  REQUIRE(reflectivity(metal, 283.15) > 0.99);
  REQUIRE(reflectivity(water, 283.15) > reflectivity(wet_soil, 283.15));
  REQUIRE(reflectivity(wet_soil, 283.15) > reflectivity(moist_soil, 283.15));
  REQUIRE(reflectivity(moist_soil, 283.15) > reflectivity(dry_soil, 283.15));
  REQUIRE(reflectivity(dry_soil, 283.15) > reflectivity(ice, 268.15));
  REQUIRE(reflectivity(ice, 268.15) > reflectivity(dry_snow, 268.15));
  REQUIRE(permittivity_of(asphalt, 35e9, 283.15).real ==
          building_permittivity(BuildingMaterial::asphalt_concrete, 35e9).real);
}

}  // namespace
}  // namespace fanbeam::materials
