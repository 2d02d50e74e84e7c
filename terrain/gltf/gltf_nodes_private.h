// The node tree of a glTF file, flattened. Private: takes the parsed model.
//
// Source: Khronos Group, glTF 2.0 Specification, version 2.0.1 (2021), section 3.5: nodes form
// strict trees; a local transform is a matrix, or translation times rotation times scale.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "core/errors.h"
#include "terrain/gltf/gltf_model_private.h"

namespace fanbeam::terrain {

// One mesh as one node of the scene places it, glTF axes and metres.
struct GltfInstance {
  int mesh = -1;
  glm::dmat4 world;
  int node = -1;
};

// Errors: E-REF (a node that is its own child, has two parents, lies in a loop, or stands in a
// scene though it has a parent), E-NONFINITE (a transform beyond 32-bit float, which is what glTF
// numbers stand for), E-RANGE (a rotation of zero length, a matrix that is not affine).
void check_gltf_nodes(const GltfModel& model, core::ProblemList& problems);

// Meshes of the default scene: the one named by `scene`, else the first, else, in a file without
// scenes, every root node. Needs a checked tree. A node whose transform flattens everything to a
// line or a point is left out with W-DEGENERATE. E-NONFINITE when a product of transforms
// overflows.
std::vector<GltfInstance> gltf_instances(const GltfModel& model, core::ProblemList& problems);

}  // namespace fanbeam::terrain
