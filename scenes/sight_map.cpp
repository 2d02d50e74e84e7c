#include "scenes/sight_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/relief.h"
#include "scenes/sight_fan.h"

namespace fanbeam::scenes {
namespace {

using terrain::HeightField;

constexpr double kTile_m = 128.0;
constexpr double kMargin_m = 1.0;
// An echo is spread over half the way to its neighbours at most, from a little beyond the gate too.
constexpr double kMarginCells = 8.0;

// Steepest of the two triangles of a cell, squared, times the spacing squared.
double steepest_square(const HeightField& ground, int i, int j) {
  const double sw = ground.height_m[ground.post(i, j)];
  const double se = ground.height_m[ground.post(i + 1, j)];
  const double nw = ground.height_m[ground.post(i, j + 1)];
  const double ne = ground.height_m[ground.post(i + 1, j + 1)];
  const auto square = [](double a, double b) { return a * a + b * b; };
  return std::max(square(se - sw, ne - se), square(ne - nw, nw - sw));
}

double farthest_m(const sensors::Sensor& sensor) {
  return sensor.range.maximum_m() + kMarginCells * sensor.range.cell_m + kMargin_m;
}

}  // namespace

class SightMap::Tiles {
 public:
  Tiles(const HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
        const std::vector<terrain::PlacedMesh>& meshes)
      : west_m(ground.west_m),
        south_m(ground.south_m),
        east_m(ground.east_m()),
        north_m(ground.north_m()),
        relief(ground),
        posts_per_tile_(std::max(1, static_cast<int>(kTile_m / ground.spacing_m))),
        tile_m_(posts_per_tile_ * ground.spacing_m),
        columns_((ground.columns - 2) / posts_per_tile_ + 1),
        rows_((ground.rows - 2) / posts_per_tile_ + 1) {
    all_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    add_ground(ground);
    for (const terrain::SurfacePatch& patch : patches) add_patch(patch);
    for (const terrain::PlacedMesh& mesh : meshes) add_mesh(mesh);
  }

  std::uint64_t bits_of(const std::vector<bool>& mirrors) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < met_.size(); ++i)
      if (met_[i] < mirrors.size() && mirrors[met_[i]])
        bits |= std::uint64_t{1} << std::min(i, kMostBits - 1);
    return bits;
  }

  double west_m, south_m, east_m, north_m;
  Relief relief;
  double tile_m() const { return tile_m_; }
  const Tile& at(int column, int row) const { return all_[place(column, row)]; }
  // Every tile that holds anything within the box, by east and north, and few others: use(column, row).
  template <class Use>
  void for_tiles(const glm::dvec3& low_m, const glm::dvec3& high_m, const Use& use) const;

 private:
  static constexpr std::size_t kMostBits = 64;

  std::uint64_t bit_of(terrain::MaterialId material) {
    // Neighbours are mostly of one material.
    if (last_bit_ != 0 && material == last_) return last_bit_;
    const auto found = std::find(met_.begin(), met_.end(), material);
    const auto index = static_cast<std::size_t>(found - met_.begin());
    if (found == met_.end()) met_.push_back(material);
    last_ = material;
    last_bit_ = std::uint64_t{1} << std::min(index, kMostBits - 1);
    return last_bit_;
  }
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Tile& at(int column, int row) { return all_[place(column, row)]; }
  void add_ground(const HeightField& ground);
  void add_patch(const terrain::SurfacePatch& patch);
  void add_mesh(const terrain::PlacedMesh& placed);

  int posts_per_tile_;
  double tile_m_;
  int columns_, rows_;
  std::vector<Tile> all_;                 // [row][column]
  std::vector<terrain::MaterialId> met_;  // in the order of their bits
  terrain::MaterialId last_ = 0;
  std::uint64_t last_bit_ = 0;
};

SightMap::SightMap(const HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
                   const std::vector<terrain::PlacedMesh>& meshes)
    : tiles_(std::make_shared<const Tiles>(ground, patches, meshes)) {}

SightMap SightMap::with_mirrors(const std::vector<bool>& mirrors) const {
  SightMap map = *this;
  map.mirrors_ = tiles_->bits_of(mirrors);
  return map;
}

template <class Use>
void SightMap::Tiles::for_tiles(const glm::dvec3& low_m, const glm::dvec3& high_m,
                                const Use& use) const {
  // What stands off the terrain belongs to the tile at its edge.
  const auto index = [this](double value_m, double start_m, int count) {
    return static_cast<int>(
        std::clamp(std::floor((value_m - start_m) / tile_m_), 0.0, static_cast<double>(count - 1)));
  };
  const int west = index(low_m.x - kMargin_m, west_m, columns_);
  const int east = index(high_m.x + kMargin_m, west_m, columns_);
  const int north = index(high_m.y + kMargin_m, south_m, rows_);
  for (int row = index(low_m.y - kMargin_m, south_m, rows_); row <= north; ++row)
    for (int column = west; column <= east; ++column) use(column, row);
}

