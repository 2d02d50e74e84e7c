// What fanbeam render tells when it is done.
#pragma once

#include "scenes/scene.h"
#include "session/sequence.h"

namespace fanbeam::apps {

// How many frames, and how many others were kept or removed; cast how and why, what accuracy or time
// was reached, which effects ran and why, and where products and record lie.
void print_render_summary(const session::Sequence& sequence, const scenes::Scene& scene,
                          double accuracy_grey);

}  // namespace fanbeam::apps
