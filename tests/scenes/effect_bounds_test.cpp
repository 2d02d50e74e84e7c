// Bounds of effects that act by a way round: of a surface's state through mirrors, and of fog for an
// antenna far from its aircraft.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/scenes/effect_scene.h"

namespace fanbeam::tests {
namespace {

// sigma0 = gamma sin, of sheet metal with a mirror of what that leaves.
std::string glaze(const std::string& name, const std::string& gamma, const std::string& wet) {
  return "[" + name + "]\na = " + gamma +
         "\nb = 0\nc = 1\nreference_frequency_GHz = 35\nfrequency_exponent = 0\n"
         "frequency_range_GHz = [1, 200]\ngrazing_range_deg = [0.01, 90]\npolarisation = \"any\"\n"
         "confidence = \"assumed\"\nsource = \"a test\"\ndielectric = \"metal\"\n"
         "rms_height_mm = 0.2\nwhen_wet = \"" +
         wet + "\"\n";
}

// A shed 1.1 km ahead.
void add_shed(EffectScene& scene, const std::string& material) {
  scenes::BoxDescription box;
  box.at.latitude_rad = core::radians(52.01);
  box.at.longitude_rad = core::radians(10.0);
  box.length_m = box.width_m = 100.0;
  box.height_m = 20.0;
  box.wall_material = box.roof_material = material;
  scene.description.boxes = {box};
  scene.description.surface_state = materials::SurfaceState::wet;
}

}  // namespace

// At 3.4 deg a gamma of 0.5 scatters two thirds of what arrives, one of 0.7 nearly all of it: the
// mirror loses 7 dB where the NRCS gains 1.5.
TEST_CASE("A state that leaves a mirror less to reflect changes a corner by more than its sigma0",
          "[effects]") {
  EffectScene scene;
  scene.folder.write("library.toml", effect_materials() + glaze("glaze", "0.5", "glaze_wet") +
                                         glaze("glaze_wet", "0.7", "same"));
  scene.description.terrain.material = "glaze";
  add_shed(scene, "slab");
  scene.sensor().display.low_dB = -60.0;
  scene.sensor().display.high_dB = 40.0;
  const Shown dry = shown(scene, "none,+double-bounce");
  const Shown wet = shown(scene, "none,+double-bounce,+surface-state");
  const core::EffectDecision& state = decision_on(wet.plan, core::EffectId::surface_state);
  CHECK(state.bound_dB == Approx(100.0));
  const double change_grey = largest_difference_grey(dry.frame, wet.frame);
  CHECK(change_grey > 1.3 * 10.0 * std::log10(1.4) * 255.0 / 100.0);
  CHECK(change_grey <= state.bound_grey);
}

TEST_CASE("What unchanged mirrors light counts twice the change of its NRCS", "[effects]") {
  EffectScene scene;
  scene.folder.write("library.toml", effect_materials(0.05, 2.0));
  scene.description.terrain.material = "pool";
  add_shed(scene, "moor");
  const auto bound_dB = [&] {
    return decision_on(built(scene, "")->plan, core::EffectId::surface_state).bound_dB;
  };
  CHECK(bound_dB() == Approx(20.0 * std::log10(2.0)).epsilon(0.0).margin(1e-3));
  scene.description.terrain.material = "slab";  // nothing mirrors
  CHECK(bound_dB() == Approx(10.0 * std::log10(2.0)).epsilon(0.0).margin(1e-3));
}

TEST_CASE("Fog between an aircraft and its antenna far above stays on", "[effects]") {
  EffectScene scene;
  atmosphere::FogLayer layer;
  layer.liquid_water_g_per_m3 = 0.5;
  layer.base_m = 460.0;  // 400 m above the aircraft
  layer.top_m = 760.0;
  scene.weather().fog_layers = {layer};
  CHECK_FALSE(built(scene, "")->plan.runs(core::EffectId::fog));
  scene.sensor().mounting.down_m = -800.0;
  scene.sensor().antenna.boresight_elevation_rad = core::radians(-13.0);
  const Shown with = shown(scene, "");
  CHECK(with.plan.runs(core::EffectId::fog));
  const double change_grey = largest_difference_grey(with.frame, shown(scene, "-fog").frame);
  CHECK(change_grey > 1.0);
  CHECK(change_grey <= decision_on(with.plan, core::EffectId::fog).bound_grey);
}

}  // namespace fanbeam::tests
