#include "terrain/buildings/solid_prisms.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {
namespace {

struct TreeDeleter {
  GEOSContextHandle_t context = nullptr;
  void operator()(GEOSSTRtree* tree) const { GEOSSTRtree_destroy_r(context, tree); }
};

// Which polygons are solid down to the ground.
class SupportSearch {
 public:
  SupportSearch(const std::vector<Prism>& prisms, const std::vector<ExtrudedPolygon>& polygons)
      : prisms_(prisms), polygons_(polygons) {}

  // By polygon; once.
  std::vector<bool> run();

 private:
  const Prism& prism(std::size_t polygon) const { return prisms_[polygons_[polygon].prism]; }
  void index_footprints();
  // Polygons whose boxes touch the footprint, in their order.
  std::vector<std::size_t> neighbours(const GEOSGeometry* footprint) const;
  bool is_supported(std::size_t raised) const;

  const std::vector<Prism>& prisms_;
  const std::vector<ExtrudedPolygon>& polygons_;
  Geos geos_;
  std::vector<Geos::Geometry> footprints_;
  std::vector<std::size_t> indices_;  // what the tree's items point to
  std::unique_ptr<GEOSSTRtree, TreeDeleter> tree_;
  std::vector<bool> solid_;
};

// From the lowest underside up, so that storeys can stand on storeys.
std::vector<bool> SupportSearch::run() {
  std::vector<std::size_t> raised;
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    solid_.push_back(prism(i).on_ground);
    if (!solid_[i]) raised.push_back(i);
  }
  if (raised.empty()) return solid_;
  index_footprints();
  std::stable_sort(raised.begin(), raised.end(), [this](std::size_t a, std::size_t b) {
    return prism(a).bottom_m < prism(b).bottom_m;
  });
  for (const std::size_t i : raised) solid_[i] = is_supported(i);
  return solid_;
}

void SupportSearch::index_footprints() {
  constexpr std::size_t kNodeCapacity = 10;  // as GEOS advises
  tree_ = {GEOSSTRtree_create_r(geos_.context(), kNodeCapacity), TreeDeleter{geos_.context()}};
  indices_.resize(polygons_.size());
  std::iota(indices_.begin(), indices_.end(), std::size_t{0});
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    footprints_.push_back(geos_.polygon(polygons_[i].rings_m));
    GEOSSTRtree_insert_r(geos_.context(), tree_.get(), footprints_[i].get(), &indices_[i]);
  }
}

std::vector<std::size_t> SupportSearch::neighbours(const GEOSGeometry* footprint) const {
  std::vector<std::size_t> found;
  const auto collect = [](void* item, void* list) {
    static_cast<std::vector<std::size_t>*>(list)->push_back(*static_cast<std::size_t*>(item));
  };
  GEOSSTRtree_query_r(geos_.context(), tree_.get(), footprint, collect, &found);
  std::sort(found.begin(), found.end());
  return found;
}

// Takes supports away from the footprint until too little is left to look under.
bool SupportSearch::is_supported(std::size_t raised) const {
  GEOSContextHandle_t context = geos_.context();
  const GEOSGeometry* footprint = footprints_[raised].get();
  double area_m2 = 0.0;
  GEOSArea_r(context, footprint, &area_m2);
  Geos::Geometry open = geos_.own(GEOSGeom_clone_r(context, footprint));
  for (const std::size_t i : neighbours(footprint)) {
    if (!solid_[i] || prism(i).top_m < prism(raised).bottom_m - kGap_m) continue;
    open = geos_.own(GEOSDifference_r(context, open.get(), footprints_[i].get()));
    double open_m2 = 0.0;
    if (!open || GEOSArea_r(context, open.get(), &open_m2) != 1) return false;
    if (open_m2 <= (1.0 - kSupported) * area_m2) return true;
  }
  return false;
}

Box_m box_around(const Ring_m& outline, const Prism& prism) {
  Box_m box{{outline.front(), prism.bottom_m}, {outline.front(), prism.top_m}};
  for (const glm::dvec2& point : outline) {
    box.low = glm::min(box.low, glm::dvec3(point, prism.bottom_m));
    box.high = glm::max(box.high, glm::dvec3(point, prism.top_m));
  }
  return box;
}

}  // namespace

std::size_t add_solids(const std::vector<Prism>& prisms, const Extrusion& extrusion,
                       MaterialId wall, MaterialId roof, const std::vector<ObjectId>& object,
                       Solids& solids) {
  const std::vector<bool> solid = SupportSearch(prisms, extrusion.polygons).run();
  std::size_t floating = 0;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const ExtrudedPolygon& polygon = extrusion.polygons[i];
    const Prism& prism = prisms[polygon.prism];
    if (solid[i]) {
      solids.prisms.push_back({polygon.rings_m, prism.top_m, wall, roof,
                               object.empty() ? kTerrainObject : object.at(polygon.prism)});
    } else {
      solids.others.push_back(box_around(polygon.rings_m.front(), prism));
      ++floating;
    }
  }
  return floating;
}

Box_m box_around(const TriangleMesh& mesh) {
  Box_m box{mesh.vertices_m.front(), mesh.vertices_m.front()};
  for (const glm::dvec3& vertex : mesh.vertices_m) {
    box.low = glm::min(box.low, vertex);
    box.high = glm::max(box.high, vertex);
  }
  return box;
}

void add_boxes(const TriangleMesh& mesh, Solids& solids) {
  std::vector<Box_m> boxes(mesh.part_names.size(), {glm::dvec3(1e300), glm::dvec3(-1e300)});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3& vertex = mesh.vertices_m[mesh.triangles[i][corner]];
      Box_m& box = boxes[mesh.triangle_part[i]];
      box.low = glm::min(box.low, vertex);
      box.high = glm::max(box.high, vertex);
    }
  for (const Box_m& box : boxes)
    if (box.low.x <= box.high.x) solids.others.push_back(box);
}

}  // namespace fanbeam::terrain
