// The measured figures as CSV: ladder.csv, effects.csv, numerics.csv and equal_error.csv. Every
// column that has a unit ends in it; a figure that was not measured is an empty field.
#pragma once

#include <string>

#include "measure/figures.h"

namespace fanbeam::measure {

std::string ladder_csv(const CostFigures& figures);
std::string effects_csv(const CostFigures& figures);
std::string numerics_csv(const CostFigures& figures);
std::string equal_error_csv(const CostFigures& figures);

// B-scope errors at which ways of sampling are compared, and whether the receiver's noise is in
// both pictures.
struct EqualError {
  bool with_noise = true;
  double rms_grey = 0.0;
};
inline constexpr EqualError kEqualErrors[] = {{true, 2.0},  {true, 1.0},  {true, 0.5},
                                              {false, 5.0}, {false, 2.6}, {false, 1.2}};

}  // namespace fanbeam::measure
