#include <algorithm>

#include "signal/synthesis/scaled_transform_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {

ScaledTransform::ScaledTransform(int inputs, int outputs,
                                 const std::array<double, kLanes>& turns_per_step)
    : length_(2 * fast_length((inputs + outputs + 1) / 2)),
      forward_({length_, 1, kLanes, length_}, FftDirection::forward),
      inverse_({length_, 1, kLanes, length_}, FftDirection::inverse),
      chirps_(static_cast<std::size_t>(kLanes * length_)),
      work_(static_cast<std::size_t>(kLanes * length_)) {
  for (int lane = 0; lane < kLanes; ++lane)
    for (int i = 0; i < std::max(inputs, outputs); ++i) {
      const double turns = -0.5 * turns_per_step[static_cast<std::size_t>(lane)] * i * i;
      const std::complex<double> exact = unit_phasor(turns);
      const std::complex<float> value(static_cast<float>(exact.real() / length_),
                                      static_cast<float>(exact.imag() / length_));
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
