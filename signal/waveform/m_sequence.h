// Pseudo-noise codes of greatest length (m-sequences).
//
// A shift register of n stages with feedback of a primitive polynomial over GF(2) runs through all
// 2^n - 1 states. As +1 and -1 its periodic autocorrelation is 2^n - 1 at lag 0 and -1 at every
// other lag: 127 chips -42.08 dB, 1023 chips -60.20 dB (power).
// Source: S. W. Golomb, "Shift Register Sequences", 1967; polynomials: W. Stahnke, Math. Comp.
// 27(124), 1973.
#pragma once

#include <vector>

namespace fanbeam::signal {

// 2^degree - 1 chips of +1 or -1. Degrees 3 to 12; E-RANGE otherwise.
std::vector<int> m_sequence(int degree);

}  // namespace fanbeam::signal
