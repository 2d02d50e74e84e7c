// What was set since a scene was opened, as a JSON text.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace fanbeam::session {

// An object of what `now` has otherwise than `opened`, the same site before anything was set:
//   weather   members with the keys and units of [weather] in scene files; null: unset
//   sensor    tilt, stabilisation, display and noise figure, as far as a session sets them
//   targets   those that are new or not as they were: cross-section, Swerling case (0 to 4), path, and
//             x, y and z axis in the scene's east, north, up
// Empty where nothing is.
std::string changed_conditions_json(const scenes::Scene& opened, const scenes::Scene& now);

}  // namespace fanbeam::session
