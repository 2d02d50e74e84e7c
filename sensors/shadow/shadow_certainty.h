// Whether a shadow can tell the height of what casts it.
//
// A run of dark cells is long for many reasons; height = h L / (R + L) holds for one that begins at
// the obstacle's top edge and ends on ground. That is taken as known only where
//   cut       no column's shadow ends at the gate or at another object
//   length    it lasts 6 cells: the search needs 4, and of those that hardly reach it only the ones
//             that happen to fit are found, often gaps between two buildings
//   before    ground is seen before the leading edge: within a factor of 2 below the clutter of its
//             range, 1.4 above it (q is clipped at 1.5). Brighter: another object or its roof.
//             Darker: a shadow or a runway, and the edge may be the end of that
//   behind    the same kind of ground goes on behind the end: five rows, their median within a
//             factor of 2 of the ground before, the least and the most within 2 of the median: more
//             than kinds of grass and crops differ by, less than asphalt, water or walls do
//   columns   the heights of the single columns agree: their median absolute deviation is at most
//             half of what the height may err, 1 m or one cell of shadow
// Inputs: runs of one obstacle, antenna's height above ground in m above 0.
// Not seen by any of these: ground behind that is lower or higher than the obstacle's foot by d
// (error d R / (R + L)) and ground below the aircraft at another height than there (error in
// proportion to h); a fan beam does not tell elevation. Cost: negligible.
// Accuracy: docs/physics/shadow-heights.md.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/median.h"
#include "sensors/sensor.h"
#include "sensors/shadow/shadow_runs.h"

namespace fanbeam::sensors {

using ShadowColumns = std::vector<ShadowRun>;  // of one obstacle

template <class Value>
double median_of(const ShadowColumns& columns, const Value& value) {
  std::vector<double> values;
  for (const ShadowRun& run : columns) values.push_back(value(run));
  return core::median(std::move(values));
}

// Slant ranges of the top edge and of the shadow's end, and the height they
// tell.
double top_range_m(const RangeGate& gate, const ShadowRun& run);
double end_range_m(const RangeGate& gate, const ShadowRun& run);
double shadow_height_m(const RangeGate& gate, const ShadowRun& run, double height_m);

bool tells_height(const RangeGate& gate, const ShadowColumns& columns, double height_m);

}  // namespace fanbeam::sensors
