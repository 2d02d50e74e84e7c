// An even grid over delay, delay rate and sine of azimuth, onto which paths are spread.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "signal/synthesis/spreading_kernel.h"

namespace fanbeam::signal {

// A path as three places on the grid, in cells, and a value.
struct WavePoint {
  double rate_cell = 0.0, sine_cell = 0.0;  // at least width / 2 inside the grid
  double delay_cell = 0.0;                  // around a circle
  std::complex<double> value;
};

class WaveGrid {
 public:
  WaveGrid(const SpreadingKernel& kernel, int rates, int sines, int delays);

  // Spreads all points; even slabs of rates at once, then odd ones, so that no two threads write
  // the same cell and the order of sums is that of the points within a cell's neighbourhood.
  void spread(const std::vector<WavePoint>& points);

  int rates() const { return rates_; }
  int sines() const { return sines_; }
  int delays() const { return delays_; }
  // delays() values of one rate and sine.
  std::complex<float>* row(int rate, int sine) {
    return values_.data() + (static_cast<std::size_t>(rate) * static_cast<std::size_t>(sines_) +
                             static_cast<std::size_t>(sine)) *
                                stride_;
  }
  const std::complex<float>* row(int rate, int sine) const {
    return const_cast<WaveGrid*>(this)->row(rate, sine);
  }

 private:
  int width_, rates_, sines_, delays_;
  std::size_t stride_;       // a row and what lies beyond its end
  std::vector<float> taps_;  // [power][8 taps]
  std::vector<std::complex<float>> values_;
};

}  // namespace fanbeam::signal
