// What is easily taken for nothing: terrain that mirrors into itself, rain beside the fan, masts that stand alone.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/effect_plan.h"
#include "core/files.h"
#include "renderer/frame.h"
#include "renderer/plan/effects.h"
#include "sensors/cells.h"
#include "sensors/sensor_file.h"
#include "tests/scenes/built_scene.h"

namespace fanbeam::tests {
namespace {

std::string standing_on(const std::string& terrain, const std::string& more = "") {
  return R"([scene]
name = "test"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
earth = "plane"
[terrain]
half_extent_m = 4000.0
)" + terrain +
         "\n" + more + kFixed;
}

renderer::Frame shown(const scenes::Scene& scene, renderer::CasterKind caster, double samples) {
  return renderer::render_frame(scene.world, renderer::sampling_for(caster, samples), {true, true},
                                renderer::effects_of(scene.plan, 1), scene.frame_pose(0));
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

constexpr const char* kHills =
    "generator = \"rolling\"\nrelief_m = 100.0\nspacing_m = 20.0\nfields = [\"bare_soil\"]\n"
    "wood_share = 0.0\n";

}  // namespace

// A box of five centimetres beside the view made the plan see walls: 5 grey levels RMS, over Innsbruck without its
// buildings 6 and 10.
TEST_CASE("Terrain alone mirrors into itself, whether or not a box lies somewhere",
          "[plan][bounce]") {
  const TemporaryFolder folder;
  const auto alone = good_scene(folder, standing_on(kHills));
  CHECK(alone->plan.runs(core::EffectId::double_bounce));
  const auto beside = good_scene(
      folder, standing_on(kHills,
                          "[[box]]\nat = { latitude_deg = 51.98, longitude_deg = 9.98 }\n"
                          "length_m = 0.1\nwidth_m = 0.1\nheight_m = 0.05\nwall = \"forest\"\n"
                          "roof = \"forest\"\n"));
  const renderer::Frame a = shown(*alone, renderer::CasterKind::rays, 2.0);
  const renderer::Frame b = shown(*beside, renderer::CasterKind::rays, 2.0);
  CHECK(rms(a.bscope_grey, b.bscope_grey) < 0.05);
  CHECK(rms(a.cscope_grey, b.cscope_grey) < 0.05);
  // Level ground cannot.
  const auto plane = good_scene(folder, standing_on("generator = \"plane\"\nspacing_m = 20.0\n"
                                                    "material = \"bare_soil\"\n"));
  CHECK_FALSE(plane->plan.runs(core::EffectId::double_bounce));
}

TEST_CASE("Rain beside the fan runs where it hides a target that side lobes see", "[plan][rain]") {
  const TemporaryFolder folder;
  std::string sensor =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1U << 20U);
  const std::string lobes = "side_lobe_level_dB = -30.0\nside_lobe_extent_deg = 90.0\n";
  // What the lobes take goes from the gain, or less is lost.
  folder.write("lobes.toml",
               replaced(replaced(sensor, "cut_deg = 1.25 ", lobes + "cut_deg = 1.25 "),
                        "efficiency = 0.714", "efficiency = 0.8078"));
  folder.write("none.toml", sensor);
  // At 60 deg and 2 km, a shower half way; forest, which does not mirror.
  const auto rain_runs = [&](const std::string& file) {
    return good_scene(folder,
                      "[sensor]\nfile = \"" + file + "\"\n" +
                          standing_on("generator = \"plane\"\nspacing_m = 20.0\n"
                                      "material = \"forest\"\n",
                                      "[[target]]\nname = \"t\"\nat = { latitude_deg = 52.009, "
                                      "longitude_deg = 10.0252 }\nabove_ground_m = 30.0\nrcs = { "
                                      "shape = \"constant\", rcs_dBsm = 70.0 }\n"
                                      "[[weather.rain_cell]]\nat = { latitude_deg = 52.0045, "
                                      "longitude_deg = 10.0126 }\nradius_m = 300.0\n"
                                      "rain_rate_mm_per_h = 200.0\ntop_m = 2500.0\n"))
        ->plan.runs(core::EffectId::rain);
  };
  CHECK(rain_runs("lobes.toml"));
  CHECK_FALSE(rain_runs("none.toml"));
}

// The fan of rays ended below them where they stood between the headings, or in the corner of a square, that were
// searched for tops: a C-scope 2.6 to 2.9 grey levels RMS off, whatever the rays. Each row of a mast of two sub-columns is met
// or missed in one azimuth of each: 0.3 to 0.8.
TEST_CASE("Rays reach the top of a mast wherever it stands", "[rays][thin]") {
  const TemporaryFolder folder;
  for (const double east_m : {-800.0, -403.0, -11.0, 7.0, 130.0, 395.0, 812.0}) {
    const double longitude_deg = 10.0 + east_m / 68677.0;
    const auto scene = good_scene(
        folder, standing_on("generator = \"plane\"\nspacing_m = 20.0\nmaterial = \"short_grass\"\n",
                            "[[box]]\nat = { latitude_deg = 52.0298, longitude_deg = " +
                                std::to_string(longitude_deg) +
                                " }\nlength_m = 3.0\nwidth_m = 3.0\nheight_m = 50.0\n"
                                "wall = \"metal\"\nroof = \"metal\"\n"));
    const renderer::Frame rays = shown(*scene, renderer::CasterKind::rays, 64.0);
    const renderer::Frame slices = shown(*scene, renderer::CasterKind::profile, 64.0);
    INFO(east_m << " m east");
    CHECK(rms(rays.cscope_grey, slices.cscope_grey) < 1.0);
  }
}

}  // namespace fanbeam::tests
