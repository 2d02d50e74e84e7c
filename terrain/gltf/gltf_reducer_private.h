// The members of a glTF file's JSON text that geometry needs. Private: carries nlohmann-json's
// type.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/errors.h"

namespace fanbeam::terrain {

// Moves the wanted members out of `root`, each of its type and every index below the count of what
// it counts in. Errors into `problems`, all together: E-PARSE, E-RANGE, E-REF as
// read_gltf_document says.
nlohmann::json reduced_gltf(nlohmann::json& root, const std::string& file,
                            core::ProblemList& problems);

// As found in the file, short enough for a message.
std::string shown(const nlohmann::json& value);

}  // namespace fanbeam::terrain
