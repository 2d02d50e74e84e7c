// What a caller says of a session's targets, sensor and sampling: plain data.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "core/number_range.h"
#include "core/pose.h"
#include "core/swerling.h"
#include "materials/rcs/rcs.h"
#include "renderer/casting/sampling.h"
#include "sensors/sensor.h"

namespace fanbeam::session {

// Where a point scatterer is now. It stands there until told otherwise; its own speed matters to
// signals alone and is not modelled here.
struct TargetState {
  // Of the scene's own targets, all that have it: the lights of a runway share one. Another name is
  // a new target and needs `rcs`.
  std::string name;
  core::Geodetic position;           // ellipsoidal height
  std::optional<glm::dquat> q_NB{};  // its x axis is the boresight; else the scene's, or north
  std::optional<materials::RcsModel> rcs{};
  std::optional<core::Swerling> swerling{};
};

// What a pilot's panel and an installer set; the rest of a sensor is its file's.
struct SensorSettings {
  static constexpr core::NumberRange kLevels_dB{-400.0, 400.0};

  std::optional<double> boresight_elevation_rad{};  // tilt, -pi/2 to pi/2; the C-scope goes along
  std::optional<bool> stabilised{};
  std::optional<double> low_dB{},
      high_dB{};  // of the display's window, low below high, in kLevels_dB
  std::optional<sensors::Display::CScopeMode> cscope_mode{};
  std::optional<double> noise_figure{};  // of the receiver, linear, 1 to 1e6
};

// Rays, or slices, per range cell and column: the same for every frame. 0: the caster's default.
struct Samples {
  double per_cell = 0.0;
};
// Every frame refined until its estimated error is at most half of it; the other half is for
// effects that are left out. Above 0.
struct Accuracy {
  double grey_levels = 0.5;
};
// The finest of a ladder (session/sampling_choice.h) with which both pictures of a frame take at most
// so long on this machine, timed when it is set and kept until the next one. The slowest of three frames
// counts, spread over the scene's trajectory; a scene without one is refused. Where an accuracy is in
// force, the scene's or one that was asked for, no time is spent on more than that. Too short a time
// gives the coarsest, and a warning.
struct TimeBudget {
  double ms = 0.0;  // 0.1 to 1e7
};
// The last one says every setting of its own: references, estimates.
using SamplingWish = std::variant<Samples, Accuracy, TimeBudget, renderer::Sampling>;

}  // namespace fanbeam::session
