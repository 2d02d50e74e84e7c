// Where a model or a material is known.
#pragma once

namespace fanbeam::materials {

// Both ends belong to it.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return value >= low && value <= high; }
};

}  // namespace fanbeam::materials
