// Surface states and the limits of material models, from the scene file to the picture.
#include "scenes/scene_surfaces.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/files.h"
#include "core/units.h"
#include "renderer/frame.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {
namespace {

using scenes::Scene;

// A radar standing over a plain of one material.
std::string plain(const std::string& material, const std::string& more = "",
                  const std::string& top = "") {
  return top + R"([scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "ellipsoid"

[terrain]
half_extent_m = 4200.0
spacing_m = 100.0
material = ")" +
         material + R"("

[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 80.0

)" + more;
}

// The shipped sensor with another line in its file, in the scene's folder as radar.toml.
void write_sensor(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
  const std::string shipped =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1 << 20);
  folder.write("radar.toml", replaced(shipped, from, to));
}

std::unique_ptr<Scene> built(const TemporaryFolder& folder, const std::string& text,
                             const std::string& effects = "") {
  folder.write("scene.toml", text);
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  scenes::BuildOptions options;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  return scenes::build_scene(description, options, problems);
}

renderer::Frame frame_of(const Scene& scene) {
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  sampling.rays_per_cell = 1.0;
  return renderer::render_frame(scene.world, sampling, {true, false},
                                renderer::effects_of(scene.plan, 1), scene.frame_pose(0));
}

double level_dB(const Scene& scene, const std::string& material, double grazing_deg) {
  for (std::size_t i = 0; i < scene.world.geometry->material_names.size(); ++i)
    if (scene.world.geometry->material_names[i] == material)
      return 10.0 * std::log10(scene.world.nrcs[i].sigma0(std::sin(core::radians(grazing_deg))));
  FAIL("no material " << material);
  return 0.0;
}

TEST_CASE("A wet scene shows the wet rows, and says so", "[scenes][surfaces]") {
  const TemporaryFolder folder;
  const auto dry = built(folder, plain("short_grass"));
  const auto wet = built(folder, plain("short_grass", "[weather]\nsurface = \"wet\"\n"));
  CHECK_FALSE(dry->plan.runs(core::EffectId::surface_state));
  CHECK(wet->plan.runs(core::EffectId::surface_state));
  CHECK(level_dB(*wet, "short_grass", 3.0) - level_dB(*dry, "short_grass", 3.0) ==
        Approx(2.0).epsilon(0.0).margin(0.01));
  // Only the grass is in use: its 2 dB are the bound, 8.5 grey levels of 60 / 255 dB.
  for (const core::EffectDecision& decision : wet->plan.decisions)
    if (decision.effect == core::EffectId::surface_state)
      CHECK(decision.bound_dB == Approx(2.0).epsilon(0.0).margin(0.01));
  REQUIRE(wet->surfaces.size() == 1);
  CHECK(wet->surfaces[0].material == "short_grass");
  CHECK(wet->surfaces[0].shown_as == "short_grass_wet");
  CHECK(wet->surfaces[0].model == "phong");
  CHECK(core::degrees(wet->surfaces[0].grazing_rad.high) == Approx(60.0));
  const auto snow = built(folder, plain("short_grass", "[weather]\nsurface = \"dry-snow\"\n"));
  CHECK(level_dB(*snow, "short_grass", 3.0) == Approx(-17.8).epsilon(0.0).margin(0.1));
  const auto off =
      built(folder, plain("short_grass", "[weather]\nsurface = \"wet\"\n"), "-surface-state");
  CHECK(off->surfaces[0].shown_as == "short_grass");
  CHECK(frame_of(*off).bscope_W == frame_of(*dry).bscope_W);
  CHECK(frame_of(*wet).bscope_W != frame_of(*dry).bscope_W);
}

TEST_CASE("A state that changes no material is the dry picture byte for byte",
          "[scenes][surfaces]") {
  const TemporaryFolder folder;
  const auto dry = built(folder, plain("water_calm"));
  const std::string wet_scene = plain("water_calm", "[weather]\nsurface = \"wet\"\n");
  const auto as_needed = built(folder, wet_scene);
  const auto forced = built(folder, wet_scene, "+surface-state");
  CHECK_FALSE(as_needed->plan.runs(core::EffectId::surface_state));
  CHECK(forced->plan.runs(core::EffectId::surface_state));
  CHECK(frame_of(*forced).bscope_W == frame_of(*dry).bscope_W);
  CHECK(frame_of(*as_needed).bscope_grey == frame_of(*dry).bscope_grey);
}

