// Nothing of an effect is the effect switched off, byte for byte; and what is off is not there: no
// data in the world, no random number.
#include <catch2/catch.hpp>
#include <string>

#include "core/files.h"
#include "renderer/frame.h"
#include "tests/scenes/effect_threshold.h"

namespace fanbeam::tests {
namespace {

renderer::Frame frame_of(const renderer::World& world, const renderer::FramePose& pose,
                         const renderer::Effects& effects) {
  return renderer::render_frame(world, coarse_sampling(), {}, effects, pose);
}

}  // namespace

TEST_CASE("Weather and surfaces of no consequence: forced on equals off, byte for byte",
          "[effects]") {
  const auto check = [](core::EffectId effect, const Set& set) {
    INFO(effect);
    EffectScene scene;
    scene.weather().temperature_C = -5.0;
    set(scene, 0.0);
    const std::string name(name_of(effect));
    const Shown on = shown(scene, "none,+" + name), off = shown(scene, "none,-" + name);
    CHECK(same_pictures(on.frame, off.frame));
    // The rest of the picture does not mind either.
    CHECK(same_pictures(shown(scene, "all,+" + name).frame, shown(scene, "all,-" + name).frame));
  };
  check(core::EffectId::fog,
        [](EffectScene& s, double x) { s.weather().liquid_water_g_per_m3 = x; });
  check(core::EffectId::rain, [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; });
  check(core::EffectId::snow, [](EffectScene& s, double x) { s.weather().snow_rate_mm_per_h = x; });
  check(core::EffectId::rain_echo,
        [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; });
  check(core::EffectId::surface_state, [](EffectScene& s, double x) {
    s.description.surface_state = materials::SurfaceState::wet;
    s.folder.write("library.toml", effect_materials(0.05, 1.0 + x));
  });
  check(core::EffectId::side_lobes, [](EffectScene& s, double x) {
    s.sensor().antenna.azimuth.side_lobe_gain = x;
    s.sensor().antenna.azimuth.side_lobe_extent_rad = core::radians(90.0);
  });
}

TEST_CASE(
    "R19 rain, side lobes and mirror images switched off are never having been, byte for byte",
    "[effects]") {
  // `make` puts into a scene what `wishes` then switches off again.
  const auto check = [](const Set& make, const std::string& wishes) {
    INFO(wishes);
    EffectScene never, there;
    for (EffectScene* scene : {&never, &there}) {
      scene->description.terrain.material = "pool";
      add_target(*scene, 1500.0, -2.2, 1.0);
    }
    make(never, 0.0);
    make(there, 1.0);
    const Shown without = shown(never, "all"), off = shown(there, "all," + wishes);
    CHECK(same_pictures(off.frame, without.frame));
    CHECK_FALSE(same_pictures(shown(there, "all").frame, off.frame));
  };
  check([](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = 5.0 * x; },
        "-rain,-rain-echo");
  check(
      [](EffectScene& s, double x) {
        if (x == 0.0) return;
        s.sensor().antenna.azimuth.side_lobe_gain = 1e-3;
        s.sensor().antenna.azimuth.side_lobe_extent_rad = core::radians(90.0);
      },
      "-side-lobes");
  check(
      [](EffectScene& s, double x) {
        std::string materials = effect_materials();
        const std::string mirror = "\ndielectric = \"water\"";
        REQUIRE(materials.find(mirror) != std::string::npos);
        if (x == 0.0) materials.resize(materials.find(mirror));
        s.folder.write("library.toml", materials);
      },
      "-multipath");
}

TEST_CASE("Cloud out of every path's way runs through the shipped kernels without a trace",
          "[effects]") {
  EffectScene scene;
  atmosphere::FogLayer cloud;
  cloud.liquid_water_g_per_m3 = 1.0;
  cloud.base_m = 1000.0;
  cloud.top_m = 2000.0;
  scene.weather().fog_layers = {cloud};
  const Shown off = shown(scene, "none"), on = shown(scene, "none,+fog");
  CHECK(on.plan.runs(core::EffectId::fog));
  CHECK(decision_on(on.plan, core::EffectId::fog).bound_grey == 0.0);
  CHECK_FALSE(shown(scene, "").plan.runs(core::EffectId::fog));
  CHECK(same_pictures(on.frame, off.frame));
}

TEST_CASE("A receiver without noise: thermal noise on equals off, byte for byte", "[effects]") {
  EffectScene scene;
  const auto built_scene = built(scene, "all");
  renderer::World& world = built_scene->world;
  const renderer::FramePose pose = built_scene->frame_pose(0);
  world.sensor.receiver.noise_figure = 0.0;
  CHECK(same_pictures(frame_of(world, pose, {{core::EffectId::thermal_noise}}),
                      frame_of(world, pose, {})));
  CHECK(same_pictures(
      frame_of(world, pose, {{core::EffectId::thermal_noise, core::EffectId::speckle}, 5}),
      frame_of(world, pose, {{core::EffectId::speckle}, 5})));
}

TEST_CASE("What is off is not in the world", "[effects]") {
  EffectScene scene;
  scene.weather().liquid_water_g_per_m3 = 0.1;
  scene.weather().rain_rate_mm_per_h = 5.0;
  scenes::RainCellDescription shower;
  shower.at.latitude_rad = core::radians(52.01);
  shower.at.longitude_rad = core::radians(10.0);
  shower.cell.radius_m = 300.0;
  shower.cell.rain_rate_mm_per_h = 10.0;
  scene.description.rain_cells = {shower};
  scene.sensor().antenna.azimuth.side_lobe_gain = 1e-3;
  scene.sensor().antenna.azimuth.side_lobe_extent_rad = core::radians(90.0);
  scene.sensor().waveform.window = sensors::Waveform::Window::hann;
  const auto full = built(scene, "all");
  CHECK_FALSE(full->world.attenuation.is_clear());
  CHECK(full->world.rain_cells);
  CHECK(full->world.volume_echo);
  CHECK(full->world.sensor.antenna.azimuth.side_lobe_gain > 0.0);
  const auto bare = built(scene, "none");
  CHECK(bare->world.attenuation.is_clear());
  CHECK_FALSE(bare->world.rain_cells);
  CHECK_FALSE(bare->world.volume_echo);
  CHECK(bare->world.sensor.antenna.azimuth.side_lobe_gain == 0.0);
  CHECK(renderer::effects_of(bare->plan, 3) == renderer::Effects{{}, 3});
}

TEST_CASE("Expected power takes no random number, a realisation names its own", "[effects]") {
  EffectScene scene;
  add_target(scene, 1500.0, -1.0, 1.0);
  scene.description.targets[0].swerling = core::Swerling::case2;
  scene.description.sample = true;
  const auto built_scene = built(scene, "all");
  const renderer::FramePose pose = built_scene->frame_pose(0);
  const auto seeded = [&](const std::string& effects, std::uint64_t seed) {
    const core::EffectPlan plan =
        renderer::plan(built_scene->facts, 0.5, renderer::parse_effect_wishes(effects));
    return frame_of(built_scene->world, pose, renderer::effects_of(plan, seed));
  };
  // A draw would show.
  CHECK(same_pictures(seeded("all,-speckle,-swerling", 1), seeded("all,-speckle,-swerling", 2)));
  CHECK_FALSE(same_pictures(seeded("all,-speckle", 1), seeded("all,-speckle", 2)));
  CHECK_FALSE(same_pictures(seeded("all,-swerling", 1), seeded("all,-swerling", 2)));
}

TEST_CASE("docs/effects.md has a section on every effect", "[effects]") {
  const std::string page =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/docs/effects.md", 1U << 20U);
  for (const renderer::Effect& effect : renderer::effect_catalogue()) {
    INFO(effect.name());
    CHECK(page.find("\n## " + std::string(effect.name()) + "\n") != std::string::npos);
  }
}

}  // namespace fanbeam::tests
