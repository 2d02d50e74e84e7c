// What a scene's materials mirror, and when the effects of it run.
#include "scenes/scene_mirrors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "core/files.h"
#include "materials/dielectric/dielectric_medium.h"
#include "core/effect_plan.h"
#include "tests/scenes/shipped_scene.h"

using namespace fanbeam;
using tests::shipped_scene;

namespace {

const std::optional<materials::SpecularSurface>& mirror_of(const scenes::Scene& scene,
                                                           const std::string& material) {
  const std::vector<std::string>& names = scene.world.geometry->material_names;
  const auto at = std::find(names.begin(), names.end(), material);
  REQUIRE(at != names.end());
  return scene.world.specular.at(static_cast<std::size_t>(at - names.begin()));
}

// The small scene on asphalt, with a light on it, seen at 76 GHz.
std::string asphalt_at_76_GHz(const tests::TemporaryFolder& folder, const std::string& more) {
  const std::string sensor =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1 << 20);
  folder.write("radar.toml",
               tests::replaced(sensor, "frequency_GHz = 35.0", "frequency_GHz = 76.0"));
  std::string scene = tests::replaced(tests::kSmallScene, "short_grass", "asphalt_worn");
  scene = tests::replaced(scene, "[[runway]]",
                          "[[runway]]\nedge_lights = false\nmarkings = false\n"
                          "shoulder = \"asphalt_worn\"\nmarking = \"asphalt_worn\"\n");
  return tests::replaced(scene, "[weather]", "wall = \"wall\"\nroof = \"wall\"\n" + more + R"(
[[target]]
name = "light"
at = { runway = "36", behind_threshold_m = 100.0, left_m = 40.0 }
above_ground_m = 1.0
rcs = { shape = "constant", rcs_dBsm = 0.0 }

[sensor]
file = "radar.toml"

[weather])");
}

std::string reason_of(const scenes::Scene& scene, core::EffectId effect) {
  for (const core::EffectDecision& decision : scene.plan.decisions)
    if (decision.effect == effect) return decision.reason;
  return "";
}

std::vector<core::Problem> about_mirrors(const tests::Outcome& outcome) {
  std::vector<core::Problem> found;
  for (const core::Problem& problem : outcome.problems)
    if (problem.field.find("dielectric") != std::string::npos) found.push_back(problem);
  return found;
}

}  // namespace

TEST_CASE("Materials mirror as their rows say; canopies do not", "[mirrors]") {
  const auto scene = shipped_scene("obstacle-field");
  const auto& concrete = mirror_of(*scene, "concrete");
  REQUIRE(concrete);
  CHECK(concrete->rms_height_m == Approx(0.2e-3));
  CHECK(concrete->permittivity.real == Approx(5.24));  // ITU-R P.2040-3, no frequency in it
  CHECK_FALSE(mirror_of(*scene, "forest").has_value());
}

TEST_CASE("Walls, targets and mirrors decide which reflections run", "[mirrors]") {
  const auto field = shipped_scene("obstacle-field");
  CHECK(field->plan.runs(core::EffectId::double_bounce));
  CHECK(field->plan.runs(core::EffectId::multipath));
  const auto grass = shipped_scene("flat-grass");
  CHECK_FALSE(grass->plan.runs(core::EffectId::double_bounce));
  CHECK_FALSE(grass->plan.runs(core::EffectId::multipath));
}

TEST_CASE("A medium that is not known at the frequency is missed, and the plan tells the truth",
          "[mirrors]") {
  const tests::TemporaryFolder folder;
  const tests::Outcome outcome = tests::build_text(folder, asphalt_at_76_GHz(folder, ""));
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  // Asphalt ends at 40 GHz; the concrete of the walls is known to 100 GHz.
  CHECK_FALSE(mirror_of(*outcome.scene, "asphalt_worn").has_value());
  CHECK(mirror_of(*outcome.scene, "wall").has_value());
  const std::vector<core::Problem> told = about_mirrors(outcome);
  REQUIRE(told.size() == 1);
  CHECK(told[0].code == "W-EXTRAPOLATED");
  CHECK(told[0].field == "material 'asphalt_worn' at frequency_GHz of dielectric asphalt");
  CHECK(told[0].value == "76");
  CHECK(told[0].expected.starts_with("known for 1 to 40; does not mirror"));
  CHECK_FALSE(outcome.scene->plan.runs(core::EffectId::multipath));
  CHECK(reason_of(*outcome.scene, core::EffectId::multipath)
            .find("known to mirror at this frequency") != std::string::npos);
  for (const scenes::SurfaceRecord& record : outcome.scene->surfaces)
    CHECK(record.extrapolations.empty());
}

