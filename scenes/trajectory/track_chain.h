// Private to the check of recorded flights: the rows that contradict the others.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace fanbeam::scenes {

// How hard it is to come from one row to a later one; beyond 1 it cannot be done.
using Strain = std::function<double(std::size_t from, std::size_t to)>;

// The fewest of `count` rows without which every step can be done. The strain of a step counts as
// that part of a row, so that a row which just fits between good ones is not kept for its own sake.
// Stretches between steps that cannot be done stand or fall as a whole, but
// for the two rows at each end; of the stretches before it, each looks at the nearest 16 and at the
// best of those before them. O(count).
std::vector<std::size_t> rows_off_the_chain(std::size_t count, const Strain& strain);

}  // namespace fanbeam::scenes
