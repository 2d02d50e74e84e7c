// Turns the described objects into patches, bodies and point targets on the scene's ground.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/ground.h"
#include "scenes/model_materials.h"
#include "terrain/ray_scene.h"
#include "terrain/surface_map.h"

namespace fanbeam::scenes {

// What a scene is made of, by terrain::ObjectId: the terrain first.
struct Objects {
  std::vector<std::string> names{};
  std::vector<renderer::ObjectKind> kinds{};
  std::vector<renderer::ModelObjects> models{};

  // The id of another one.
  terrain::ObjectId add(const std::string& name, renderer::ObjectKind kind);
};

// Of a pavement of [[airport]] with its holes, curves cut into eighths. Its holes are joined to it in a time with
// the square of this: a second.
inline constexpr std::size_t kMostPavementCorners = 50'000;

// The pavements of [[airport]], the rectangles of [[surface]] on them, the runways on top, each in file
// order. Adds "pavement 1", "surface 1" and so on, "runway 36/18" and "runway 36/18 markings" to `objects`.
// E-LIMIT for a pavement of more corners, W-SKIPPED for one that reaches beyond 1000 km, both at their row of
// the airport's file; E-LIMIT for the one after which they lie on more than `most_cells` of the ground
// (terrain::cells_under); what would follow is left out.
std::vector<terrain::SurfacePatch> build_patches(
    const SceneDescription& scene, const Ground& ground, const MaterialNames& names,
    Objects& objects, core::ProblemList& problems,
    std::uint64_t most_cells = terrain::kMostPatchedCells);

// Boxes, building files and models, in this order: as triangles for rays, and as what a vertical
// cut can make of them.
struct Bodies {
  std::vector<terrain::PlacedMesh> meshes;
  terrain::Solids solids;
  // Building parts that do not reach the ground, and those of them over open air
  // (terrain/buildings/solid_prisms.h).
  std::size_t raised = 0, floating = 0;
  // Those before, and "hangar" of a box, "buildings.geojson 17" of a footprint, "truck: cabin" of a
  // model's node.
  Objects objects{};
  std::vector<std::filesystem::path> files{};  // read for them, a model's buffers too
};

// Walls go this far into the ground, so that no gap shows on a slope between two posts.
inline constexpr double kFoundation_m = 2.0;

// Of boxes, buildings and models together; the file that exceeds it is the last one read.
inline constexpr std::size_t kMostBodyTriangles = 20'000'000;
// Of lines, runway lights, fences and targets together.
inline constexpr std::size_t kMostPointTargets = 1'000'000;

// E-LIMIT beyond `most_triangles` and for files beyond file_budget.h.
Bodies build_bodies(const SceneDescription& scene, const Ground& ground, const MaterialNames& names,
                    ModelMaterials& model_materials, Objects objects, core::ProblemList& problems,
                    std::size_t most_triangles = kMostBodyTriangles);

// The points of one line, of one target, or of the lights or the fence of one runway.
struct PointGroup {
  std::string name;
  core::Place place;
  bool is_line = false;
  std::size_t begin = 0, end = 0;  // among all points of the scene
};

struct PointTargets {
  std::vector<renderer::PointTarget> points;
  std::vector<PointGroup> groups;  // side by side, without gaps; none is empty
};

// Runways, lines and targets, each in file order. E-LIMIT for a line of more than 100000 points and
// beyond `most_points`: then the last object is the one that exceeds it. W-NEAR-FIELD, see
// near_field.h, and W-DUPLICATE, see duplicate_targets.h.
PointTargets build_targets(const SceneDescription& scene, const Ground& ground,
                           core::ProblemList& problems,
                           std::size_t most_points = kMostPointTargets);

}  // namespace fanbeam::scenes
