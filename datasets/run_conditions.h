// What a run sets on the session of its scene: weather, surfaces, sensor, traffic.
#pragma once

#include "datasets/draw.h"
#include "session/session.h"

namespace fanbeam::datasets {

// `own` is the scene as it was opened: what the draw does not name is its. Gives the warnings of what is
// then set. Throws InputError with every problem; the session may then have some of the conditions.
core::ProblemList set_conditions(session::Session& session, const Campaign& campaign,
                                 const Draw& draw, const scenes::Scene& own);

// The scene's weather with that of the draw.
atmosphere::Weather weather_of(const Draw& draw, const atmosphere::Weather& own);

}  // namespace fanbeam::datasets
