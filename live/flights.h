// Flights that need no simulator, so that a newcomer sees something move.
#pragma once

#include <functional>

#include "core/pose.h"
#include "scenes/scene.h"

namespace fanbeam::live {

// Where the aircraft is at a time from 0 up; it never ends.
using Flight = std::function<core::Pose(double time_s)>;

// Round and round over the scene's first runway: a level circle that passes over a threshold along
// its course, at 70 m/s, banked as a coordinated turn is, 120 m above the highest ground below it
// and at least 150 m above the threshold. Of radii of 2, 1.5 and 1 km (less where the terrain is
// smaller) and both sides it is the widest that none of the others is 50 m below. A scene without a runway is circled at its middle; one
// with a trajectory is circled in the direction of its landing.
Flight circle(const scenes::Scene& scene);

// The scene's own trajectory, again and again. Throws InputError E-REF where it has none.
Flight approach(const scenes::Scene& scene);

}  // namespace fanbeam::live
