// Bounds are bounds: no effect changes a pixel of any picture by more than the plan says, and what
// the plan leaves out stays within half of the accuracy asked for.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/effect_plan.h"
#include "core/files.h"
#include "renderer/frame.h"
#include "tests/scenes/effect_scene.h"
#include "tests/scenes/grey_difference.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {
namespace {

constexpr double kAccuracy_grey = 0.5;
// A fan of rays that reaches further samples the same ground with other rays.
constexpr double kSampling_grey = 0.05;

// Differences from the shipped sensor and from a plain of a moor of our own.
struct Case {
  std::string name;
  std::string mapping = "stc";
  std::string mode = "true_elevation";
  std::string weather = {};
  double height_m = 60.0;
  double boresight_deg = -3.8;
  double transmit_W = 1.0;
  std::string side_lobes = {};  // key of [antenna.azimuth]
  std::string window = "none";
  std::string target_dBsm = {};
  std::string mirrors = {};    // more keys of the dry moor, the wet one being another mirror
  std::string gamma = "0.05";  // sigma0 of the dry moor over the sine, with a lobe as high
};

std::string number(double value) { return core::number_text(value); }

void write_case(const TemporaryFolder& folder, const Case& c) {
  const auto row = [&](const std::string& name, const std::string& a, const std::string& wet) {
    return "[" + name + "]\na = " + a + "\nb = " + c.gamma +
           "\nc = 2\nreference_frequency_GHz = 35\nfrequency_exponent = 0\n"
           "frequency_range_GHz = [30, 40]\ngrazing_range_deg = [1, 60]\npolarisation = \"any\"\n"
           "confidence = \"assumed\"\nsource = \"a test\"\nwhen_wet = \"" +
           wet + "\"\n" + (wet == "same" ? "" : c.mirrors);
  };
  folder.write(
      "library.toml",
      row("moor", c.gamma, "moor_wet") +
          row("moor_wet", number((c.mirrors.empty() ? 1.01 : 1.0) * std::stod(c.gamma)), "same"));
  std::string sensor =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1U << 20U);
  const auto put = [&](const std::string& from, const std::string& to) {
    sensor = replaced(sensor, from, to);
  };
  put("field_of_view_deg = 41.0\ncolumns = 164", "field_of_view_deg = 4.0\ncolumns = 16");
  put("boresight_elevation_deg = -3.8", "boresight_elevation_deg = " + number(c.boresight_deg));
  put("transmit_power_W = 1.0", "transmit_power_W = " + number(c.transmit_W));
  put("window = \"none\"", "window = \"" + c.window + "\"");
  put("cut_deg = 1.25 ", c.side_lobes + "\ncut_deg = 1.25 ");
  put("mode = \"true_elevation\"", "mode = \"" + c.mode + "\"");
  put("mapping = \"stc\"", "mapping = \"" + c.mapping + "\"");
  if (c.mapping == "log") {
    put("low_dB = -55.0", "low_dB = -160.0");
    put("high_dB = 5.0", "high_dB = -80.0");
  }
  folder.write("radar.toml", sensor);
  std::string target;
  if (!c.target_dBsm.empty())
    target =
        "[[target]]\nat = { latitude_deg = 52.018, longitude_deg = 10.0 }\nrcs = { shape = "
        "\"constant\", rcs_dBsm = " +
        c.target_dBsm + " }\nabove_ground_m = 3.0\n";
  folder.write("scene.toml", R"(material_library = "library.toml"
[sensor]
file = "radar.toml"
[scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "ellipsoid"
[terrain]
half_extent_m = 4200.0
spacing_m = 600.0
material = "moor"
[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = )" + number(c.height_m) +
                                 "\n[weather]\n" + c.weather + "\n" + target);
}

Shown shown(const TemporaryFolder& folder, const std::string& effects) {
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  scenes::BuildOptions options;
  options.accuracy_grey = kAccuracy_grey;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  const auto scene = scenes::build_scene(description, options, problems);
  return {renderer::render_frame(scene->world, coarse_sampling(), {true, true},
                                 renderer::effects_of(scene->plan, 1), scene->frame_pose(0)),
          scene->plan};
}

double bound_of(const core::EffectPlan& plan, core::EffectId effect) {
  for (const core::EffectDecision& decision : plan.decisions)
    if (decision.effect == effect) return decision.bound_grey;
  return -1.0;
}

// Returns the largest differences by effect, with nothing else on and, if wanted, with all else on.
std::map<std::string, double> check_bounds(const Case& c, bool among_others) {
  INFO(c.name << ", " << c.mapping << ", " << c.mode);
  const TemporaryFolder folder;
  write_case(folder, c);
  const Shown as_needed = shown(folder, "");
  const Shown none = shown(folder, "none");
  const Shown all = shown(folder, "all");
  std::map<std::string, double> worst;
  for (const core::EffectDecision& decision : as_needed.plan.decisions) {
    const std::string effect(name_of(decision.effect));
    if (!all.plan.runs(decision.effect)) continue;
    const double sampling = decision.effect == core::EffectId::side_lobes ? kSampling_grey : 0.0;
    // Noise that is shown is part of the floor: each bound is that of its own plan.
    const auto check = [&](const Shown& from, const std::string& changed) {
      const double bound_grey = bound_of(from.plan, decision.effect);
      INFO(effect << ", " << changed << ", bound " << bound_grey << " grey");
      const double change = largest_difference_grey(from.frame, shown(folder, changed).frame);
      CHECK(change <= std::min(bound_grey, 255.0) + sampling + 1e-9);
      worst[effect] = std::max(worst[effect], change);
    };
    check(none, "none,+" + effect);
    if (among_others) check(all, "all,-" + effect);
  }
  CHECK(largest_difference_grey(all.frame, as_needed.frame) <= kAccuracy_grey / 2.0);
  return worst;
}

const std::vector<std::string> kMappings = {"stc", "log", "seed"};
const std::vector<std::string> kModes = {"true_elevation", "flat_earth", "shadow"};

}  // namespace

