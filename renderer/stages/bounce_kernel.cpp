#include "renderer/stages/bounce_kernel.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/series.h"
#include "renderer/casting/ray_aim.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {
namespace {

struct Vector {
  double x, y, z;
};
Vector vector_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
Vector vector_at(const BouncePoints& points, int i) {
  return {points.x[i], points.y[i], points.z[i]};
}
void put(const Vector& v, BouncePoints& points, int i) {
  points.x[i] = v.x;
  points.y[i] = v.y;
  points.z[i] = v.z;
}
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(double a, const Vector& b) { return {a * b.x, a * b.y, a * b.z}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Fills up to whole packets.
void repeat_last(BounceDoubles& values, int count) {
  std::fill(values.of + count, values.of + whole_packets(count), values[count - 1]);
}

// The antenna's axes, kept in registers.
struct Axes {
  explicit Axes(const sensors::AntennaFrame& antenna)
      : forward(vector_of(antenna.forward)),
        right(vector_of(antenna.right)),
        up(vector_of(antenna.up)) {}
  Vector in_scene(const AxisWeights& w) const {
    return w.forward * forward + w.right * right + w.up * up;
  }
  Vector forward, right, up;
};

void aim(const Vector& origin_m, const Vector& direction, double far_m, double base_m,
         CastRays& rays, int i) {
  rays.origin_x[i] = static_cast<float>(origin_m.x);
  rays.origin_y[i] = static_cast<float>(origin_m.y);
  rays.origin_z[i] = static_cast<float>(origin_m.z - base_m);
  rays.direction_x[i] = static_cast<float>(direction.x);
  rays.direction_y[i] = static_cast<float>(direction.y);
  rays.direction_z[i] = static_cast<float>(direction.z);
  rays.distance[i] = static_cast<float>(far_m);
}

template <bool cone>
void aim_all(const BounceView& view, FirstRays& first) {
  const Axes axes(view.antenna);
  const Vector antenna_m = vector_of(view.antenna.position_m);
  const AntennaRays& angles = first.angles;
  const int end = whole_packets(first.rays.count);
  for (int i = 0; i < end; ++i)
    aim(antenna_m,
        axes.in_scene(direction_weights(cone, angles.cos_elevation[i], angles.sin_elevation[i],
                                        angles.cos_azimuth[i], angles.sin_azimuth[i])),
        view.far_m, view.base_m, first.rays, i);
}

// How far behind the mirror an echo may come from: where R1 + R2 + R3 is twice the farthest range,
// R3 being the third side of a triangle. The image's range, R1 + R2, is no shorter there.
double farthest_m(double range_m, double first_m, double cos_turn) {
  return 2.0 * range_m * (range_m - first_m) / (2.0 * range_m - first_m * (1.0 - cos_turn));
}

// Of a way back along `line_m`: angles, their derivative as the line's end moves, and whether a
// beam in the middle sees it and the first direction.
template <bool cone>
inline void measure_return(const BounceView& view, const Axes& axes, const AxisWeights& first,
                           const Vector& line_m, const Vector& moves, MirroredRays& ways, int k) {
  const double back_m = length(line_m);
  const double inverse = 1.0 / std::max(back_m, 1e-30);
  const Vector line = inverse * line_m;
  const double forward = dot(line, axes.forward), right = dot(line, axes.right),
               up = dot(line, axes.up);
  const double flat = std::sqrt(forward * forward + (cone ? up * up : right * right));
  const double flat_inverse = 1.0 / std::max(flat, 1e-9);
  const double grows = dot(moves, line);
  const Vector turns = inverse * (moves - grows * line);
  const AxisWeights higher =
      cone ? elevation_derivative(true, forward * flat_inverse, up * flat_inverse, flat, right)
           : elevation_derivative(false, flat, up, forward * flat_inverse, right * flat_inverse);
  const double turned = higher.forward * dot(turns, axes.forward) +
                        higher.right * dot(turns, axes.right) + higher.up * dot(turns, axes.up);
  const double square =
      higher.forward * higher.forward + higher.right * higher.right + higher.up * higher.up;
  ways.back_m[k] = back_m;
  ways.back_m_per_rad[k] = grows;
  ways.turn[k] = turned / std::max(square, 1e-6);
  ways.azimuth_rad[k] = core::series_arctangent(right, cone ? flat : forward);
  ways.elevation_rad[k] = core::series_arctangent(up, cone ? forward : flat);
  const double along = first.forward * forward + first.right * right;
  const double across = std::abs(first.forward * right - first.right * forward);
  ways.returns[k] = std::min(forward, cone ? 1.0 : view.beam_tangent * along - across);
}

template <bool cone>
inline void measure_all(const BounceView& view, MirroredRays& ways) {
  const Axes axes(view.antenna);
  const Vector antenna_m = vector_of(view.antenna.position_m);
  const int end = whole_packets(ways.rays.count);
  for (int k = 0; k < end; ++k) {
    const double ce = ways.angles.cos_elevation[k], se = ways.angles.sin_elevation[k];
    const double ca = ways.angles.cos_azimuth[k], sa = ways.angles.sin_azimuth[k];
    const Vector mirror = vector_at(ways.mirrors.normal, k);
    const Vector normal = vector_at(ways.hits.normal, k);
    const Vector direction = vector_at(ways.hits.direction, k);
    // The image of the antenna looks along the mirrored ray, at the plane of the facet.
    const Vector unmirrored = axes.in_scene(elevation_derivative(cone, ce, se, ca, sa));
    const Vector higher = unmirrored - (2.0 * dot(unmirrored, mirror)) * mirror;
    const double length_m = ways.mirrors.distance_m[k] + ways.hits.distance_m[k];
    const double m_per_rad = length_m * dot(higher, normal) / ways.hits.sin_grazing[k];
    const Vector moves = length_m * higher + m_per_rad * direction;
    ways.length_m[k] = length_m;
    ways.m_per_rad[k] = m_per_rad;
    const Vector line_m = vector_at(ways.hits.point_m, k) - antenna_m;
    measure_return<cone>(view, axes, direction_weights(cone, ce, se, ca, sa), line_m, moves, ways,
                         k);
    const double inverse = 1.0 / std::max(ways.back_m[k], 1e-30);
    const Vector half = (-inverse) * line_m - direction;
    const double half_length = length(half);
    ways.sin_out[k] = -inverse * dot(line_m, normal);
    ways.normal_on_half[k] = dot(half, normal) / std::max(half_length, 1e-30);
    ways.returns[k] = std::min(ways.returns[k], half_length);
  }
}

}  // namespace

FANBEAM_HOT(void, aim_first_rays, (const BounceView& view, int count, FirstRays& first),
            (view, count, first)) {
  first.rays.count = count;
  AntennaRays& angles = first.angles;
  const int end = whole_packets(count);
  repeat_last(angles.azimuth_rad, count);
  repeat_last(angles.elevation_rad, count);
  for (int i = 0; i < end; ++i) {
    core::series_cosine_sine(angles.elevation_rad[i], angles.cos_elevation[i],
                             angles.sin_elevation[i]);
    core::series_cosine_sine(angles.azimuth_rad[i], angles.cos_azimuth[i], angles.sin_azimuth[i]);
  }
  for (int i = 0; i < end; ++i)
    if (std::abs(angles.azimuth_rad[i]) > core::kPi / 2) {  // of a fan wider than the series
      angles.cos_azimuth[i] = std::cos(angles.azimuth_rad[i]);
      angles.sin_azimuth[i] = std::sin(angles.azimuth_rad[i]);
    }
  if (view.cone) {
    aim_all<true>(view, first);
  } else {
    aim_all<false>(view, first);
  }
}

FANBEAM_HOT(void, measure_hits, (const BounceView& view, const CastRays& rays, RayHits& hits),
            (view, rays, hits)) {
  const double base_m = view.base_m;
  const int end = whole_packets(rays.count);
  for (int i = 0; i < end; ++i) {
    const Vector along{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
    const Vector origin_m{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
    const Vector out{rays.normal_x[i], rays.normal_y[i], rays.normal_z[i]};
    const double distance = static_cast<double>(rays.distance[i]);
    const double along_m = length(along);
    const Vector direction = (1.0 / along_m) * along;
    const Vector normal = (1.0 / length(out)) * out;
    put(direction, hits.direction, i);
    put(normal, hits.normal, i);
    put(origin_m + distance * along + Vector{0.0, 0.0, base_m}, hits.point_m, i);
    hits.distance_m[i] = along_m * distance;
    hits.sin_grazing[i] = std::min(-dot(direction, normal), 1.0);
  }
}

FANBEAM_HOT(void, measure_polarisation, (const BounceView& view, FirstRays& first), (view, first)) {
  const Vector up = vector_of(view.antenna.up);
  const int end = whole_packets(first.rays.count);
  for (int i = 0; i < end; ++i) {
    const Vector direction = vector_at(first.hits.direction, i);
    const Vector field = cross(direction, up);
    const Vector across = cross(direction, vector_at(first.hits.normal, i));
    const double squares = dot(field, field) * dot(across, across);
    const double product = dot(field, across);
    // Head on both polarisations reflect alike.
    const double share = std::min(product * product / std::max(squares, 1e-30), 1.0);
    first.perpendicular[i] = squares > 1e-24 ? share : 1.0;
  }
}

FANBEAM_HOT(void, aim_mirrored_rays, (const BounceView& view, MirroredRays& mirrored),
            (view, mirrored)) {
  const RayHits& mirrors = mirrored.mirrors;
  const double base_m = view.base_m, range_m = view.farthest_m;
  const int end = whole_packets(mirrored.rays.count);
  for (int k = 0; k < end; ++k) {
    const Vector point_m = vector_at(mirrors.point_m, k);
    const Vector normal = vector_at(mirrors.normal, k);
    const Vector direction = vector_at(mirrors.direction, k);
    const double first_m = mirrors.distance_m[k];
    const double offset_m = terrain::secondary_offset_m({point_m.x, point_m.y, point_m.z}, first_m);
    const Vector onwards = direction + (2.0 * mirrors.sin_grazing[k]) * normal;
    aim(point_m + offset_m * normal, onwards, farthest_m(range_m, first_m, dot(direction, onwards)),
        base_m, mirrored.rays, k);
  }
}

FANBEAM_HOT(void, measure_ways, (const BounceView& view, MirroredRays& mirrored),
            (view, mirrored)) {
  if (view.cone) {
    measure_all<true>(view, mirrored);
  } else {
    measure_all<false>(view, mirrored);
  }
}

}  // namespace fanbeam::renderer
