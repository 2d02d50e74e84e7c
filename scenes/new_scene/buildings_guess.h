// Which property of a GeoJSON file is the buildings' height.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "scenes/new_scene/note.h"

namespace fanbeam::scenes {

struct BuildingsGuess {
  std::string height_property;  // empty for the reader's default
  // Nothing for the reader's default; empty where that is in the file and is no underside.
  std::optional<std::string> min_height_property;
};

// Of the properties whose names speak of a height, the one that most features have with a number of
// metres; and the one of the underside that its name goes with, "min_height" with "height", where it is a number
// of metres and leaves most buildings on the ground. Adds what terrain::read_footprints refuses in the file to
// `problems`; then nothing.
std::optional<BuildingsGuess> guess_buildings(const std::filesystem::path& file, Notes& notes,
                                              core::ProblemList& problems);

}  // namespace fanbeam::scenes
