// From a material's name in a model to a material file: `.xoma` (asset) and `.xomm` (mapping) of
// ASAM OpenMATERIAL 3D 1.0 and 1.1.
//
// An asset names a mapping (materialMappingUri) and may replace names before they are looked up
// (materialReplacements of 1.1; an example of that edition spells it materialReplacement, which is
// taken too). The mapping's rows are [name, "file.xomp", description]. Passed over: assignment
// textures with their "rgb:R;G;B" keys (textures are not read; W-SKIPPED), lights, external assets
// and the rest of an asset's metadata.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/errors.h"
#include "materials/open_material/material_file.h"

namespace fanbeam::materials {

struct OpenMapping {
  std::filesystem::path file;                        // of the mapping: URIs are relative to it
  std::map<std::string, NamedUri> material_of_name;  // replacements applied
  std::vector<std::filesystem::path> files;          // what was read
};

// `file` ends in .xoma or .xomm (else E-UNSUPPORTED). Reports E-IO, E-LIMIT (1 MiB, 4096 rows),
// E-PARSE, E-REF (missing members, a replacement by an unknown key), E-PATH (a mapping outside
// `allowed_folder`), E-UNSUPPORTED with file and JSON pointer.
OpenMapping read_open_mapping(const std::filesystem::path& file,
                              const std::filesystem::path& allowed_folder,
                              core::ProblemList& problems);

}  // namespace fanbeam::materials
