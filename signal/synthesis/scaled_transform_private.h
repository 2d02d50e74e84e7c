// For eight samples at once: sums over an even grid of rates to evenly spaced times, with a scale
// that differs from sample to sample.
//
//   X_l[m] = sum over j of y_l[j] exp(j 2 pi a_l j m),  l = 0 ... 7, m < M, j < J
// Bluestein: j m = (j^2 + m^2 - (m - j)^2) / 2 makes it a convolution.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "signal/fourier/fft.h"
#include "signal/synthesis/lanes_private.h"

namespace fanbeam::signal {

class ScaledTransform {
 public:
  ScaledTransform(int inputs, int outputs, const std::array<double, kLanes>& turns_per_step);

  // Input j of lane l goes here; it must be multiplied with exp(j pi a_l j^2) before.
  std::complex<float>& input(int lane, int j) { return work_[at(lane, j)]; }
  // Sets what lies beyond the inputs to zero; call before inputs are written.
  void clear();
  void run();
  // X_l[m] but for the factor exp(j pi a_l m^2).
  std::complex<float> output(int lane, int m) const { return work_[at(lane, m)]; }

 private:
  std::size_t at(int lane, int i) const { return static_cast<std::size_t>(lane * length_ + i); }

  int length_;
  Fft<float> forward_, inverse_;
  std::vector<std::complex<float>> chirps_, work_;
};

}  // namespace fanbeam::signal
