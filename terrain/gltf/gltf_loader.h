// Models from glTF 2.0 files (.gltf and .glb) as one triangle mesh.
//
// What is read: the default scene, all nodes flattened with their transforms; triangles, strips
// and fans with positions in 32-bit floats, or in integers of 8 or 16 bits where the file requires
// KHR_mesh_quantization, indexed by 8, 16 or 32 bits, sparse or not. Ignored:
// textures and images (never opened), normals, skins, animations, morph targets, cameras, lights,
// extensions that are not required and leave the data of what is drawn in the buffers. Where only an
// extension has them (Draco, meshopt), the model is E-UNSUPPORTED; an accessor that is all zero, or
// sparse, by the core specification is read as such. Points and lines are skipped with W-SKIPPED.
// Source: Khronos Group, glTF 2.0 Specification, version 2.0.1 (2021), and its extension
// KHR_mesh_quantization (2020).
// A triangle has one side, that from which its corners run counter-clockwise: its back echoes nothing
// and hides what is behind. A material's doubleSided is not modelled but told (W-ONE-SIDED) where it
// matters, with the number of edges at which such surfaces end; closed bodies have none.
//
// Frame: glTF's +Y is up and +Z forward, in metres. The mesh has x right, y forward, z up, so
// (x, y, z) = (-x_gltf, z_gltf, y_gltf). A transform that mirrors also turns the winding round, so
// outward normals stay outward. Accuracy: products and sums in double, positions as in the file.
#pragma once

#include <filesystem>

#include "core/errors.h"
#include "core/files.h"
#include "terrain/gltf/gltf_buffers.h"
#include "terrain/mesh.h"

namespace fanbeam::terrain {

// The mesh of `file`, named after it, checked and cleaned by check_and_clean. Materials carry
// glTF's names, "material_<index>" without one, "default" where a primitive has none; materials of
// the same name share a slot, and only those drawn have one. Its parts are the nodes that place a
// mesh, by their names, "node_<index>" without one.
//
// Buffers come only from inside `allowed_folder`, through `read_file`, which also reads `file`.
// Throws InputError with all problems of the stage that found some: bytes and JSON text (E-PARSE,
// E-LIMIT, E-UNSUPPORTED, E-REF), then buffers (E-PATH, E-IO, E-PARSE), accessors and node tree
// (E-REF, E-RANGE, E-NONFINITE), then the geometry itself (E-UNSUPPORTED and E-REF for data that are
// not there among others). Limits stand in gltf_limits.h. Warnings
// go to `problems`: W-DEGENERATE, W-BOUNDS, W-SKIPPED, W-ONE-SIDED, and W-EMPTY for a scene without
// triangles.
TriangleMesh load_gltf(const std::filesystem::path& file,
                       const std::filesystem::path& allowed_folder, core::ProblemList& problems,
                       const FileReader& read_file = core::read_file);

}  // namespace fanbeam::terrain
