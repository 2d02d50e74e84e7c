// What is planned otherwise for signals than for pictures.
#include "session/signal/signal_session.h"

#include <catch2/catch.hpp>

#include "core/effect_plan.h"
#include "session/signal/paths.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

namespace {

// A target 55 m ahead of the small scene's standing radar, which the scene shows in its mean.
void write_scene_with_target(const tests::TemporaryFolder& folder) {
  folder.write("scene.toml",
               tests::standing() +
                   "[[target]]\nat = { latitude_deg = 52.0005, longitude_deg = 10.0 }\n"
                   "above_ground_m = 60.0\nrcs = { shape = \"constant\", rcs_dBsm = 10 }\n"
                   "swerling = 1\n[sensor]\nfile = \"automotive-76.toml\"\n");
}

std::shared_ptr<const scenes::Scene> signal_scene(const tests::TemporaryFolder& folder,
                                                  session::Setup setup) {
  core::ProblemList problems;
  setup.shipped = FANBEAM_SOURCE_DIR;
  return session::Session(folder.path(), setup, problems).scene();
}

double target_W(const scenes::Scene& scene, std::uint64_t seed) {
  session::FmcwSettings settings;
  settings.seed = seed;
  // The runway has lights.
  for (const core::Echo& echo : session::fmcw_paths(scene, 0, settings).targets)
    if (scene.world.targets[echo.object_id].name == "target") return echo.power_W;
  FAIL("the target has no echo");
  return 0.0;
}

}  // namespace

TEST_CASE("Targets fluctuate in samples whatever the scene's pictures show", "[fmcw]") {
  const tests::TemporaryFolder folder;
  write_scene_with_target(folder);
  const auto pictures = signal_scene(folder, {});
  CHECK(target_W(*pictures, 1) == target_W(*pictures, 2));
  const auto signals = signal_scene(folder, session::signal_setup());
  CHECK(target_W(*signals, 1) != target_W(*signals, 2));
  CHECK(target_W(*session::planned_for_signals(pictures), 1) == target_W(*signals, 1));
}

TEST_CASE("Signals have every effect with any influence, whatever a display hides", "[fmcw]") {
  const tests::TemporaryFolder folder;
  write_scene_with_target(folder);
  scenes::BuildOptions coarse;
  coarse.accuracy_grey = 4.0;
  const auto pictures = signal_scene(folder, {.build = coarse});
  CHECK_FALSE(pictures->plan.runs(core::EffectId::gas));
  const auto signals = signal_scene(folder, session::signal_setup(coarse));
  CHECK(signals->plan.runs(core::EffectId::gas));
  for (const core::EffectDecision& decision : signals->plan.decisions) {
    INFO(decision.reason);
    CHECK(decision.reason.find("product") == std::string::npos);  // none was asked for
  }
  CHECK(session::planned_for_signals(signals) == signals);
  const auto planned = session::planned_for_signals(pictures);
  CHECK(planned->plan.runs(core::EffectId::gas));
  coarse.wishes = renderer::parse_effect_wishes("-gas,-swerling", renderer::Touches::samples);
  const auto without = signal_scene(folder, session::signal_setup(coarse));
  CHECK_FALSE(without->plan.runs(core::EffectId::gas));
  CHECK(target_W(*without, 1) == target_W(*without, 2));
}
