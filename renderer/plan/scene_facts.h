// What the effect catalogue's bounds may use of a scene.
#pragma once

#include <optional>

#include "atmosphere/weather.h"
#include "renderer/plan/signal_facts.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// What is read out of frames beside their pictures: it counts however dark a display shows it.
struct Readings {
  bool watts() const { return power || labels; }

  bool power = false;       // watts, noise included
  bool labels = false;      // signal to clutter, noise included
  bool detections = false;  // what crosses a threshold, noise included
  bool obstacles = false;   // raised by thresholds, whatever the C-scope's mode
  bool signals = false;     // samples, whose maps hold noise and whose detections cross thresholds
};

// The sensor, the weather and the heights that rays pass through (above the scene's origin).
struct SceneFacts {
  atmosphere::Weather weather;
  sensors::Sensor sensor;
  double lowest_m = 0.0;  // of ground and aircraft
  double highest_m = 0.0;
  double vertical_turn_rad = 0.0;  // largest, from the origin's vertical to the aircraft's
  // Mirrored rays may meet something: a body, or ground that is not level.
  bool mirrored_rays_end = false;
  bool has_point_targets = false;
  bool reflects = false;         // a material in the scene reflects like a mirror
  bool ground_reflects = false;  // one of the ground does
  bool sample = false;           // frames show one realisation, not the expected power
  bool heights_shown = true;     // a C-scope, or obstacles: what mode shadow raises
  Readings read{};
  // Set by plan(): thermal noise runs whatever else does. By signal_plan(): the receiver's runs.
  bool noise_shown = false;
  bool fluctuating_targets = false;  // a target of Swerling case 1 to 4
  bool surface_not_dry = false;
  double surface_change_dB = 0.0;      // largest change of NRCS from dry to the scene's state
  bool state_changes_mirrors = false;  // a material mirrors otherwise in that state
  double largest_eta_m2_per_m3 = 0.0;  // of rain and snow, anywhere
  // The beam may pass the rim of the ground within range, and go on under it. What is mirrored ends on
  // ground, bodies and targets, and is as low as those at most.
  bool leaves_ground = true;
  double largest_sigma0_over_sine = 0.0;  // NRCS over sine of grazing of any material, any state
  double rcs_sum_m2 = 0.0;                // of the point targets, each at its brightest aspect
  std::optional<SignalFacts> signal{};    // of the samples that signal_plan() decides on
};

}  // namespace fanbeam::renderer
