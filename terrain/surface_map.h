// Which material lies at a ground point: land cover per terrain cell, and flat patches (runway,
// markings, aprons) painted over it in order.
//
// Patches have no geometry of their own: they cannot fight with the terrain for depth, and the
// order in which they are added alone decides which is on top (the last one).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "terrain/height_field.h"

namespace fanbeam::terrain {

// A simple polygon in local east-north metres.
struct SurfacePatch {
  std::vector<glm::dvec2> outline_m;
  MaterialId material = 0;
  ObjectId object = kTerrainObject;
};

// An axis-free rectangle: `along` is a unit vector.
SurfacePatch rectangle_patch(glm::dvec2 centre_m, glm::dvec2 along, double length_m, double width_m,
                             MaterialId material);

// Of all patches together: 4 bytes for each.
inline constexpr std::uint64_t kMostPatchedCells = 100'000'000;

// Cells of the ground that remember a patch: those between its borders, row by row, whatever lies
// between them. Of a patch beyond the ground some at its edge.
std::uint64_t cells_under(const SurfacePatch& patch, const HeightField& field);

class SurfaceMap {
 public:
  // Copies the cells' materials, ids below 32768; patches later in the list lie on top. Throws
  // InputError E-LIMIT, before memory is taken, for patches over more than kMostPatchedCells cells.
  SurfaceMap(const HeightField& field, std::vector<SurfacePatch> patches);

  // Point is clamped to the grid.
  MaterialId material_at(double x_m, double y_m) const noexcept {
    return cover_at(x_m, y_m).material;
  }

  // Of the patch on top, else of the terrain. Point is clamped to the grid.
  struct Cover {
    MaterialId material;
    ObjectId object;
  };
  Cover cover_at(double x_m, double y_m) const noexcept {
    return cover_in_cell(column_of(x_m), row_of(y_m), x_m, y_m);
  }

  // The same for a point that is known to lie in this cell.
  Cover cover_in_cell(int column, int row, double x_m, double y_m) const noexcept {
    const std::size_t cell = cell_of(column, row);
    if ((cells_[cell] & kPatched) == 0) return {cells_[cell], kTerrainObject};
    return patched_cover(cell, x_m, y_m);
  }

  const std::vector<SurfacePatch>& patches() const { return patches_; }

 private:
  int column_of(double x_m) const noexcept {
    return std::clamp(static_cast<int>((x_m - west_m_) * per_spacing_), 0, columns_ - 1);
  }
  int row_of(double y_m) const noexcept {
    return std::clamp(static_cast<int>((y_m - south_m_) * per_spacing_), 0, rows_ - 1);
  }
  std::size_t cell_of(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  struct Box {
    double west_m, south_m, east_m, north_m;
  };
  void list_patches(const HeightField& field, std::size_t entries);
  bool inside(const SurfacePatch& patch, const Box& box, double x_m, double y_m) const noexcept;
  Cover patched_cover(std::size_t cell, double x_m, double y_m) const noexcept;

  double west_m_, south_m_, per_spacing_;
  int columns_, rows_;                            // cells
  static constexpr MaterialId kPatched = 0x8000;  // set in a cell that patches touch
  std::vector<MaterialId> cells_;
  std::vector<SurfacePatch> patches_;
  std::vector<Box> boxes_;
  // Per cell, the patches that touch it, topmost first: patch_index_[patch_begin_[cell] ..
  // patch_begin_[cell + 1]).
  std::vector<std::uint32_t> patch_begin_;
  std::vector<std::uint32_t> patch_index_;
};

}  // namespace fanbeam::terrain
