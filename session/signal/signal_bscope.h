// The B-scope of a scene made from beat signals, column by column over the scan.
//
// For every look: scatterers of the frame with new places and phases (renderer/stages/
// frame_echoes.h), one sweep per column (signal/scan/column_scan.h), the receiver's noise, range
// cells; the powers of the looks are averaged. One look is a picture with its speckle, as a radar
// shows it; many come to the expected power of the renderer's picture with the same range response
// (renderer/accuracy/swept_picture.h), which is how the two levels are held against each other.
// Looks are independent but for targets of Swerling cases 1 and 3, which are one draw a frame.
// Neglected: what those headers say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "renderer/frame_pose.h"
#include "renderer/stages/ground_multipath.h"
#include "renderer/world.h"
#include "session/signal/receiver_plan.h"

namespace fanbeam::session {

struct SignalBscopeSettings {
  // Scatterers of a look in a range cell, at each of `azimuths` per column. Speckle is fully
  // developed from some ten scatterers in a cell and the beam's two and a half columns.
  double rays_per_cell = 1.0;
  int azimuths = 4;
  int looks = 0;                                              // 0: the sensor's
  glm::dvec3 own_velocity_mps{0.0};                           // of the antenna, in scene axes
  renderer::Multipath multipath = renderer::Multipath::none;  // of point targets
  bool swerling = false;
  SignalBudget budget{};  // decides over noise, phase noise and quantiser
  ReceiverSettings receiver{};
  std::uint64_t seed = 0;
};

struct SignalBscope {
  std::vector<double> power_W;  // [range cell][column], row 0 nearest, the receiver's noise in it
  int looks = 0;
  std::uint64_t rays = 0;        // of all looks
  std::uint64_t scatterers = 0;  // of all looks
  core::EffectPlan plan{};       // of the receiver, the largest bounds of all looks
  double phase_noise_rad = 0.0;  // largest of the looks in which it runs
  std::size_t clipped = 0;
  std::vector<std::string> events{};  // of renderer::FrameEchoes
};

// The sensor with a sweep that can be received: where its range cells are ideal (Window::none) it
// gets Taylor's window of its own level, -35 dB unless the file says otherwise.
sensors::Sensor with_sweep_window(sensors::Sensor sensor);

// Throws InputError as its parts do: E-UNSUPPORTED for a sensor without a sweep per column.
SignalBscope signal_bscope(const renderer::World& world, const renderer::FramePose& pose,
                           const SignalBscopeSettings& settings);

}  // namespace fanbeam::session
