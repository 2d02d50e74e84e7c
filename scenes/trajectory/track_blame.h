// Private to the check of recorded flights: what is told of a row that no aircraft could have
// flown.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/trajectory/track_motion.h"
#include "scenes/trajectory/track_turning.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

struct BlamedRow {
  std::size_t row = 0;
  std::string what;  // "position", "height", "heading" and the like
  std::string value;
  std::string expected;
};

// The good rows around one, one of which may be missing at an end of the track.
struct GoodNeighbours {
  std::optional<std::size_t> before, after;
};

// Of row `i` of `motion`. `absolute`: by speeds alone.
BlamedRow blame(const RawTrack& track, const TrajectoryColumns& columns, const TrackMotion& motion,
                std::size_t i, const GoodNeighbours& good, bool absolute);
BlamedRow blame(const RawTrack& track, const TrackTurning& turning, std::size_t i,
                const GoodNeighbours& good);

// E-RANGE for every row, runs of more than eight in one. The rows increase.
void tell(const RawTrack& track, const std::vector<BlamedRow>& blamed, core::ProblemList& problems);

}  // namespace fanbeam::scenes
