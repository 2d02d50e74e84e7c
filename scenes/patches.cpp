#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>

#include "scenes/objects.h"
#include "terrain/buildings/clean_footprint.h"

namespace fanbeam::scenes {
namespace {

using renderer::ObjectKind;

// One ring around an outline and its holes: into each hole and back on the shortest way from a corner of
// what there is. The parity that tells inside from outside does not see the two ways, which lie on each
// other.
terrain::Ring_m with_holes(const terrain::Polygon_m& polygon_m) {
  terrain::Ring_m ring = polygon_m.front();
  for (std::size_t h = 1; h < polygon_m.size(); ++h) {
    const terrain::Ring_m& hole = polygon_m[h];
    std::size_t from = 0, to = 0;
    double shortest_m2 = 1e300;
    for (std::size_t i = 0; i < ring.size(); ++i)
      for (std::size_t k = 0; k < hole.size(); ++k) {
        const glm::dvec2 way = hole[k] - ring[i];
        if (glm::dot(way, way) < shortest_m2) {
          shortest_m2 = glm::dot(way, way);
          from = i;
          to = k;
        }
      }
    terrain::Ring_m joined(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(from) + 1);
    for (std::size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(to + k) % hole.size()]);
    joined.insert(joined.end(), ring.begin() + static_cast<std::ptrdiff_t>(from), ring.end());
    ring = std::move(joined);
  }
  return ring;
}

void add_pavement(const PavementDescription& pavement, const Ground& ground,
                  const MaterialNames& names, Objects& objects,
                  std::vector<terrain::SurfacePatch>& patches, core::ProblemList& problems) {
  std::size_t corners = 0;
  for (const std::vector<core::Geodetic>& ring : pavement.rings) corners += ring.size();
  if (corners > kMostPavementCorners)
    return problems.error(core::ErrorClass::limit, pavement.row, "pavement",
                          std::to_string(corners) + " corners",
                          "at most " + std::to_string(kMostPavementCorners) +
                              ", an eighth of a curve counted as one");
  std::vector<terrain::Ring_m> rings_m;
  for (const std::vector<core::Geodetic>& ring : pavement.rings) {
    rings_m.emplace_back();
    for (const core::Geodetic& corner : ring)
      rings_m.back().push_back(ground.local_m(corner.latitude_rad, corner.longitude_rad));
  }
  const auto is_far = [](const glm::dvec2& p) {
    return std::max(std::abs(p.x), std::abs(p.y)) > terrain::kLargestCoordinate_m;
  };
  for (const terrain::Ring_m& ring_m : rings_m)
    if (std::any_of(ring_m.begin(), ring_m.end(), is_far))
      return problems.warning("SKIPPED", pavement.row, "pavement",
                              "a corner more than 1000 km from the scene's origin", "left out");
  const terrain::Ring_m outer_m = rings_m.front();
  rings_m.erase(rings_m.begin());
  const terrain::MaterialId material = names.id(pavement.material, pavement.place, "airport");
  for (const terrain::Polygon_m& polygon_m : terrain::clean_footprint(outer_m, rings_m)) {
    patches.push_back({with_holes(polygon_m), material});
    patches.back().object =
        objects.add("pavement " + std::to_string(patches.size()), ObjectKind::surface);
  }
}

// Counts the cells of the ground that the patches lie on.
class CellBudget {
 public:
  CellBudget(const Ground& ground, core::ProblemList& problems, std::uint64_t most)
      : field_(ground.field()), problems_(problems), most_(most) {}

  // False, and told, where the patches added since the last call are more than there is room for.
  bool holds(const std::vector<terrain::SurfacePatch>& patches, const core::Place& place,
             const char* field) {
    for (; counted_ < patches.size(); ++counted_)
      cells_ += terrain::cells_under(patches[counted_], field_);
    if (cells_ <= most_) return true;
    problems_.error(core::ErrorClass::limit, place, field,
                    std::to_string(cells_) + " cells of the terrain under surfaces",
                    "at most " + std::to_string(most_) +
                        ", each counted for every surface on it: a wider terrain.spacing_m");
    return false;
  }

 private:
  const terrain::HeightField& field_;
  core::ProblemList& problems_;
  std::uint64_t most_, cells_ = 0;
  std::size_t counted_ = 0;
};

}  // namespace

std::vector<terrain::SurfacePatch> build_patches(const SceneDescription& scene,
                                                 const Ground& ground, const MaterialNames& names,
                                                 Objects& objects, core::ProblemList& problems,
                                                 std::uint64_t most_cells) {
  std::vector<terrain::SurfacePatch> patches;
  CellBudget budget(ground, problems, most_cells);
  for (const PavementDescription& pavement : scene.pavements) {
    add_pavement(pavement, ground, names, objects, patches, problems);
    if (!budget.holds(patches, pavement.place, "airport")) return patches;
  }
  for (const SurfaceDescription& surface : scene.surfaces) {
    const auto end = ground.landing_end(surface.runway_end);
    if (!end) continue;
    const glm::dvec2 left(-end->direction.y, end->direction.x);
    const glm::dvec2 centre = end->threshold_m +
                              end->direction * ((surface.from_behind_m + surface.to_behind_m) / 2) +
                              left * ((surface.from_left_m + surface.to_left_m) / 2);
    patches.push_back(terrain::rectangle_patch(
        centre, end->direction, surface.to_behind_m - surface.from_behind_m,
        surface.to_left_m - surface.from_left_m,
        names.id(surface.material, surface.place, "surface.material")));
    patches.back().object = objects.add(
        "surface " + std::to_string(&surface - scene.surfaces.data() + 1), ObjectKind::surface);
    if (!budget.holds(patches, surface.place, "surface")) return patches;
  }
  for (std::size_t i = 0; i < ground.runways().size(); ++i) {
    const RunwayDescription& described = scene.runways[i];
    const std::string name = "runway " + described.ends[0].name + "/" + described.ends[1].name;
    const terrain::ObjectId pavement = objects.add(name, ObjectKind::runway);
    const terrain::ObjectId markings = objects.add(name + " markings", ObjectKind::marking);
    for (terrain::SurfacePatch& patch :
         terrain::runway_patches(ground.runways()[i], pavement, markings))
      patches.push_back(std::move(patch));
    if (!budget.holds(patches, described.place, "runway")) return patches;
  }
  return patches;
}

}  // namespace fanbeam::scenes
