// Brings a scene just over and just under the magnitude at which an effect's bound crosses the
// budget.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "sensors/display/grey_scale.h"
#include "tests/scenes/effect_scene.h"

namespace fanbeam::tests {

inline constexpr double kBudget_grey = 0.25;  // half of the accuracy
using Set = std::function<void(EffectScene&, double)>;

// The magnitude at which the bound has this value: secants over logarithms, bounds being about
// powers of the magnitude.
inline double magnitude_at(double grey, EffectScene& scene, core::EffectId effect,
                           const std::string& wishes, const Set& set, double start) {
  double x = start, x_before = 0.0, bound_before = 0.0;
  for (int i = 0; i < 40; ++i) {
    set(scene, x);
    const double bound = decision_on(built(scene, wishes)->plan, effect).bound_grey;
    REQUIRE(bound > 0.0);
    if (std::abs(bound / grey - 1.0) < 1e-5) return x;
    double power = 1.0;
    if (i > 0 && bound != bound_before)
      power = std::log(x / x_before) / std::log(bound / bound_before);
    x_before = x;
    bound_before = bound;
    x *= std::pow(grey / bound, power);
  }
  FAIL("no magnitude has a bound of " << grey << " grey");
  return 0.0;
}

// Sets the scene just under the threshold and returns the largest change there.
inline double change_under_threshold(EffectScene& scene, core::EffectId effect, const Set& set,
                                     double start, const std::string& wishes) {
  INFO(effect);
  const std::string name(name_of(effect));
  set(scene, magnitude_at(1.002 * kBudget_grey, scene, effect, wishes, set, start));
  CHECK(built(scene, wishes)->plan.runs(effect));
  set(scene, magnitude_at(0.998 * kBudget_grey, scene, effect, wishes, set, start));
  const Shown without = shown(scene, wishes);
  CHECK_FALSE(without.plan.runs(effect));
  const Shown with = shown(scene, wishes + ",+" + name);
  REQUIRE(with.plan.runs(effect));
  const double change_grey = largest_difference_grey(without.frame, with.frame);
  CHECK(change_grey <= kBudget_grey);
  return change_grey;
}

inline double change_under_threshold(EffectScene& scene, core::EffectId effect, const Set& set,
                                     double start) {
  return change_under_threshold(scene, effect, set, start, others_off(effect));
}

inline std::string off_but(core::EffectId effect, core::EffectId other) {
  std::string wishes = others_off(effect);
  const std::string word = "-" + std::string(name_of(other));
  return wishes.replace(wishes.find(word), word.size(), "+" + std::string(name_of(other)));
}

// Makes what a cell shows without any effect the display's black.
inline void blacken(EffectScene& scene, int row, int column, double above_dB = 0.0) {
  const renderer::Frame frame = shown(scene, "none").frame;
  sensors::Sensor& sensor = scene.sensor();
  const double power_W =
      frame.bscope_W[static_cast<std::size_t>(row * sensor.scan.columns + column)];
  sensor.display.low_dB = sensors::GreyScale(sensor).level_dB(power_W, row) - above_dB;
}

inline void add_target(EffectScene& scene, double range_m, double elevation_deg, double rcs_m2) {
  const double elevation_rad = core::radians(elevation_deg);
  scenes::TargetDescription target;
  target.rcs = materials::ConstantRcs{rcs_m2};
  // 111.27 km a degree of latitude at 52 deg.
  scenes::Spot spot;
  spot.latitude_rad = core::radians(52.0 + range_m * std::cos(elevation_rad) / 111267.0);
  spot.longitude_rad = core::radians(10.0);
  target.path = {{0.0, spot, 60.0 + range_m * std::sin(elevation_rad)}};
  scene.description.targets = {target};
}

}  // namespace fanbeam::tests
