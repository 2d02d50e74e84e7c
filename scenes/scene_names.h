// Names in a scene that stand for materials and runways: neither ground nor geometry is needed to see that one
// does not exist.
#pragma once

#include "core/errors.h"
#include "scenes/description.h"
#include "scenes/ground.h"

namespace fanbeam::scenes {

// E-REF for every name of a material that the library lacks, written or a default that is always looked up, and for
// every runway end that the scene lacks: at its key, "box[2].wall". `read_well`: the reader found no error; else
// nothing is said of a name that could not be read, nor of a runway that may be one of those that could not.
void check_names(const SceneDescription& scene, const MaterialNames& materials, bool read_well,
                 core::ProblemList& problems);

}  // namespace fanbeam::scenes
