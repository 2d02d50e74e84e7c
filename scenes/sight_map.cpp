#include "scenes/sight_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::scenes {
namespace {

using terrain::HeightField;

constexpr double kTile_m = 128.0;
// Floats of the ray caster and rounding (ray_scene.h: 25 mm).
constexpr double kMargin_m = 1.0;
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
  // `wider_rad` on both sides.
  Fan(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor, double wider_rad = 0.0)
      : antenna_(antenna), cone_(sensor.scan.surface == sensors::ScanSurface::cone) {
    const double half_rad = sensor.scan.field_of_view_rad / 2 + sensor.antenna.azimuth.cut_rad +
                            kMarginColumns * sensor.scan.column_width_rad() + wider_rad;
    all_round_ = half_rad >= core::kPi / 2;
    sine_ = std::sin(std::min(half_rad, core::kPi / 2));
    cosine_ = std::cos(std::min(half_rad, core::kPi / 2));
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
  const sensors::AntennaFrame& antenna_;
  bool cone_, all_round_ = false;
  double sine_ = 0.0, cosine_ = 0.0;
};

// How far ground whose facets rise at most `slope` turns a ray of the beam to the side: the mirrored
// direction is d + 2 sin(psi) n, the level part of d at least cos(steepest ray), that of n at most
// sin(slope). Pi where it may turn it anywhere.
double largest_turn_rad(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                        double slope_rad) {
  const double tilt_rad = std::acos(std::clamp(antenna.up.z, -1.0, 1.0));
  const double ray_rad = sensors::reach_rad(sensor.antenna.elevation) +
                         std::abs(sensor.antenna.boresight_elevation_rad) + tilt_rad;
  const double grazing_rad = ray_rad + slope_rad;
  if (grazing_rad >= core::kPi / 2) return core::kPi;
  const double sine = 2.0 * std::sin(grazing_rad) * std::sin(slope_rad) / std::cos(ray_rad);
  return sine < 1.0 ? std::asin(sine) : core::kPi;
}

}  // namespace

SightMap::SightMap(const HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
                   const std::vector<terrain::PlacedMesh>& meshes, const std::vector<bool>& mirrors)
    : west_m_(ground.west_m),
      south_m_(ground.south_m),
      east_m_(ground.east_m()),
      north_m_(ground.north_m()) {
  posts_per_tile_ = std::max(1, static_cast<int>(kTile_m / ground.spacing_m));
  tile_m_ = posts_per_tile_ * ground.spacing_m;
  columns_ = (ground.columns - 2) / posts_per_tile_ + 1;
  rows_ = (ground.rows - 2) / posts_per_tile_ + 1;
  tiles_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  add_ground(ground, mirrors);
  for (const terrain::SurfacePatch& patch : patches)
    if (patch.material < mirrors.size() && mirrors[patch.material]) add_patch(patch);
  for (const terrain::PlacedMesh& mesh : meshes) add_mesh(mesh, mirrors);
}

template <class Use>
void SightMap::for_tiles(const glm::dvec3& low_m, const glm::dvec3& high_m, const Use& use) {
  // What stands off the terrain belongs to the tile at its edge.
  const auto at = [this](double value_m, double start_m, int count) {
    return static_cast<int>(
        std::clamp(std::floor((value_m - start_m) / tile_m_), 0.0, static_cast<double>(count - 1)));
  };
  for (int row = at(low_m.y - kMargin_m, south_m_, rows_);
       row <= at(high_m.y + kMargin_m, south_m_, rows_); ++row)
    for (int column = at(low_m.x - kMargin_m, west_m_, columns_);
         column <= at(high_m.x + kMargin_m, west_m_, columns_); ++column)
      use(tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)],
          column, row);
}

void SightMap::add_ground(const HeightField& ground, const std::vector<bool>& mirrors) {
  for (int j = 0; j + 1 < ground.rows; ++j)
    for (int i = 0; i + 1 < ground.columns; ++i) {
      Tile& tile = tiles_[static_cast<std::size_t>(j / posts_per_tile_) *
                              static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(i / posts_per_tile_)];
      const terrain::MaterialId material = ground.cell_material[ground.cell(i, j)];
      tile.ground_mirrors = tile.ground_mirrors || (material < mirrors.size() && mirrors[material]);
      tile.steepest = std::max(tile.steepest, steepest_square(ground, i, j));
      for (const std::size_t post : {ground.post(i, j), ground.post(i + 1, j),
                                     ground.post(i, j + 1), ground.post(i + 1, j + 1)}) {
        tile.lowest_ground_m = std::min(tile.lowest_ground_m, ground.height_m[post]);
        tile.highest_ground_m = std::max(tile.highest_ground_m, ground.height_m[post]);
      }
    }
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      Tile& tile = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
      tile.steepest = std::sqrt(tile.steepest) / ground.spacing_m;
      tile.low_m = {west_m_ + column * tile_m_, south_m_ + row * tile_m_, tile.lowest_ground_m};
      tile.high_m = {west_m_ + (column + 1) * tile_m_, south_m_ + (row + 1) * tile_m_,
                     tile.highest_ground_m};
    }
}

