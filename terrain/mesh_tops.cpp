#include "terrain/mesh_tops.h"

#include <algorithm>
#include <glm/common.hpp>

namespace fanbeam::terrain {

MeshTops::MeshTops(const std::vector<const TriangleMesh*>& meshes) {
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (const TriangleMesh* mesh : meshes) {
    for (const glm::dvec3& position : mesh->vertices_m) {
      low = glm::min(low, position);
      high = glm::max(high, position);
    }
  }
  if (low.x > high.x) return;
  low -= kBeside_m;
  high += kBeside_m;
  west_m_ = low.x;
  south_m_ = low.y;
  columns_ = static_cast<int>((high.x - low.x) / kSpacing_m) + 1;
  rows_ = static_cast<int>((high.y - low.y) / kSpacing_m) + 1;
  top_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                static_cast<float>(kNothing_m));
  for (const TriangleMesh* mesh : meshes) {
    for (const glm::uvec3& triangle : mesh->triangles) {
      const glm::dvec3& a = mesh->vertices_m[triangle.x];
      const glm::dvec3& b = mesh->vertices_m[triangle.y];
      const glm::dvec3& c = mesh->vertices_m[triangle.z];
      const double top_m = std::max({a.z, b.z, c.z});
      const glm::dvec3 from = glm::min(a, glm::min(b, c)) - kBeside_m;
      const glm::dvec3 to = glm::max(a, glm::max(b, c)) + kBeside_m;
      for (int j = static_cast<int>((from.y - low.y) / kSpacing_m);
           j <= static_cast<int>((to.y - low.y) / kSpacing_m); ++j)
        for (int i = static_cast<int>((from.x - low.x) / kSpacing_m);
             i <= static_cast<int>((to.x - low.x) / kSpacing_m); ++i) {
          float& top = top_m_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(i)];
          top = std::max(top, static_cast<float>(top_m));
        }
    }
  }
}

}  // namespace fanbeam::terrain
