// The metadata that every file of the standard opens with.
#pragma once

#include "core/json_node.h"

namespace fanbeam::materials {

// Tables of reflection are long.
inline constexpr core::JsonLimits kJsonLimits{32, 4'000'000};

// Checks what the standard requires of all kinds of files: name, uuid, the file's own version under
// `version_key`, openMaterial3dVersion, copyrights, license, authors. E-REF (missing), E-PARSE
// (another type or form), E-UNSUPPORTED (a major version of the standard other than 1). Gives the
// name.
std::string check_metadata(const core::JsonNode& root, const char* version_key);

}  // namespace fanbeam::materials