TEST_CASE(
    "Where extrapolation is allowed the medium is held at its nearest frequency, and recorded",
    "[mirrors]") {
  const tests::TemporaryFolder folder;
  const tests::Outcome outcome = tests::build_text(
      folder, asphalt_at_76_GHz(folder, "[materials]\nallow_extrapolation = true\n"));
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  const auto& asphalt = mirror_of(*outcome.scene, "asphalt_worn");
  REQUIRE(asphalt);
  const materials::Permittivity at_40_GHz =
      permittivity_of(materials::DielectricMedium::asphalt, 40e9, 288.15);
  CHECK(asphalt->permittivity.real == at_40_GHz.real);
  CHECK(asphalt->permittivity.loss == at_40_GHz.loss);
  CHECK(outcome.scene->plan.runs(core::EffectId::multipath));
  const std::vector<core::Problem> told = about_mirrors(outcome);
  REQUIRE(told.size() == 1);
  CHECK(told[0].expected == "known for 1 to 40; mirrors as at 40 GHz");
  const auto& records = outcome.scene->surfaces;
  const auto at = std::find_if(
      records.begin(), records.end(),
      [](const scenes::SurfaceRecord& record) { return record.material == "asphalt_worn"; });
  REQUIRE(at != records.end());
  REQUIRE(at->extrapolations.size() == 1);
  CHECK(at->extrapolations[0].quantity == "frequency_GHz of dielectric asphalt");
  CHECK(at->extrapolations[0].asked == "76");
  CHECK(at->extrapolations[0].known == "1 to 40");
}

TEST_CASE("Nothing is told of mirrors that no effect would use", "[mirrors]") {
  const tests::TemporaryFolder folder;
  std::string scene = asphalt_at_76_GHz(folder, "");
  const std::size_t box = scene.find("[[box]]"), sensor = scene.find("[sensor]");
  scene.erase(box, sensor - box);
  const tests::Outcome outcome = tests::build_text(folder, scene);
  REQUIRE(outcome.scene != nullptr);
  CHECK(about_mirrors(outcome).empty());
}

TEST_CASE("Surfaces have the temperature of the air at the origin, from whatever describes it",
          "[mirrors]") {
  const tests::TemporaryFolder folder;
  const auto grass = [&](const std::string& weather) {
    const auto scene = tests::good_scene(
        folder, tests::replaced(tests::kSmallScene, "visibility_m = 400.0\n", weather));
    const auto& mirror = mirror_of(*scene, "short_grass");
    REQUIRE(mirror.has_value());
    return mirror->permittivity.real;
  };
  const auto moist_soil = [](double temperature_K) {
    return permittivity_of(materials::DielectricMedium::moist_soil, 35e9, temperature_K).real;
  };
  const std::string levels = R"(
[[weather.level]]
height_m = -100.0
temperature_C = 31.0
humidity = 0.5

[[weather.level]]
height_m = 100.0
temperature_C = 25.0
humidity = 0.5

)";
  CHECK(std::abs(moist_soil(301.15) / moist_soil(288.15) - 1.0) > 0.01);
  // The origin lies half way between the levels.
  CHECK(grass(levels) == Approx(moist_soil(301.15)).epsilon(1e-6));
  CHECK(grass("temperature_C = 2.5\n") == Approx(moist_soil(275.65)).epsilon(1e-9));
  // The reference atmosphere, 6.5 K/km below 15 C.
  CHECK(grass("") == Approx(moist_soil(288.15 - 0.325)).epsilon(1e-5));
  // Frost is neglected: unfrozen soil at 0 C.
  CHECK(grass("temperature_C = -8\n") == Approx(moist_soil(273.15)).epsilon(1e-12));
}
