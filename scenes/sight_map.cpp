#include "scenes/sight_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "sensors/antenna/column_place.h"

namespace fanbeam::scenes {
namespace {

using terrain::HeightField;

constexpr double kTile_m = 128.0;
// Floats of the ray caster and rounding (ray_scene.h: 25 mm); a car's antenna is half a metre up.
constexpr double kMargin_m = 1.0, kRayError_m = 0.05;
// An echo is spread over half the way to its neighbours at most, from a little beyond the gate too.
constexpr double kMarginCells = 8.0;
// What the fan may be wider than field of view and beam: sub-columns come in whole groups.
constexpr double kMarginColumns = 5.0;

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

// Directions of the fan and a sphere: false only where they certainly miss each other.
class Fan {
 public:
  Fan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor)
      : Fan(antenna, half_of(sensor), sensor.scan.surface) {}
  Fan(const sensors::AntennaFrame& antenna, double half_rad, sensors::ScanSurface surface)
      : antenna_(antenna),
        cone_(surface == sensors::ScanSurface::cone),
        all_round_(half_rad >= core::kPi / 2),
        sine_(std::sin(std::min(half_rad, core::kPi / 2))),
        cosine_(std::cos(std::min(half_rad, core::kPi / 2))) {}

  static double half_of(const sensors::Sensor& sensor) {
    return sensor.scan.field_of_view_rad / 2 + fan_margin_rad(sensor);
  }

  bool may_meet(const glm::dvec3& centre_m, double radius_m) const {
    if (all_round_) return true;
    const glm::dvec3 to_m = centre_m - antenna_.position_m;
    const double right_m = std::abs(glm::dot(to_m, antenna_.right));
    if (cone_) return right_m <= (glm::length(to_m) + radius_m) * sine_ + radius_m;
    // Distance from the nearer side of the wedge.
    return right_m * cosine_ - glm::dot(to_m, antenna_.forward) * sine_ <= radius_m;
  }

  // The same of all that a vertical column holds within `far_m`.
  bool may_meet_column(const glm::dvec2& centre_m, double radius_m, double far_m) const {
    if (all_round_) return true;
    const glm::dvec2 to_m = centre_m - glm::dvec2(antenna_.position_m);
    const double right_m = std::abs(glm::dot(to_m, glm::dvec2(antenna_.right)));
    const double right_up_m = far_m * std::abs(antenna_.right.z);
    if (cone_) return right_m - right_up_m - radius_m <= far_m * sine_;
    return right_m * cosine_ - glm::dot(to_m, glm::dvec2(antenna_.forward)) * sine_ <=
           radius_m + right_up_m * cosine_ + far_m * std::abs(antenna_.forward.z) * sine_;
  }

 private:
  sensors::AntennaFrame antenna_;
  bool cone_, all_round_;
  double sine_, cosine_;
};

// How far ground whose facets rise at most `slope` turns a ray of the beam to the side: the mirrored
// direction is d + 2 sin(psi) n, the level part of d at least cos(steepest ray), that of n at most
// sin(slope). Pi where it may turn it anywhere.
double largest_turn_rad(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                        double slope_rad) {
  const double tilt_rad = std::acos(std::clamp(antenna.up.z, -1.0, 1.0));
  const double ray_rad = sensors::steepest_rad(sensor) + tilt_rad;
  const double grazing_rad = ray_rad + slope_rad;
  if (grazing_rad >= core::kPi / 2) return core::kPi;
  const double sine = 2.0 * std::sin(grazing_rad) * std::sin(slope_rad) / std::cos(ray_rad);
  return sine < 1.0 ? std::asin(sine) : core::kPi;
}

// The fan's azimuths in the scene's horizontal, which is what level ground keeps of a ray that it
// mirrors: those of the antenna turned level under its heading, wider by what the turn back moves
// the steepest ray aside, and by `wider_rad`. The azimuth a of a ray on a cone is atan(tan a / cos e)
// there.
Fan level_fan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
              double wider_rad) {
  sensors::AntennaFrame level;
  level.position_m = antenna.position_m;
  const glm::dvec2 heading(antenna.forward);
  const double steepest = sensors::steepest_rad(sensor);
  double half_rad = core::kPi;
  if (steepest < core::kPi / 2 && glm::length(heading) > 0.0) {
    level.forward = glm::dvec3(glm::normalize(heading), 0.0);
    level.right = {level.forward.y, -level.forward.x, 0.0};
    // |d - d0| of a direction and its turned one: 2 sin(turn / 2), the trace being 1 + 2 cos(turn).
    const double chord =
        std::sqrt(std::max(0.0, 3.0 - glm::dot(antenna.forward, level.forward) -
                                    glm::dot(antenna.right, level.right) - antenna.up.z));
    const double moved = chord / std::cos(steepest);
    half_rad = Fan::half_of(sensor);
    if (sensor.scan.surface == sensors::ScanSurface::cone && half_rad < core::kPi / 2)
      half_rad = std::atan(std::tan(half_rad) / std::cos(steepest));
    half_rad += wider_rad + (moved < 1.0 ? std::asin(moved) : core::kPi);
  }
  return {level, half_rad, sensors::ScanSurface::plane};
}

}  // namespace

