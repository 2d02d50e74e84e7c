#include "terrain/surface_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/errors.h"
#include "terrain/polygon.h"

namespace fanbeam::terrain {

SurfacePatch rectangle_patch(glm::dvec2 centre_m, glm::dvec2 along, double length_m, double width_m,
                             MaterialId material) {
  const glm::dvec2 l = along * (length_m / 2);
  const glm::dvec2 w = glm::dvec2(-along.y, along.x) * (width_m / 2);
  return {{centre_m - l - w, centre_m + l - w, centre_m + l + w, centre_m - l + w}, material};
}

namespace {

// Cells of one row, side by side.
struct CellSpan {
  std::size_t first = 0, count = 0;
};

// The cells that an outline may touch: in each row those from its westernmost place there to its
// easternmost. A long runway across the grid fills little of its bounding box.
std::vector<CellSpan> spans_under(const std::vector<glm::dvec2>& outline_m,
                                  const HeightField& field) {
  // More than what rounding may put a point into the cell beside.
  const double margin_m = 1e-6 * field.spacing_m;
  const auto index = [&](double value_m, double from_m, int posts) {
    return static_cast<int>(
        std::clamp(std::floor((value_m - from_m) / field.spacing_m), 0.0, posts - 2.0));
  };
  const auto row_of = [&](double y_m) { return index(y_m, field.south_m, field.rows); };
  const auto column_of = [&](double x_m) { return index(x_m, field.west_m, field.columns); };
  // A runway whose ends are one place has no direction.
  const auto is_finite = [](const glm::dvec2& p) { return std::isfinite(p.x + p.y); };
  if (outline_m.empty() || !std::all_of(outline_m.begin(), outline_m.end(), is_finite)) return {};
  const auto [lowest, highest] =
      std::minmax_element(outline_m.begin(), outline_m.end(),
                          [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
  const int first_row = row_of(lowest->y - margin_m), last_row = row_of(highest->y + margin_m);
  std::vector<glm::dvec2> ends_m(static_cast<std::size_t>(last_row - first_row) + 1,
                                 {1e300, -1e300});  // west, east
  for (std::size_t i = 0; i < outline_m.size(); ++i) {
    glm::dvec2 low = outline_m[i], high = outline_m[(i + 1) % outline_m.size()];
    if (low.y > high.y) std::swap(low, high);
    const double rise_m = high.y - low.y;
    for (int row = row_of(low.y - margin_m); row <= row_of(high.y + margin_m); ++row) {
      const double south_m = field.south_m + field.spacing_m * row - margin_m;
      const double north_m = south_m + field.spacing_m + 2.0 * margin_m;
      glm::dvec2& row_ends_m = ends_m[static_cast<std::size_t>(row - first_row)];
      for (const double share :
           {rise_m > 0.0 ? std::clamp((south_m - low.y) / rise_m, 0.0, 1.0) : 0.0,
            rise_m > 0.0 ? std::clamp((north_m - low.y) / rise_m, 0.0, 1.0) : 1.0}) {
        const double x_m = low.x + share * (high.x - low.x);
        row_ends_m = {std::min(row_ends_m.x, x_m - margin_m),
                      std::max(row_ends_m.y, x_m + margin_m)};
      }
    }
  }
  std::vector<CellSpan> spans;
  for (int row = first_row; row <= last_row; ++row) {
    const glm::dvec2& row_ends_m = ends_m[static_cast<std::size_t>(row - first_row)];
    const int first = column_of(row_ends_m.x), last = column_of(row_ends_m.y);
    spans.push_back({field.cell(first, row), static_cast<std::size_t>(last - first) + 1});
  }
  return spans;
}

}  // namespace

std::uint64_t cells_under(const SurfacePatch& patch, const HeightField& field) {
  std::uint64_t cells = 0;
  for (const CellSpan& span : spans_under(patch.outline_m, field)) cells += span.count;
  return cells;
}

SurfaceMap::SurfaceMap(const HeightField& field, std::vector<SurfacePatch> patches)
    : west_m_(field.west_m),
      south_m_(field.south_m),
      per_spacing_(1.0 / field.spacing_m),
      columns_(field.columns - 1),
      rows_(field.rows - 1),
      cells_(field.cell_material),
      patches_(std::move(patches)) {
  std::uint64_t entries = 0;
  for (const SurfacePatch& patch : patches_) {
    Box box{1e300, 1e300, -1e300, -1e300};
    for (const glm::dvec2& corner : patch.outline_m) {
      box.west_m = std::min(box.west_m, corner.x);
      box.east_m = std::max(box.east_m, corner.x);
      box.south_m = std::min(box.south_m, corner.y);
      box.north_m = std::max(box.north_m, corner.y);
    }
    boxes_.push_back(box);
    entries += cells_under(patch, field);
  }
  if (entries > kMostPatchedCells)
    core::throw_input_error(core::ErrorClass::limit, "cells under surfaces",
                            std::to_string(entries),
                            "at most " + std::to_string(kMostPatchedCells));
  list_patches(field, static_cast<std::size_t>(entries));
}

// A counting sort: each cell's entries are filled from their end on, so that the last patch is first.
void SurfaceMap::list_patches(const HeightField& field, std::size_t entries) {
  const auto for_cells = [&](const SurfacePatch& patch, const auto& use) {
    for (const CellSpan& span : spans_under(patch.outline_m, field))
      for (std::size_t cell = span.first; cell < span.first + span.count; ++cell) use(cell);
  };
  patch_begin_.assign(cells_.size() + 1, 0);
  patch_index_.resize(entries);
  for (const SurfacePatch& patch : patches_)
    for_cells(patch, [&](std::size_t cell) {
      ++patch_begin_[cell];
      cells_[cell] |= kPatched;
    });
  std::partial_sum(patch_begin_.begin(), patch_begin_.end(), patch_begin_.begin());
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for_cells(patches_[p], [&](std::size_t cell) {
      patch_index_[--patch_begin_[cell]] = static_cast<std::uint32_t>(p);
    });
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
