// Bounds attacked at their thresholds: the decision flips where the bound crosses the budget; just
// under it the largest change of any pixel is below the budget, and, in scenes built to that end,
// above half of it.
#include "tests/scenes/effect_threshold.h"

#include <catch2/catch.hpp>
#include <string>

namespace fanbeam::tests {

TEST_CASE("Losses under their threshold: the farthest cell of level ground takes all of the bound",
          "[effects]") {
  EffectScene scene;
  scene.weather().humidity = 0.0;
  scene.weather().temperature_C = -5.0;
  scene.weather().fog_top_m = scene.weather().rain_top_m = scene.weather().snow_top_m = 3000.0;
  CHECK(change_under_threshold(
            scene, core::EffectId::gas,
            [](EffectScene& s, double x) { s.weather().pressure_hPa = x; },
            500.0) > 0.9 * kBudget_grey);
  CHECK(change_under_threshold(
            scene, core::EffectId::fog,
            [](EffectScene& s, double x) { s.weather().liquid_water_g_per_m3 = x; },
            0.01) > 0.9 * kBudget_grey);
  scene.weather().liquid_water_g_per_m3.reset();
  CHECK(change_under_threshold(
            scene, core::EffectId::snow,
            [](EffectScene& s, double x) { s.weather().snow_rate_mm_per_h = x; },
            0.1) > 0.9 * kBudget_grey);
  scene.weather().snow_rate_mm_per_h = 0.0;
  CHECK(change_under_threshold(
            scene, core::EffectId::rain,
            [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; },
            0.1) > 0.9 * kBudget_grey);
}

TEST_CASE("A rain cell that fills the path takes all of its bound", "[effects]") {
  EffectScene scene;
  scenes::RainCellDescription shower;
  shower.at.latitude_rad = core::radians(52.0);
  shower.at.longitude_rad = core::radians(10.0);
  shower.cell.radius_m = 20000.0;
  scene.description.rain_cells = {shower};
  CHECK(
      change_under_threshold(
          scene, core::EffectId::rain,
          [](EffectScene& s, double x) { s.description.rain_cells[0].cell.rain_rate_mm_per_h = x; },
          0.1) > 0.9 * kBudget_grey);
}

TEST_CASE("Surface state under its threshold changes every lit pixel by its bound", "[effects]") {
  EffectScene scene;
  scene.description.surface_state = materials::SurfaceState::wet;
  CHECK(change_under_threshold(
            scene, core::EffectId::surface_state,
            [](EffectScene& s, double x) {
              s.folder.write("library.toml", effect_materials(0.05, 1.0 + x));
            },
            0.01) > 0.99 * kBudget_grey);
}

TEST_CASE("Rain echo under its threshold, over ground at the display's black", "[effects]") {
  EffectScene scene;
  // The whole beam but its faint edge is above the horizon.
  scene.sensor().antenna.boresight_elevation_rad = core::radians(8.0);
  blacken(scene, scene.sensor().range.cells - 1, 4);
  CHECK(change_under_threshold(
            scene, core::EffectId::rain_echo,
            [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; },
            1e-5) > 0.9 * kBudget_grey);
}

TEST_CASE("Rain echo under its threshold where noise is the floor", "[effects]") {
  EffectScene scene;
  scene.sensor().antenna.boresight_elevation_rad = core::radians(10.0);
  const std::string wishes = off_but(core::EffectId::rain_echo, core::EffectId::thermal_noise);
  const Set rain = [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; };
  CHECK(change_under_threshold(scene, core::EffectId::rain_echo, rain, 1e-5, wishes) >
        0.9 * kBudget_grey);
  // Without noise the floor is the display's, and the same rain would be above the threshold.
  CHECK(decision_on(built(scene, others_off(core::EffectId::rain_echo))->plan,
                    core::EffectId::rain_echo)
            .bound_grey > 2.0 * kBudget_grey);
}

TEST_CASE("Thermal noise under its threshold, over ground at the display's black", "[effects]") {
  EffectScene scene;
  blacken(scene, scene.sensor().range.cells - 1, 4);
  CHECK(change_under_threshold(
            scene, core::EffectId::thermal_noise,
            [](EffectScene& s, double x) { s.sensor().waveform.transmit_power_W = 1.0 / x; },
            1e-4) > 0.9 * kBudget_grey);
}

TEST_CASE("Side lobes under their threshold, of a bright target in the nearest cell", "[effects]") {
  EffectScene scene(21);
  blacken(scene, 0, 20);
  add_target(scene, 202.0, -3.8, 1e4);
  CHECK(change_under_threshold(
            scene, core::EffectId::side_lobes,
            [](EffectScene& s, double x) {
              s.sensor().antenna.azimuth.side_lobe_gain = x;
              s.sensor().antenna.azimuth.side_lobe_extent_rad = core::radians(90.0);
            },
            1e-4) > 0.5 * kBudget_grey);
}

TEST_CASE("Lobes inside the cut widen the beam that the display counts in", "[effects]") {
  // Ground far too dark for its side lobes to show, and noise that does.
  EffectScene scene;
  scene.folder.write("library.toml", effect_materials(1e-12));
  sensors::BeamCut& beam = scene.sensor().antenna.azimuth;
  beam.shape = sensors::BeamCut::Shape::sinc_squared;
  beam.cut_rad = core::radians(5.0);
  const std::string wishes = off_but(core::EffectId::side_lobes, core::EffectId::thermal_noise);
  const Shown without = shown(scene, wishes + ",-side-lobes");
  const Shown with = shown(scene, wishes + ",+side-lobes");
  const double bound_grey = decision_on(with.plan, core::EffectId::side_lobes).bound_grey;
  const double change_grey = largest_difference_grey(without.frame, with.frame);
  CHECK(change_grey > 0.02);
  CHECK(change_grey <= bound_grey + 1e-9);  // the display's logarithm is a series
  CHECK(change_grey > 0.9 * bound_grey);
}

TEST_CASE("Range response under its threshold, of a faint target in the nearest cell",
          "[effects]") {
  EffectScene scene(9);
  // Nothing but the target is lit, and nothing else could be bright.
  scene.folder.write("library.toml", effect_materials(1e-12));
  scene.sensor().antenna.boresight_elevation_rad = core::radians(16.0);
  scene.sensor().waveform.window = sensors::Waveform::Window::hann;
  add_target(scene, 200.5, 16.0, 1e-4);
  blacken(scene, 0, 4, 0.1);
  CHECK(change_under_threshold(
            scene, core::EffectId::range_response,
            [](EffectScene& s, double x) { s.sensor().waveform.bandwidth_Hz = 1e9 / x; },
            0.7) > 0.5 * kBudget_grey);
}

TEST_CASE("What has no bound runs at every accuracy that leaves a picture", "[effects]") {
  EffectScene scene;
  scene.description.terrain.material = "pool";
  scenes::BoxDescription box;
  box.at.latitude_rad = core::radians(52.01);
  box.at.longitude_rad = core::radians(10.0);
  box.length_m = box.width_m = box.height_m = 20.0;
  box.wall_material = box.roof_material = "slab";
  scene.description.boxes = {box};
  add_target(scene, 1500.0, -1.0, 1.0);
  scene.description.targets[0].swerling = core::Swerling::case1;
  scene.description.sample = true;
  const core::EffectPlan plan = built(scene, "", 500.0)->plan;
  for (const auto effect : {core::EffectId::double_bounce, core::EffectId::multipath,
                            core::EffectId::speckle, core::EffectId::swerling}) {
    INFO(effect);
    CHECK(plan.runs(effect));
    CHECK(decision_on(plan, effect).bound_grey >= 255.0 * (1.0 - 1e-12));
  }
}

}  // namespace fanbeam::tests
