#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/synthesis/scaled_transform_private.h"
#include "signal/synthesis/spreading_kernel.h"

namespace fanbeam::signal {

ScaledTransform::ScaledTransform(int inputs, int outputs,
                                 const std::array<double, kLanes>& turns_per_step)
    : length_(even_fast_length(inputs + outputs)),
      forward_({length_, 1, kLanes, length_}, FftDirection::forward),
      inverse_({length_, 1, kLanes, length_}, FftDirection::inverse),
      chirps_(static_cast<std::size_t>(kLanes * length_)),
      work_(static_cast<std::size_t>(kLanes * length_)) {
  for (int lane = 0; lane < kLanes; ++lane)
    for (int i = 0; i < std::max(inputs, outputs); ++i) {
      const double turns = -0.5 * turns_per_step[static_cast<std::size_t>(lane)] * i * i;
      const double phase_rad = 2.0 * core::kPi * (turns - std::nearbyint(turns));
      const std::complex<float> value(static_cast<float>(std::cos(phase_rad) / length_),
                                      static_cast<float>(std::sin(phase_rad) / length_));
      if (i < outputs) chirps_[at(lane, i)] = value;
      if (i > 0 && i < inputs) chirps_[at(lane, length_ - i)] = value;
    }
  forward_.run(chirps_.data());
}

void ScaledTransform::clear() { std::fill(work_.begin(), work_.end(), 0.0f); }

void ScaledTransform::run() {
  forward_.run(work_.data());
  auto* values = reinterpret_cast<float*>(work_.data());
  const auto* chirps = reinterpret_cast<const float*>(chirps_.data());
  for (std::size_t i = 0; i < work_.size(); ++i) {
    const float re = values[2 * i] * chirps[2 * i] - values[2 * i + 1] * chirps[2 * i + 1];
    const float im = values[2 * i] * chirps[2 * i + 1] + values[2 * i + 1] * chirps[2 * i];
    values[2 * i] = re;
    values[2 * i + 1] = im;
  }
  inverse_.run(work_.data());
}

}  // namespace fanbeam::signal
