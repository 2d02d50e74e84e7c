// Small scenes as data, for tests of what an effect changes: a plain of a material of our own under
// a narrowed HiVision, to be edited freely before it is shown.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "core/errors.h"
#include "core/units.h"
#include "renderer/frame.h"
#include "renderer/plan/effect_catalogue.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "tests/scenes/grey_difference.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

// sigma0 = gamma (sin + sin^2): "moor" gets wet, "slab" is bright, neither mirrors; "pool" is water.
inline std::string effect_materials(double gamma = 0.05, double wet_over_dry = 1.01) {
  const auto row = [](const std::string& name, double value, const std::string& more) {
    const std::string number = core::number_text(value);
    return "[" + name + "]\na = " + number + "\nb = " + number +
           "\nc = 2\nreference_frequency_GHz = 35\nfrequency_exponent = 0\n"
           "frequency_range_GHz = [1, 200]\ngrazing_range_deg = [0.01, 90]\npolarisation = "
           "\"any\"\n"
           "confidence = \"assumed\"\nsource = \"a test\"\n" +
           more + "\n";
  };
  return row("moor", gamma, "when_wet = \"moor_wet\"") +
         row("moor_wet", gamma * wet_over_dry, "when_wet = \"same\"") +
         row("slab", 0.3, "when_wet = \"same\"") +
         row("pool", 0.01, "when_wet = \"same\"\ndielectric = \"water\"\nrms_height_mm = 0.5");
}

struct EffectScene {
  // 60 m above the plain, `columns` of a quarter degree.
  explicit EffectScene(int columns = 8) {
    folder.write("library.toml", effect_materials());
    folder.write("scene.toml", R"(material_library = "library.toml"
[scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "ellipsoid"
earth = "plane"
[terrain]
half_extent_m = 4200.0
spacing_m = 600.0
material = "moor"
[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)");
    core::ProblemList problems;
    description = scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
    problems.throw_if_errors();
    sensors::Scan& scan = description.sensor.scan;
    scan.field_of_view_rad *= static_cast<double>(columns) / scan.columns;
    scan.columns = columns;
  }

  sensors::Sensor& sensor() { return description.sensor; }
  atmosphere::Weather& weather() { return description.weather; }

  TemporaryFolder folder;
  scenes::SceneDescription description;
};

inline std::unique_ptr<scenes::Scene> built(const EffectScene& scene, const std::string& effects,
                                            double accuracy_grey = 0.5) {
  core::ProblemList problems;
  scenes::BuildOptions options;
  options.accuracy_grey = accuracy_grey;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  return scenes::build_scene(scene.description, options, problems);
}

// One ray a cell and column: the same ones whatever is left out, but for side lobes.
inline renderer::Sampling coarse_sampling() {
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  return sampling;
}

struct Shown {
  renderer::Frame frame;
  core::EffectPlan plan;
};

// The frame in the middle of the flight.
inline Shown shown(const EffectScene& scene, const std::string& effects,
                   double accuracy_grey = 0.5) {
  const auto scene_built = built(scene, effects, accuracy_grey);
  return {renderer::render_frame(scene_built->world, coarse_sampling(), {},
                                 renderer::effects_of(scene_built->plan, 7),
                                 scene_built->frame_pose(scene_built->frame_count() / 2)),
          scene_built->plan};
}

inline const core::EffectDecision& decision_on(const core::EffectPlan& plan,
                                               core::EffectId effect) {
  const auto found =
      std::find_if(plan.decisions.begin(), plan.decisions.end(),
                   [&](const core::EffectDecision& each) { return each.effect == effect; });
  REQUIRE(found != plan.decisions.end());
  return *found;
}

inline bool same_pictures(const renderer::Frame& a, const renderer::Frame& b) {
  return a.bscope_W == b.bscope_W && a.cscope_W_m3 == b.cscope_W_m3 &&
         a.bscope_grey == b.bscope_grey && a.cscope_grey == b.cscope_grey;
}

// "+this,-all-others": the budget decides on nothing else.
inline std::string others_off(core::EffectId effect) {
  std::string wishes;
  for (const renderer::Effect& each : renderer::effect_catalogue())
    if (each.id != effect) wishes += (wishes.empty() ? "-" : ",-") + std::string(each.name());
  return wishes;
}

// A plan as one line a row, for the message of a failure.
inline std::string plan_text(const core::EffectPlan& plan) {
  std::string text;
  for (const core::EffectDecision& each : plan.decisions)
    if (each.on || each.bound_grey > 0.0)
      text += (each.on ? "  on  " : "  off ") + std::string(name_of(each.effect)) + " " +
              core::number_text(each.bound_grey) + " grey\n";
  return text;
}

}  // namespace fanbeam::tests
