// Where in a scene the things stand that decide over effects, coarsely, so that a frame or a
// sequence can tell what it cannot see: renderer::FrameSight.
//
// The terrain is cut into tiles of about 128 m. A tile knows the heights in it, its steepest facet,
// and whether ground or bodies in it mirror. Everything is rounded towards more: a tile within reach
// with any part is within reach with all it holds.
//
// What a frame sees of mirrors. Double bounce follows the fan's rays from what they meet first
// (bounce_tracer.h), so without a mirror inside the fan and the farthest range it has nothing to
// add. Behind a mirror it needs something to meet: a body, which lies within the farthest range of
// the antenna because |OB| <= R1 + R2, and, where the ground alone mirrors, no farther beside the fan
// than its slopes turn a ray; or the ground. Beside the fan means by azimuths of the scene's
// horizontal, which level ground keeps; those of an antenna that leans, or scans a cone, it does not.
// A ray that comes down at the angle d onto
// ground of slope s leaves at the angle d - 2 s or more, and what it meets lies at a chord of the
// ground that is nowhere steeper than its steepest facet, t: with
//     d - 2 s > t ,   sin d >= (antenna - highest mirroring ground) / farthest range
// it meets no ground. Slopes count from the scene's horizontal, as d does. Where the whole ground
// within range is not that gentle relief.h looks at it square by square.
// Multipath reflects on the ellipsoid around antenna and target on which half the path is the range
// of its echo, so within the farthest range at any azimuth.
//
// Heights are of the scene's frame. Cost: 15 ms a million cells and 30 ms a million triangles to
// build; 20 ns a frame for each tile within the farthest range, and relief.h's. Copies share the tiles, whatever mirrors in them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "sensors/antenna/antenna_frame.h"
#include "sensors/sensor.h"
#include "terrain/height_field.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

class SightFan;

class SightMap {
 public:
  // Nothing in it mirrors yet.
  SightMap(const terrain::HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
           const std::vector<terrain::PlacedMesh>& meshes);
  // The same ground and bodies; `mirrors` by material id: the material reflects like a mirror.
  // Materials from the 64th on that the map has met count as one.
  SightMap with_mirrors(const std::vector<bool>& mirrors) const;

  struct Seen {
    double lowest_ground_m = 0.0, highest_ground_m = 0.0;  // within range; the antenna if none is
    bool mirrors = false;                                  // inside the fan
    bool mirrored_rays_end = false;
    bool ground_mirrors = false;  // within range, at any azimuth
  };
  Seen seen_from(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor) const;
  // Whether the fan may see a vertical column within the farthest range.
  bool fan_may_meet(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor,
                    const glm::dvec2& centre_m, double radius_m) const;
  // Whether the fan may pass the rim of the ground within the farthest range, or begins beyond it.
  bool ends_within_range(const sensors::AntennaFrame& antenna, const sensors::Sensor& sensor) const;

 private:
  struct Tile {
    glm::dvec3 low_m{1e300}, high_m{-1e300};  // ground and bodies
    double lowest_ground_m = 1e300, highest_ground_m = -1e300;
    double steepest = 0.0;  // tangent
    bool has_bodies = false;
    std::uint64_t of_ground = 0, of_bodies = 0;  // materials: bits by Tiles::bit_of
  };
  class Tiles;

  static bool may_meet(const SightFan& directions, const Tile& tile);
  bool ground_may_meet_itself(const glm::dvec3& antenna_m, double far_m, const SightFan& fan) const;

  std::shared_ptr<const Tiles> tiles_;
  std::uint64_t mirrors_ = 0;  // bits of the materials that mirror
};

}  // namespace fanbeam::scenes
