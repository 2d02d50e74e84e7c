// Looks for what makes a scene numerically delicate. A pure function of the built scene: it casts no
// rays, and asks geometry alone.
//
// The meshes, the points and the ground before the runways were laid are built once more from the description,
// since a Scene keeps none of them by object. The flight is looked at in every frame for its height above the
// ground, in at most kMostSights of them, evenly spread, for what is in view.
// Every check, its threshold and the reason for it: docs/doctor.md.
// Neglected: hiding (what stands behind a hill counts as in view), buildings of [[buildings]] that
// are thinner than a ray, layers of one mesh over another, what moves besides targets.
// Cost: about as much as building the scene.
#pragma once

#include <vector>

#include "core/errors.h"
#include "scenes/doctor/finding.h"
#include "scenes/scene.h"

namespace fanbeam::scenes {

inline constexpr int kMostSights = 100;

// `warnings` are those of building the scene. The worst come first, in a fixed order.
Findings examine(const Scene& scene, const std::vector<core::Problem>& warnings);

// Behind all that are as bad or worse.
void add_in_order(Findings& findings, Finding finding);

}  // namespace fanbeam::scenes
