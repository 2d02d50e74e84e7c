// Error of a picture against a converged one, as the project states it: on unrounded grey clamped
// to 0..255, with the receiver's mean noise power in both pictures and without.
#pragma once

#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::renderer {

struct GreyError {
  double rms = 0.0;      // over all cells
  double lit_rms = 0.0;  // over cells whose noise-free reference is above grey 0
  double lit_p99 = 0.0;  // 99th percentile of the absolute difference over them
};

struct PictureError {
  GreyError with_noise, noise_free;
};

struct FrameError {
  PictureError bscope, cscope;
};

// A frame as it leaves the caster, before noise and display.
struct FramePower {
  std::vector<double> bscope_W;
  std::vector<double> cscope_W_m3;
};

// A frame's grey, the noise in it or not.
struct FrameGrey {
  std::vector<double> bscope, cscope;
};

FrameGrey grey_of(const sensors::Sensor& sensor, const FramePower& power, bool noise);

class GreyReference {
 public:
  GreyReference(const sensors::Sensor& sensor, const FramePower& power);
  FrameError error_of(const FramePower& power) const;

 private:
  sensors::Sensor sensor_;
  FrameGrey with_noise_, noise_free_;
};

}  // namespace fanbeam::renderer