void SightMap::Tiles::add_ground(const HeightField& ground) {
  for (int j = 0; j + 1 < ground.rows; ++j)
    for (int i = 0; i + 1 < ground.columns; ++i) {
      Tile& tile = at(i / posts_per_tile_, j / posts_per_tile_);
      tile.of_ground |= bit_of(ground.cell_material[ground.cell(i, j)]);
      tile.steepest = std::max(tile.steepest, steepest_square(ground, i, j));
      for (const std::size_t post : {ground.post(i, j), ground.post(i + 1, j),
                                     ground.post(i, j + 1), ground.post(i + 1, j + 1)}) {
        tile.lowest_ground_m = std::min(tile.lowest_ground_m, ground.height_m[post]);
        tile.highest_ground_m = std::max(tile.highest_ground_m, ground.height_m[post]);
      }
    }
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      Tile& tile = at(column, row);
      tile.steepest = std::sqrt(tile.steepest) / ground.spacing_m;
      tile.low_m = {west_m + column * tile_m_, south_m + row * tile_m_, tile.lowest_ground_m};
      tile.high_m = {west_m + (column + 1) * tile_m_, south_m + (row + 1) * tile_m_,
                     tile.highest_ground_m};
    }
}

void SightMap::Tiles::add_patch(const terrain::SurfacePatch& patch) {
  glm::dvec3 low_m(1e300), high_m(-1e300);
  for (const glm::dvec2& corner : patch.outline_m) {
    low_m = glm::min(low_m, glm::dvec3(corner, 0.0));
    high_m = glm::max(high_m, glm::dvec3(corner, 0.0));
  }
  const std::uint64_t bit = bit_of(patch.material);
  if (low_m.x <= high_m.x)
    for_tiles(low_m, high_m, [&](int column, int row) { at(column, row).of_ground |= bit; });
}

void SightMap::Tiles::add_mesh(const terrain::PlacedMesh& placed) {
  const terrain::TriangleMesh& mesh = placed.mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& corner = mesh.triangles[i];
    const glm::dvec3& a = mesh.vertices_m[corner.x];
    const glm::dvec3& b = mesh.vertices_m[corner.y];
    const glm::dvec3& c = mesh.vertices_m[corner.z];
    const std::uint64_t bit = bit_of(placed.material_of_name[mesh.triangle_material[i]]);
    const glm::dvec3 low_m = glm::min(a, glm::min(b, c));
    const glm::dvec3 high_m = glm::max(a, glm::max(b, c));
    for_tiles(low_m, high_m, [&](int column, int row) {
      Tile& tile = at(column, row);
      tile.has_bodies = true;
      tile.of_bodies |= bit;
      tile.low_m.z = std::min(tile.low_m.z, low_m.z);
      tile.high_m.z = std::max(tile.high_m.z, high_m.z);
      // Off the terrain.
      if (column == 0) tile.low_m.x = std::min(tile.low_m.x, low_m.x);
      if (row == 0) tile.low_m.y = std::min(tile.low_m.y, low_m.y);
      if (column == columns_ - 1) tile.high_m.x = std::max(tile.high_m.x, high_m.x);
      if (row == rows_ - 1) tile.high_m.y = std::max(tile.high_m.y, high_m.y);
    });
  }
}

bool SightMap::fan_may_meet(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                            const glm::dvec2& centre_m, double radius_m) const {
  return SightFan(antenna, sensor).may_meet_column(centre_m, radius_m, farthest_m(sensor));
}

bool SightMap::ends_within_range(const sensors::AntennaFrame& antenna,
                                 const sensors::Sensor& sensor) const {
  const glm::dvec2 at_m(antenna.position_m);
  const glm::dvec2 low_m(tiles_->west_m, tiles_->south_m);
  const glm::dvec2 high_m(tiles_->east_m, tiles_->north_m);
  if (glm::clamp(at_m, low_m, high_m) != at_m) return true;
  const double far_m = farthest_m(sensor);
  const SightFan fan(antenna, sensor);
  // Pieces of what of a side is within range.
  constexpr int kPieces = 64;
  const double piece_m = 2.0 * far_m / kPieces;
  const auto meets = [&](int axis, double side_m) {
    if (std::abs(side_m - at_m[axis]) > far_m) return false;
    for (int piece = 0; piece < kPieces; ++piece) {
      glm::dvec2 middle_m;
      middle_m[axis] = side_m;
      middle_m[1 - axis] = at_m[1 - axis] - far_m + (piece + 0.5) * piece_m;
      if (fan.may_meet_column(middle_m, piece_m / 2.0, far_m)) return true;
    }
    return false;
  };
  return meets(0, low_m.x) || meets(0, high_m.x) || meets(1, low_m.y) || meets(1, high_m.y);
}