TEST_CASE("A state pruned by the plan differs from the forced one by less than the budget",
          "[scenes][surfaces]") {
  const TemporaryFolder folder;
  const auto row = [](const std::string& name, const std::string& a, const std::string& wet) {
    return "[" + name + "]\na = " + a +
           "\nb = 0\nc = 1\nreference_frequency_GHz = 35\nfrequency_exponent = 0\n"
           "frequency_range_GHz = [30, 40]\ngrazing_range_deg = [1, 60]\npolarisation = \"any\"\n"
           "confidence = \"assumed\"\nsource = \"a test\"\nwhen_wet = \"" +
           wet + "\"\n";
  };
  // 10 log10(1.012) = 0.052 dB = 0.22 grey levels.
  folder.write("library.toml", row("moor", "0.05", "moor_wet") + row("moor_wet", "0.0506", "same"));
  const std::string scene =
      plain("moor", "[weather]\nsurface = \"wet\"\n", "material_library = \"library.toml\"\n");
  const auto pruned = built(folder, scene);
  const auto forced = built(folder, scene, "+surface-state");
  CHECK_FALSE(pruned->plan.runs(core::EffectId::surface_state));
  CHECK(forced->plan.runs(core::EffectId::surface_state));
  const std::vector<double> without = frame_of(*pruned).bscope_grey;
  const std::vector<double> with = frame_of(*forced).bscope_grey;
  double largest = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i)
    largest = std::max(largest, std::abs(with[i] - without[i]));
  CHECK(largest > 0.1);
  CHECK(largest < 0.25);
}

TEST_CASE("A frequency that a material is not known at is refused, unless the scene allows it",
          "[scenes][surfaces]") {
  const TemporaryFolder folder;
  write_sensor(folder, "frequency_GHz = 35.0", "frequency_GHz = 76.0");
  const std::string sensor = "[sensor]\nfile = \"radar.toml\"\n";
  const Outcome refused = build_text(folder, plain("water_calm", sensor));
  REQUIRE(refused.scene == nullptr);
  REQUIRE(refused.problems.size() == 1);
  CHECK(refused.problems[0].code == "E-RANGE");
  CHECK(refused.problems[0].field == "material 'water_calm' at frequency_GHz");
  CHECK(refused.problems[0].value == "76");
  CHECK(refused.problems[0].expected.starts_with("17 to 35 (model phong)"));
  // Grass is known there: only materials in use count.
  CHECK(build_text(folder, plain("short_grass", sensor)).scene != nullptr);

  const Outcome allowed =
      build_text(folder, plain("water_calm", sensor + "[materials]\nallow_extrapolation = true\n"));
  REQUIRE(allowed.scene != nullptr);
  REQUIRE(allowed.problems.size() == 1);
  CHECK(allowed.problems[0].code == "W-EXTRAPOLATED");
  REQUIRE(allowed.scene->surfaces.size() == 1);
  REQUIRE(allowed.scene->surfaces[0].extrapolations.size() == 1);
  CHECK(allowed.scene->surfaces[0].extrapolations[0].asked == "76");
  CHECK(allowed.scene->surfaces[0].extrapolations[0].known == "17 to 35");
  // What a material turns into is judged as well: snow is known to 40 GHz.
  const Outcome snow =
      build_text(folder, plain("short_grass", sensor + "[weather]\nsurface = \"dry-snow\"\n"));
  REQUIRE(snow.problems.size() == 1);
  CHECK(snow.problems[0].field == "material 'snow_dry' at frequency_GHz");
}

TEST_CASE("The sensor's polarisation picks the reflectivity and the tilt of the rain law",
          "[scenes][surfaces]") {
  const TemporaryFolder folder;
  write_sensor(folder, "polarisation = \"HH\"", "polarisation = \"VV\"");
  const std::string sensor = "[sensor]\nfile = \"radar.toml\"\n";
  const Outcome refused = build_text(folder, plain("concrete", sensor));
  REQUIRE(refused.problems.size() == 1);
  CHECK(refused.problems[0].value == "VV");
  CHECK(refused.problems[0].expected.starts_with("HH (model phong)"));

  folder.write("library.toml",
               "[pavement]\nmodel = \"oh1992\"\nmedium = \"concrete\"\nrms_height_mm = 0.2\n"
               "confidence = \"assumed\"\nsource = \"a test\"\n");
  const std::string top = "material_library = \"library.toml\"\n";
  const auto vertical = built(folder, plain("pavement", sensor, top));
  const auto horizontal = built(folder, plain("pavement", "", top));
  // Oh's model for this concrete at 20 deg: -32.2 dB VV, -38.3 dB HH.
  CHECK(level_dB(*vertical, "pavement", 20.0) == Approx(-32.2).epsilon(0.0).margin(0.1));
  CHECK(level_dB(*horizontal, "pavement", 20.0) == Approx(-38.3).epsilon(0.0).margin(0.1));
  CHECK(vertical->description.weather.polarisation_tilt_rad == Approx(core::kPi / 2.0));
  CHECK(horizontal->description.weather.polarisation_tilt_rad == 0.0);
  const auto told =
      built(folder, plain("pavement", sensor + "[weather]\npolarisation_tilt_deg = 45\n", top));
  CHECK(told->description.weather.polarisation_tilt_rad == Approx(core::kPi / 4.0));
}

}  // namespace
}  // namespace fanbeam::tests
