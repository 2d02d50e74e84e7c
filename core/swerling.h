// How a target's radar cross-section varies from look to look: the cases of P. Swerling,
// "Probability of detection for fluctuating targets", RAND RM-1217, 1954 (IRE Trans. IT-6, 1960).
//
//   case    power / mean                              drawn anew
//   steady  1                                         never (case 0 or 5)
//   case1   chi-square of 2 degrees, variance 1       every frame (scan to scan): many scatterers
//   case2   the same                                  every look and column (pulse to pulse)
//   case3   chi-square of 4 degrees, variance 1/2     every frame: one large scatterer, many small
//   case4   the same                                  every look and column
#pragma once

namespace fanbeam::core {

enum class Swerling { steady, case1, case2, case3, case4 };

}  // namespace fanbeam::core
