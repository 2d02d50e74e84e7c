#include "terrain/surface_map.h"

#include <algorithm>
#include <cmath>

#include "terrain/polygon.h"

namespace fanbeam::terrain {

SurfacePatch rectangle_patch(glm::dvec2 centre_m, glm::dvec2 along, double length_m, double width_m,
                             MaterialId material) {
  const glm::dvec2 l = along * (length_m / 2);
  const glm::dvec2 w = glm::dvec2(-along.y, along.x) * (width_m / 2);
  return {{centre_m - l - w, centre_m + l - w, centre_m + l + w, centre_m - l + w}, material};
}

namespace {

// False when the whole cell lies outside one side of a convex outline. A long runway across the
// grid fills little of its bounding box.
bool may_touch(const std::vector<glm::dvec2>& outline_m, const HeightField& field, int column,
               int row) {
  const auto left_of = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    return (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
  };
  const glm::dvec2 low(field.west_m + field.spacing_m * column,
                       field.south_m + field.spacing_m * row);
  const glm::dvec2 corners[] = {low, low + glm::dvec2(field.spacing_m, 0.0),
                                low + glm::dvec2(0.0, field.spacing_m),
                                low + glm::dvec2(field.spacing_m)};
  const std::size_t count = outline_m.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2& a = outline_m[i];
    const glm::dvec2& b = outline_m[(i + 1) % count];
    const auto on_right = [&](const glm::dvec2& point) { return left_of(a, b, point) < 0.0; };
    const auto on_left = [&](const glm::dvec2& point) { return left_of(a, b, point) > 0.0; };
    const bool outline_left = std::none_of(outline_m.begin(), outline_m.end(), on_right);
    const bool outline_right = std::none_of(outline_m.begin(), outline_m.end(), on_left);
    if (outline_left && std::all_of(std::begin(corners), std::end(corners), on_right)) return false;
    if (outline_right && std::all_of(std::begin(corners), std::end(corners), on_left)) return false;
  }
  return true;
}

}  // namespace

SurfaceMap::SurfaceMap(const HeightField& field, std::vector<SurfacePatch> patches)
    : west_m_(field.west_m),
      south_m_(field.south_m),
      per_spacing_(1.0 / field.spacing_m),
      columns_(field.columns - 1),
      rows_(field.rows - 1),
      cells_(field.cell_material),
      patches_(std::move(patches)) {
  std::vector<std::vector<std::uint32_t>> touching(cells_.size());
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    Box box{1e300, 1e300, -1e300, -1e300};
    for (const glm::dvec2& corner : patches_[p].outline_m) {
      box.west_m = std::min(box.west_m, corner.x);
      box.east_m = std::max(box.east_m, corner.x);
      box.south_m = std::min(box.south_m, corner.y);
      box.north_m = std::max(box.north_m, corner.y);
    }
    boxes_.push_back(box);
    const auto index = [&](double value, double from, int count) {
      return std::clamp(static_cast<int>(std::floor((value - from) * per_spacing_)), 0, count - 1);
    };
    for (int j = index(box.south_m, south_m_, rows_); j <= index(box.north_m, south_m_, rows_); ++j)
      for (int i = index(box.west_m, west_m_, columns_); i <= index(box.east_m, west_m_, columns_);
           ++i)
        if (may_touch(patches_[p].outline_m, field, i, j))
          touching[field.cell(i, j)].push_back(static_cast<std::uint32_t>(p));
  }
  patch_begin_.push_back(0);
  for (std::size_t cell = 0; cell < touching.size(); ++cell) {
    const auto& list = touching[cell];
    if (!list.empty()) cells_[cell] |= kPatched;
    patch_index_.insert(patch_index_.end(), list.rbegin(), list.rend());
    patch_begin_.push_back(static_cast<std::uint32_t>(patch_index_.size()));
  }
}

bool SurfaceMap::inside(const SurfacePatch& patch, const Box& box, double x_m,
                        double y_m) const noexcept {
  if (x_m < box.west_m || x_m > box.east_m || y_m < box.south_m || y_m > box.north_m) return false;
  return crosses_odd(patch.outline_m, x_m, y_m);
}

SurfaceMap::Cover SurfaceMap::patched_cover(std::size_t cell, double x_m,
                                            double y_m) const noexcept {
  for (std::uint32_t k = patch_begin_[cell]; k < patch_begin_[cell + 1]; ++k) {
    const std::uint32_t p = patch_index_[k];
    const SurfacePatch& patch = patches_[p];
    if (inside(patch, boxes_[p], x_m, y_m)) return {patch.material, patch.object};
  }
  return {static_cast<MaterialId>(cells_[cell] & ~kPatched), kTerrainObject};
}

}  // namespace fanbeam::terrain