bool SightMap::may_meet(const SightFan& directions, const Tile& tile) {
  return directions.may_meet((tile.low_m + tile.high_m) / 2.0,
                             glm::length(tile.high_m - tile.low_m) / 2.0 + kMargin_m);
}

bool SightMap::ground_may_meet_itself(const glm::dvec3& antenna_m, double far_m,
                                      const SightFan& fan) const {
  const auto may_mirror = [&](const glm::dvec3& low_m, const glm::dvec3& high_m) {
    if (!fan.may_meet((low_m + high_m) / 2.0, glm::length(high_m - low_m) / 2.0 + kMargin_m))
      return false;
    if (high_m.x - low_m.x > 1.5 * tiles_->tile_m()) return true;
    bool mirrors = false;
    tiles_->for_tiles(low_m, high_m, [&](int column, int row) {
      mirrors = mirrors || (tiles_->at(column, row).of_ground & mirrors_) != 0;
    });
    return mirrors;
  };
  return tiles_->relief.may_mirror_into_itself(antenna_m, far_m, may_mirror);
}

SightMap::Seen SightMap::seen_from(const sensors::AntennaFrame& antenna,
                                   const sensors::Sensor& sensor) const {
  const SightFan fan(antenna, sensor);
  const glm::dvec3& at_m = antenna.position_m;
  const double far_m = farthest_m(sensor);
  Seen seen{at_m.z, at_m.z};
  bool bodies_mirror = false;
  bool ground_in_fan = false;
  double steepest = 0.0;
  double steepest_mirror = 0.0;
  double highest_mirror_m = -1e300;
  std::vector<const Tile*> bodies;  // within range
  const glm::dvec3 reach_m(far_m, far_m, 0.0);
  tiles_->for_tiles(at_m - reach_m, at_m + reach_m, [&](int column, int row) {
    const Tile& tile = tiles_->at(column, row);
    const double east_m = std::max({tile.low_m.x - at_m.x, at_m.x - tile.high_m.x, 0.0});
    const double north_m = std::max({tile.low_m.y - at_m.y, at_m.y - tile.high_m.y, 0.0});
    if (east_m * east_m + north_m * north_m > far_m * far_m) return;
    seen.lowest_ground_m = std::min(seen.lowest_ground_m, tile.lowest_ground_m);
    seen.highest_ground_m = std::max(seen.highest_ground_m, tile.highest_ground_m);
    steepest = std::max(steepest, tile.steepest);
    if (tile.has_bodies) bodies.push_back(&tile);
    const bool mirroring_ground = (tile.of_ground & mirrors_) != 0;
    const bool mirroring_bodies = (tile.of_bodies & mirrors_) != 0;
    seen.ground_mirrors = seen.ground_mirrors || mirroring_ground;
    if (!mirroring_ground && !mirroring_bodies) return;
    if (!may_meet(fan, tile)) return;
    seen.mirrors = true;
    bodies_mirror = bodies_mirror || mirroring_bodies;
    if (!mirroring_ground) return;
    ground_in_fan = true;
    steepest_mirror = std::max(steepest_mirror, tile.steepest);
    highest_mirror_m = std::max(highest_mirror_m, tile.highest_ground_m);
  });
  const SightFan turned =
      level_fan(antenna, sensor, largest_turn_rad(antenna, sensor, std::atan(steepest_mirror)));
  const bool meets_bodies = std::any_of(bodies.begin(), bodies.end(), [&](const Tile* tile) {
    return bodies_mirror || (ground_in_fan && may_meet(turned, *tile));
  });
  seen.mirrored_rays_end = meets_bodies;
  if (ground_in_fan && !meets_bodies) {
    const double down_rad =
        std::asin(std::clamp((at_m.z - highest_mirror_m - kRayError_m) / far_m, -1.0, 1.0));
    seen.mirrored_rays_end = !(down_rad - 2.0 * std::atan(steepest_mirror) > std::atan(steepest)) &&
                             ground_may_meet_itself(at_m, far_m, fan);
  }
  return seen;
}

}  // namespace fanbeam::scenes
