// Ratios of powers in decibels, as the tests that use them write out the formula.
#pragma once

#include <cmath>

namespace fanbeam::tests {

inline double dB(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace fanbeam::tests
