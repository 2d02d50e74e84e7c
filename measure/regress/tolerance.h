// How far a rendered picture may be from the approved one, and whether it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image_compare.h"
#include "session/figure/difference_map.h"

namespace fanbeam::measure {

// Limits per layer: grey levels of pictures, the layer's own unit of ground truth, dB of power
// layers, where only cells positive in both have decibels. What is absent is not limited; but the cells of a power layer that are lit in one
// picture only are always counted, and none is allowed unless the limit says so. A cell whose
// difference is no finite number is within no limit.
struct Tolerance {
  std::optional<double> mean{};  // of |mean of new - approved|
  std::optional<double> rms{};
  std::optional<double> largest{};             // of any cell
  std::optional<double> percent{};             // of cells that are not equal
  std::optional<double> changed_percent{};     // of values of ground truth, beyond rounding
  std::optional<double> lit_in_one_percent{};  // of cells
  std::string reason{};                        // why this much is right
};

// One figure of a layer beside what is allowed; where there are cells without a finite difference,
// "not_finite" counts them, which no key allows.
struct Figure {
  std::string name;  // as the suite's key
  std::string unit;  // "grey", "dB", "deg", "%", "cells"
  double value = 0.0;
  std::optional<double> allowed;
  bool within = true;
};

struct LayerJudgement {
  std::string layer;
  std::vector<Figure> figures{};
  int largest_column = 0, largest_row = 0;
  bool within = true;
};

// Without a tolerance every value has to be equal.
LayerJudgement judge(const core::LayerDifference& difference, session::DifferenceUnit unit,
                     const std::optional<Tolerance>& tolerance);

}  // namespace fanbeam::measure
