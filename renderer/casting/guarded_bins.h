// Bins with room for what falls outside on both sides, so that nobody has to ask.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "renderer/casting/deposit.h"

namespace fanbeam::renderer {

class GuardedBins {
 public:
  void reset(int count) {
    count_ = count;
    bins_.assign(static_cast<std::size_t>(count) + kGuard + 2, 0.0);
  }
  // `share` goes to bin `first`, `rest` to the next.
  void add_two(int first, double share, double rest) {
    const int bin = std::clamp(first, -kGuard, count_) + kGuard;
    bins_[static_cast<std::size_t>(bin)] += share;
    bins_[static_cast<std::size_t>(bin) + 1] += rest;
  }
  void add_wide(double from, double to, double amount) {
    deposit(from, to, amount, bins_.data() + kGuard, count_);
  }
  void copy_to(double* to) const {
    std::copy(bins_.begin() + kGuard, bins_.begin() + kGuard + count_, to);
  }

 private:
  static constexpr int kGuard = 2;
  int count_ = 0;
  std::vector<double> bins_;
};

}  // namespace fanbeam::renderer
