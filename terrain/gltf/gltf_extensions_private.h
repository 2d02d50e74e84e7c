// Which parts of a glTF file leave their data to an extension. Private: carries nlohmann-json's
// type.
//
// Sources: Khronos Group, KHR_draco_mesh_compression (2018): a primitive whose compressed attributes
// and indices have accessors without a buffer view. EXT_meshopt_compression (2022): a buffer view
// whose buffer need not have data. An accessor without a buffer view that no extension stands
// behind is zeros, or sparse: glTF 2.0 Specification, section 3.6.2.3.
#pragma once

#include <nlohmann/json.hpp>

#include "terrain/gltf/gltf_document.h"

namespace fanbeam::terrain {

// Takes the members "extensions" out of what reduced_gltf kept, and returns by path what of it may
// have its data in one.
GltfExtensionOfPath taken_extensions(nlohmann::json& kept);

}  // namespace fanbeam::terrain
