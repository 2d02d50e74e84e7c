// What is asked of a frame and what it holds. frame_renderer.h keeps the stages for many of one world.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/accuracy/error_estimate.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame_pose.h"
#include "renderer/plan/effects.h"
#include "renderer/stages/frame_layers.h"
#include "renderer/stages/threshold.h"
#include "renderer/world.h"
#include "sensors/shadow/shadow_obstacles.h"

namespace fanbeam::renderer {

// What is wanted of each frame; only that is computed.
struct Products {
  bool bscope = true;
  bool cscope = true;
  bool detections = false;
  bool obstacles = false;
  bool layers = false;  // of the B-scope
  bool cscope_layers = false;

  auto operator<=>(const Products&) const = default;
};

// Arrays are row-major [row][column]; B-scope row 0 is the nearest range cell, C-scope row 0 the
// highest elevation.
struct Frame {
  // Expected power of the echoes; with speckle on, a realisation with its noise.
  std::vector<double> bscope_W;
  // Mean noise that the receiver adds to each cell of bscope_W: 0 without thermal noise, and in a
  // realisation, which holds its draw of it.
  double noise_W = 0.0;
  // The same times R^3, summed over range. In the modes shadow and flat_earth, which draw what the
  // receiver gives out, from received_W(): the noise is in it.
  std::vector<double> cscope_W_m3;
  std::vector<double>
      bscope_grey;  // unrounded, 0 to 255, with the mean noise power when noise is on
  std::vector<double> cscope_grey;
  std::vector<ThresholdDetection> detections;
  std::vector<sensors::ShadowObstacle> obstacles;  // also for a C-scope of mode shadow
  std::uint64_t rays = 0;
  std::uint64_t slices = 0;
  std::uint64_t blanked = 0;           // hits nearer than the first range cell
  std::uint64_t unprojected = 0;       // point targets without a direction; point_targets.h
  std::optional<FrameLayers> layers;   // when asked for; frame_layers.h
  std::optional<ErrorEstimate> error;  // when the sampling asks for it
  // "below_terrain": the sensor is not above the ground, the picture holds noise alone. A C-scope of
  // the modes shadow and flat_earth, which draw ground below the sensor, is black; beside the ground,
  // or without any (World), it is told of frames with such a C-scope alone, and the B-scope is whole.
  // "empty_view": nothing was hit.
  std::vector<std::string> events;

  // What the receiver gives out and the display shows: bscope_W and the noise.
  std::vector<double> received_W() const;
};

// One frame by stages that are made for it alone. Errors: those of FrameRenderer.
Frame render_frame(const World& world, const Sampling& sampling, const Products& products,
                   const Effects& effects, const FramePose& pose);

}  // namespace fanbeam::renderer
