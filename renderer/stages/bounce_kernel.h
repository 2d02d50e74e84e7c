// Rays of bounces side by side, and what is worked out from them in vector loops. Private to the
// bounce tracer, whose header has the equations.
//
// Arrays are filled up to whole packets with copies of the last ray, so that no loop has a rest.
// Where nothing was met, what the loops work out means nothing; whoever takes it looks at
// `geometry` first.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sensors/antenna/antenna_frame.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

// Together: their arrays fit the second-level cache. Not a power of two, or all arrays would share
// the same lines of the first one.
inline constexpr int kBounceRays = 496;
inline constexpr int kWidestPacket = 16;

inline int whole_packets(int count) {
  return (count + kWidestPacket - 1) / kWidestPacket * kWidestPacket;
}

template <class Value>
struct alignas(64) BounceArray {
  Value of[kBounceRays];
  Value& operator[](int i) { return of[i]; }
  const Value& operator[](int i) const { return of[i]; }
};
using BounceDoubles = BounceArray<double>;
using BounceFloats = BounceArray<float>;

struct BouncePoints {
  BounceDoubles x, y, z;
  glm::dvec3 at(int i) const { return {x[i], y[i], z[i]}; }
  void put(int i, const glm::dvec3& point) {
    x[i] = point.x;
    y[i] = point.y;
    z[i] = point.z;
  }
};

// Rays of the caster, before and after the cast as in RayPacket.
struct CastRays {
  int count = 0;
  BounceFloats origin_x, origin_y, origin_z, direction_x, direction_y, direction_z, distance;
  BounceFloats normal_x, normal_y, normal_z;
  BounceArray<std::uint32_t> geometry, primitive;

  // As RayPacket::aim.
  void aim(int i, const glm::dvec3& origin_m, const glm::dvec3& along, double far_m) {
    origin_x[i] = static_cast<float>(origin_m.x);
    origin_y[i] = static_cast<float>(origin_m.y);
    origin_z[i] = static_cast<float>(origin_m.z);
    direction_x[i] = static_cast<float>(along.x);
    direction_y[i] = static_cast<float>(along.y);
    direction_z[i] = static_cast<float>(along.z);
    distance[i] = static_cast<float>(far_m);
  }
};

// Where rays met something, from the caster's own floats: rounding of the ray is not an error of
// the point.
struct RayHits {
  BouncePoints direction;  // unit
  BouncePoints point_m;
  BouncePoints normal;  // unit
  BounceDoubles distance_m, sin_grazing;
};

// Directions of the antenna, as angles with their cosines and sines.
struct AntennaRays {
  BounceDoubles azimuth_rad, elevation_rad;
  BounceDoubles cos_elevation, sin_elevation, cos_azimuth, sin_azimuth;
};

// The rays of the antenna, and what they met.
struct FirstRays {
  AntennaRays angles;
  CastRays rays;
  RayHits hits;
  // Share of the wave's power whose field is perpendicular to the plane of incidence, of a wave
  // that is polarised horizontally.
  BounceDoubles perpendicular;
};

// Rays behind a mirror, side by side with the first ones that they come from, what they met, and
// the way straight back from there.
struct MirroredRays {
  BounceArray<int> first;    // its number
  AntennaRays angles;        // the first ray's
  RayHits mirrors;           // where it met the mirror
  BounceDoubles reflection;  // power
  CastRays rays;
  RayHits hits;
  BounceDoubles length_m, m_per_rad;         // R1 + R2, and its derivative by the ray's elevation
  BounceDoubles back_m;                      // R3
  BounceDoubles azimuth_rad, elevation_rad;  // of the way back, from the antenna
  BounceDoubles back_m_per_rad, turn;        // derivatives by the ray's elevation of R3 and of that
  BounceDoubles sin_out, normal_on_half;     // sin psi_s and n.h
  BounceDoubles returns;                     // above 0 where one beam sees the mirror and the end
};

// What does not change from ray to ray.
struct BounceView {
  sensors::AntennaFrame antenna;
  bool cone = false;
  glm::dvec3 caster_m{0.0};   // the caster's origin in the scene
  double far_m = 0.0;         // of first rays
  double farthest_m = 0.0;    // range that an echo may have
  double beam_tangent = 0.0;  // of the angle between directions that one beam sees
  bool all_round = false;     // beams of a plane scan reach behind the antenna
};

// Fills first.rays from `count` azimuths and elevations.
void aim_first_rays(const BounceView& view, int count, FirstRays& first);
// Fills hits from what `rays` met.
void measure_hits(const BounceView& view, const CastRays& rays, RayHits& hits);
void measure_polarisation(const BounceView& view, FirstRays& first);
// Fills mirrored.rays from their count and the mirrors.
void aim_mirrored_rays(const BounceView& view, MirroredRays& mirrored);
// Fills what comes after the hits.
void measure_ways(const BounceView& view, MirroredRays& mirrored);

}  // namespace fanbeam::renderer
