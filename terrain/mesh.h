// Triangles as data, before any ray-casting library sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/errors.h"

namespace fanbeam::terrain {

// Counter-clockwise seen from outside. `triangle_material[i]` is an index into `material_names`
// (one entry per triangle). A mesh of several parts (nodes of a model, buildings of a file) says
// which part each triangle belongs to; empty, all are part 0.
struct TriangleMesh {
  std::string name;
  std::vector<glm::dvec3> vertices_m;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangle_material;
  std::vector<std::string> material_names;
  std::vector<std::uint32_t> triangle_part{};
  std::vector<std::string> part_names{};  // empty where parts have none
};

// Largest coordinate a vertex may have: beyond it a float in the ray caster no longer resolves a
// metre.
inline constexpr double kLargestCoordinate_m = 1.0e6;

// Checks every vertex and index, then removes triangles without area and exact duplicates.
// Errors: E-NONFINITE, E-RANGE (a coordinate beyond kLargestCoordinate_m), E-REF (an index past the
// end), with mesh, element and value. Warnings: W-DEGENERATE with the count removed. `file` goes
// into the messages.
void check_and_clean(TriangleMesh& mesh, const std::string& file, core::ProblemList& problems);

// Where surfaces end: the edges, of triangles whose material is one of `materials` (parallel to
// material_names), that no triangle of the mesh has the other way round. A closed body has none. The mesh
// must be checked, of fewer than 2^31 vertices.
std::size_t count_borders(const TriangleMesh& mesh, const std::vector<bool>& materials);

}  // namespace fanbeam::terrain