void SightMap::add_patch(const terrain::SurfacePatch& patch) {
  glm::dvec3 low_m(1e300), high_m(-1e300);
  for (const glm::dvec2& corner : patch.outline_m) {
    low_m = glm::min(low_m, glm::dvec3(corner, 0.0));
    high_m = glm::max(high_m, glm::dvec3(corner, 0.0));
  }
  if (low_m.x <= high_m.x)
    for_tiles(low_m, high_m, [](Tile& tile, int, int) { tile.ground_mirrors = true; });
}

void SightMap::add_mesh(const terrain::PlacedMesh& placed, const std::vector<bool>& mirrors) {
  const terrain::TriangleMesh& mesh = placed.mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& corner = mesh.triangles[i];
    const glm::dvec3& a = mesh.vertices_m[corner.x];
    const glm::dvec3& b = mesh.vertices_m[corner.y];
    const glm::dvec3& c = mesh.vertices_m[corner.z];
    const terrain::MaterialId material = placed.material_of_name[mesh.triangle_material[i]];
    const bool mirror = material < mirrors.size() && mirrors[material];
    const glm::dvec3 low_m = glm::min(a, glm::min(b, c));
    const glm::dvec3 high_m = glm::max(a, glm::max(b, c));
    for_tiles(low_m, high_m, [&](Tile& tile, int column, int row) {
      tile.has_bodies = true;
      tile.bodies_mirror = tile.bodies_mirror || mirror;
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
  const glm::dvec3& at_m = antenna.position_m;
  return std::min({at_m.x - west_m_, east_m_ - at_m.x, at_m.y - south_m_, north_m_ - at_m.y}) <=
         farthest_m(sensor);
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
  for (const Tile& tile : tiles_) {
    const double east_m = std::max({tile.low_m.x - at_m.x, at_m.x - tile.high_m.x, 0.0});
    const double north_m = std::max({tile.low_m.y - at_m.y, at_m.y - tile.high_m.y, 0.0});
    if (east_m * east_m + north_m * north_m > far_m * far_m) continue;
    seen.lowest_ground_m = std::min(seen.lowest_ground_m, tile.lowest_ground_m);
    seen.highest_ground_m = std::max(seen.highest_ground_m, tile.highest_ground_m);
    steepest = std::max(steepest, tile.steepest);
    if (tile.has_bodies) bodies.push_back(&tile);
    seen.ground_mirrors = seen.ground_mirrors || tile.ground_mirrors;
    if (!tile.ground_mirrors && !tile.bodies_mirror) continue;
    if (!may_meet(fan, tile)) continue;
    seen.mirrors = true;
    bodies_mirror = bodies_mirror || tile.bodies_mirror;
    if (!tile.ground_mirrors) continue;
    ground_in_fan = true;
    steepest_mirror = std::max(steepest_mirror, tile.steepest);
    highest_mirror_m = std::max(highest_mirror_m, tile.highest_ground_m);
  }
  const Fan turned(antenna, sensor, largest_turn_rad(antenna, sensor, std::atan(steepest_mirror)));
  const bool meets_bodies = std::any_of(bodies.begin(), bodies.end(), [&](const Tile* tile) {
    return bodies_mirror || (ground_in_fan && may_meet(turned, *tile));
  });
  bool ground_meets_ground = false;
  if (ground_in_fan) {
    const double down_rad =
        std::asin(std::clamp((at_m.z - highest_mirror_m - kMargin_m) / far_m, -1.0, 1.0));
    ground_meets_ground = !(down_rad - 2.0 * std::atan(steepest_mirror) > std::atan(steepest));
  }
  seen.mirrored_rays_end = meets_bodies || ground_meets_ground;
  return seen;
}

}  // namespace fanbeam::scenes