double fan_margin_rad(const sensors::Sensor& sensor) {
  return sensor.antenna.azimuth.cut_rad + kMarginColumns * sensor.scan.column_width_rad();
}

class SightMap::Tiles {
 public:
  Tiles(const HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
        const std::vector<terrain::PlacedMesh>& meshes)
      : west_m(ground.west_m),
        south_m(ground.south_m),
        east_m(ground.east_m()),
        north_m(ground.north_m()),
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
  return Fan(antenna, sensor).may_meet_column(centre_m, radius_m, farthest_m(sensor));
}

bool SightMap::ends_within_range(const sensors::AntennaFrame& antenna,
                                 const sensors::Sensor& sensor) const {
  const glm::dvec2 at_m(antenna.position_m);
  const glm::dvec2 low_m(tiles_->west_m, tiles_->south_m);
  const glm::dvec2 high_m(tiles_->east_m, tiles_->north_m);
  if (glm::clamp(at_m, low_m, high_m) != at_m) return true;
  const double far_m = farthest_m(sensor);
  const Fan fan(antenna, sensor);
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

SightMap::Seen SightMap::seen_from(const sensors::AntennaFrame& antenna,
                                   const sensors::Sensor& sensor) const {
  const Fan fan(antenna, sensor);
  const glm::dvec3& at_m = antenna.position_m;
  const double far_m = farthest_m(sensor);
  Seen seen{at_m.z, at_m.z};
  bool bodies_mirror = false;
  bool ground_in_fan = false;
  double steepest = 0.0;
  double steepest_mirror = 0.0;
  double highest_mirror_m = -1e300;
  std::vector<const Tile*> bodies;  // within range
  const auto may_meet = [](const Fan& directions, const Tile& tile) {
    return directions.may_meet((tile.low_m + tile.high_m) / 2.0,
                               glm::length(tile.high_m - tile.low_m) / 2.0 + kMargin_m);
  };
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
  const Fan turned =
      level_fan(antenna, sensor, largest_turn_rad(antenna, sensor, std::atan(steepest_mirror)));
  const bool meets_bodies = std::any_of(bodies.begin(), bodies.end(), [&](const Tile* tile) {
    return bodies_mirror || (ground_in_fan && may_meet(turned, *tile));
  });
  bool ground_meets_ground = false;
  if (ground_in_fan) {
    const double down_rad =
        std::asin(std::clamp((at_m.z - highest_mirror_m - kRayError_m) / far_m, -1.0, 1.0));
    ground_meets_ground = !(down_rad - 2.0 * std::atan(steepest_mirror) > std::atan(steepest));
  }
  seen.mirrored_rays_end = meets_bodies || ground_meets_ground;
  return seen;
}

}  // namespace fanbeam::scenes
