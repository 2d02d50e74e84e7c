// Wet and snow-covered surfaces of the shipped library.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/files.h"
#include "core/units.h"
#include "materials/dielectric/dielectric_medium.h"
#include "materials/library/material_library.h"
#include "tests/materials/shipped_library.h"

namespace fanbeam::materials {
namespace {

using core::radians;
using tests::shipped_library;
using tests::shipped_library_path;

double level_dB(const MaterialLibrary& library, const char* name, SurfaceState state,
                double grazing_deg) {
  const std::size_t index = library.in_state(library.index_of(name).value(), state);
  return 10.0 * std::log10(sigma0(library[index].model, Polarisation::horizontal, 35e9,
                                  radians(grazing_deg)));
}

TEST_CASE("Every shipped material says what every state makes of it", "[materials][state]") {
  core::ProblemList problems;
  const std::string path = shipped_library_path();
  const std::string text = core::read_file(path, 1 << 20);
  core::ConfigTable file = core::ConfigTable::from_text(text, path, problems);
  const MaterialLibrary library = shipped_library();
  for (const std::string& name : file.keys()) {
    INFO(name);
    core::ConfigTable row = file.table(name);
    for (const char* key : {"when_wet", "when_dry_snow", "when_wet_snow"}) {
      INFO(key);
      const std::string other = row.required_text(key);
      CHECK((other == "same" || (other != name && library.index_of(other))));
    }
  }
  for (std::size_t i = 0; i < library.size(); ++i) {
    CHECK(library.in_state(i, SurfaceState::dry) == i);
    for (const SurfaceState state :
         {SurfaceState::wet, SurfaceState::dry_snow, SurfaceState::wet_snow}) {
      const std::size_t other = library.in_state(i, state);
      INFO(library[i].name << " to " << library[other].name);
      // What a state has made stays in it, and is known where the dry row is known at 35 GHz.
      CHECK(library.in_state(other, state) == other);
      CHECK(extrapolations_of(library[other].model, Polarisation::horizontal, 35e9).empty());
      // A wrong figure would show: no documented change exceeds 45 dB at approach angles.
      const double change_dB = level_dB(library, library[i].name.c_str(), state, 3.0) -
                               level_dB(library, library[i].name.c_str(), SurfaceState::dry, 3.0);
      CHECK(std::abs(change_dB) < 45.0);
    }
  }
}

TEST_CASE("Wet pavement is darker at approach angles and brighter near the normal",
          "[materials][state]") {
  const MaterialLibrary library = shipped_library();
  for (const char* name : {"asphalt_smooth", "asphalt_worn", "concrete", "paint"}) {
    INFO(name);
    for (const double grazing_deg : {2.0, 3.0, 5.0}) {
      const double change_dB = level_dB(library, name, SurfaceState::wet, grazing_deg) -
                               level_dB(library, name, SurfaceState::dry, grazing_deg);
      CHECK(change_dB < -1.0);
      CHECK(change_dB > -10.0);
    }
    CHECK(level_dB(library, name, SurfaceState::wet, 75.0) >
          level_dB(library, name, SurfaceState::dry, 75.0));
  }
}

TEST_CASE("Wet vegetation and soil are brighter by their documented step", "[materials][state]") {
  const MaterialLibrary library = shipped_library();
  const auto change_dB = [&](const char* name, double grazing_deg) {
    return level_dB(library, name, SurfaceState::wet, grazing_deg) -
           level_dB(library, name, SurfaceState::dry, grazing_deg);
  };
  for (const double grazing_deg : {1.0, 3.0, 10.0, 40.0}) {
    for (const char* name : {"short_grass", "tall_grass", "crops", "forest"})
      CHECK(change_dB(name, grazing_deg) == Approx(2.0).epsilon(0.0).margin(0.01));
    for (const char* name : {"bare_soil", "arable_soil"})
      CHECK(change_dB(name, grazing_deg) == Approx(4.6).epsilon(0.0).margin(0.01));
  }
  // 4.6 dB is the reflectivity of wet over dry loam at the normal.
  const auto reflectivity_dB = [](DielectricMedium medium) {
    const auto root = std::sqrt(permittivity_of(medium, 35e9, 283.15).complex());
    return 10.0 * std::log10(std::norm((1.0 - root) / (1.0 + root)));
  };
  CHECK(reflectivity_dB(DielectricMedium::wet_soil) - reflectivity_dB(DielectricMedium::dry_soil) ==
        Approx(4.6).epsilon(0.0).margin(0.1));
}

TEST_CASE("Snow covers flat ground, and neither walls nor water", "[materials][state]") {
  const MaterialLibrary library = shipped_library();
  const auto turned = [&](const char* name, SurfaceState state) {
    return library[library.in_state(library.index_of(name).value(), state)].name;
  };
  for (const char* name : {"short_grass", "crops", "bare_soil", "asphalt_worn", "concrete", "paint",
                           "gravel", "roof", "rock"}) {
    CHECK(turned(name, SurfaceState::dry_snow) == "snow_dry");
    CHECK(turned(name, SurfaceState::wet_snow) == "snow_wet");
  }
  for (const char* name : {"wall", "brick", "metal", "water_calm", "water_rough", "urban"})
    for (const SurfaceState state :
         {SurfaceState::wet, SurfaceState::dry_snow, SurfaceState::wet_snow})
      CHECK(turned(name, state) == name);
}

TEST_CASE("At 2 to 5 degrees dry grass outshines asphalt, asphalt concrete, concrete calm water",
          "[materials][state]") {
  const MaterialLibrary library = shipped_library();
  for (const double grazing_deg : {2.0, 3.0, 4.0, 5.0}) {
    double previous_dB = 100.0;
    for (const char* name : {"short_grass", "asphalt_worn", "concrete", "water_calm"}) {
      const double now_dB = level_dB(library, name, SurfaceState::dry, grazing_deg);
      INFO(name << " at " << grazing_deg);
      CHECK(now_dB < previous_dB - 1.0);
      previous_dB = now_dB;
    }
  }
}

TEST_CASE("What mirrors has a medium and a height, and the medium is known at 35 GHz",
          "[materials][state]") {
  const MaterialLibrary library = shipped_library();
  for (const Material& material : library.all()) {
    INFO(material.name);
    CHECK(material.dielectric.empty() == !material.rms_height_m.has_value());
    if (material.dielectric.empty()) continue;
    CHECK(valid_frequency_Hz(dielectric_medium_named(material.dielectric).value()).contains(35e9));
  }
}

}  // namespace
}  // namespace fanbeam::materials
