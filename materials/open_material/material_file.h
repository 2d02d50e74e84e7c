// A material of ASAM OpenMATERIAL 3D 1.0 and 1.1 (`.xomp`): what a radar can make of it.
//
// Read: metadata, surfaceRoughness.surfaceHeightRms, electromagneticPropertiesUri, brdfUris,
// reflectionCoefficientUris, customProperties.fanbeam. Passed over: emissivity, elasticity, density,
// retroreflectivity, optical properties and what others put into customProperties.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "materials/open_material/custom_nrcs.h"

namespace fanbeam::materials {

// A file that is named by another, and where it is named.
struct NamedUri {
  std::string uri;
  std::string pointer;
};

struct OpenMaterialFile {
  std::string name;
  std::optional<double> rms_height_m;
  std::optional<NamedUri> permittivity;
  std::vector<NamedUri> brdfs;
  std::vector<NamedUri> reflection_coefficients;
  std::vector<CustomNrcs> nrcs;
};

// Reports E-IO, E-LIMIT (1 MiB, 32 levels, 64 tables), E-PARSE, E-REF, E-RANGE, E-NONFINITE and
// E-UNSUPPORTED with file and JSON pointer. Nothing when the file cannot be read at all.
std::optional<OpenMaterialFile> read_open_material_file(const std::filesystem::path& file,
                                                        core::ProblemList& problems);

}  // namespace fanbeam::materials
