// Problems of a file that a scene names, told at the line of the scene that names it.
#pragma once

#include <string>

#include "core/errors.h"

namespace fanbeam::scenes {

// Appends what `error` holds. A problem that has a line or a byte of its own keeps its place; any
// other one moves to `place`, the file's name going into the value:
//   scene.toml:12:1: E-REF terrain.elevation = dem.tif, georeference: no geotransform: expected ...
void append_placed(core::ProblemList& problems, const core::InputError& error,
                   const core::Place& place, const std::string& field);

}  // namespace fanbeam::scenes