TEST_CASE("No effect changes a picture by more than its bound, in any mapping and mode",
          "[scenes][pruned]") {
  // Faint enough that bounds lie below the window, where the geometry allows.
  const std::string faint =
      "rain_rate_mm_per_h = 0.02\nsnow_rate_mm_per_h = 0.01\nmelting_height_m = 30.0\nfog_top_m = "
      "100.0\n"
      "liquid_water_g_per_m3 = 0.001\nsurface = \"wet\"\n";
  for (const std::string& mapping : kMappings)
    for (const std::string& mode : kModes) {
      Case c{"faint", mapping, mode, faint};
      c.side_lobes = "side_lobe_level_dB = -80.0";
      c.window = "hann";
      const auto worst = check_bounds(c, false);
      CHECK(worst.size() == 9);
    }
}

TEST_CASE("The seed's window counts for the echo of rain", "[scenes][pruned]") {
  const auto worst =
      check_bounds({"rain", "seed", "true_elevation", "rain_rate_mm_per_h = 20.0\n"}, true);
  CHECK(worst.at("rain-echo") > 40.0);
}

TEST_CASE("A cloud above the ground takes from the echo of rain beyond it", "[scenes][pruned]") {
  Case c{"cloud", "stc", "true_elevation",
         "rain_rate_mm_per_h = 10.0\n[[weather.fog_layer]]\nliquid_water_g_per_m3 = 3.0\n"
         "base_m = 400.0\ntop_m = 3000.0\n"};
  c.boresight_deg = 10.0;
  const auto worst = check_bounds(c, true);
  CHECK(worst.at("fog") > 1.0);
}

TEST_CASE("A row of the flat-earth C-scope near the ground holds the noise of many cells",
          "[scenes][pruned]") {
  for (const std::string& mode : kModes) {
    Case c{"low", "stc", mode};
    // Each cell is below the floor, a row of them above it.
    c.gamma = "2e-4";
    c.height_m = 5.0;
    c.transmit_W = 1000.0;
    const auto worst = check_bounds(c, true);
    if (mode == "flat_earth") CHECK(worst.at("thermal-noise") > 0.05);
  }
}

TEST_CASE("Side lobes and range response of a target as bright as is accepted",
          "[scenes][pruned]") {
  for (const std::string& mapping : kMappings) {
    Case c{"bright", mapping};
    c.target_dBsm = "80.0";
    c.side_lobes = "side_lobe_level_dB = -50.0";
    c.window = "taylor";
    const auto worst = check_bounds(c, false);
    if (mapping != "seed") CHECK(worst.at("side-lobes") > 0.25);
  }
}

TEST_CASE("A state that changes mirrors alone has no bound where targets are mirrored",
          "[scenes][pruned]") {
  Case c{"mirror", "stc", "true_elevation", "surface = \"wet\"\n"};
  c.mirrors = "dielectric = \"moist_soil\"\nrms_height_mm = 1\n";
  const auto bound_dB = [](const Case& with) {
    const TemporaryFolder folder;
    write_case(folder, with);
    const Shown as_needed = shown(folder, "");
    for (const core::EffectDecision& decision : as_needed.plan.decisions)
      if (decision.effect == core::EffectId::surface_state) return decision.bound_dB;
    return -1.0;
  };
  CHECK(bound_dB(c) == 0.0);
  c.target_dBsm = "10.0";
  CHECK(bound_dB(c) == Approx(60.0));
  check_bounds(c, true);
}

}  // namespace fanbeam::tests
