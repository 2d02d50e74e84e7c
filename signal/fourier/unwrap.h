// Phase unwrapping: adds multiples of 2 pi so that neighbours differ by at most pi.
//
// A step from one phase to the next is brought into (-pi, pi]: a step of exactly pi, which could go
// either way, counts as +pi (to within 1e-12 rad, so that the rounding of wrapped phases does not
// decide). True steps below pi are recovered; larger ones cannot be.
//
// A phase that is not finite gives NaN there, which marks the gap. What follows continues from the
// last finite phase, as if the two were neighbours: across the gap the number of turns is a guess.
// Accuracy: the result differs from the input by a whole multiple of 2 pi, to 1e-9 rad up to 1e6
// turns.
#pragma once

#include <vector>

namespace fanbeam::signal {

std::vector<double> unwrapped(const std::vector<double>& phases_rad);

}  // namespace fanbeam::signal
