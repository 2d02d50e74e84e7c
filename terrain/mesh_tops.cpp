#include "terrain/mesh_tops.h"

#include <algorithm>
#include <glm/common.hpp>

namespace fanbeam::terrain {
namespace {

const glm::dvec3 kBeside(MeshTops::kBeside_m, MeshTops::kBeside_m, 0.0);

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};

  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  double squares(double spacing_m) const {
    return ((high.x - low.x) / spacing_m + 1.0) * ((high.y - low.y) / spacing_m + 1.0);
  }
};

// `use` is called with the box of every triangle.
template <typename Use>
void for_triangles(const std::vector<const TriangleMesh*>& meshes, Use&& use) {
  for (const TriangleMesh* mesh : meshes)
    for (const glm::uvec3& triangle : mesh->triangles) {
      const glm::dvec3& a = mesh->vertices_m[triangle.x];
      const glm::dvec3& b = mesh->vertices_m[triangle.y];
      const glm::dvec3& c = mesh->vertices_m[triangle.z];
      use(Box{glm::min(a, glm::min(b, c)) - kBeside, glm::max(a, glm::max(b, c)) + kBeside});
    }
}

}  // namespace

MeshTops::MeshTops(const std::vector<const TriangleMesh*>& meshes) {
  Box all;
  for_triangles(meshes, [&](const Box& box) { all.add(box); });
  if (all.low.x > all.high.x) return;
  const auto covered = [&] {  // beyond the one that each lies in
    double sum = 0.0;
    for_triangles(meshes, [&](const Box& box) { sum += box.squares(spacing_m_) - 1.0; });
    return sum;
  };
  while (all.squares(spacing_m_) > kMostSquares || covered() > kMostCovered) spacing_m_ *= 2.0;
  per_spacing_ = 1.0 / spacing_m_;
  west_m_ = all.low.x;
  south_m_ = all.low.y;
  columns_ = square_of(all.high.x - west_m_) + 1;
  rows_ = square_of(all.high.y - south_m_) + 1;
  top_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                static_cast<float>(kNothing_m));
  for_triangles(meshes, [&](const Box& box) {
    const auto top_m = static_cast<float>(box.high.z);
    for (int j = square_of(box.low.y - south_m_); j <= square_of(box.high.y - south_m_); ++j)
      for (int i = square_of(box.low.x - west_m_); i <= square_of(box.high.x - west_m_); ++i) {
        float& top = top_m_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(i)];
        top = std::max(top, top_m);
      }
  });
}

}  // namespace fanbeam::terrain
