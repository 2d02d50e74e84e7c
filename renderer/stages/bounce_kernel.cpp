#include "renderer/stages/bounce_kernel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/series.h"
#include "renderer/casting/ray_aim.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {
namespace {

// Fills up to whole packets.
void repeat_last(BounceDoubles& values, int count) {
  std::fill(values.of + count, values.of + whole_packets(count), values[count - 1]);
}

// The antenna's axes, kept in registers.
struct Axes {
  explicit Axes(const sensors::AntennaFrame& antenna)
      : forward(antenna.forward), right(antenna.right), up(antenna.up) {}
  glm::dvec3 in_scene(const AxisWeights& w) const {
    return w.forward * forward + w.right * right + w.up * up;
  }
  glm::dvec3 forward, right, up;
};

template <bool cone>
void aim_all(const BounceView& view, FirstRays& first) {
  const Axes axes(view.antenna);
  const glm::dvec3 antenna_m = view.antenna.position_m - view.caster_m;
  const AntennaRays& angles = first.angles;
  const int end = whole_packets(first.rays.count);
  for (int i = 0; i < end; ++i)
    first.rays.aim(
        i, antenna_m,
        axes.in_scene(direction_weights(cone, angles.cos_elevation[i], angles.sin_elevation[i],
                                        angles.cos_azimuth[i], angles.sin_azimuth[i])),
        view.far_m);
}

// How far behind the mirror an echo may come from: where R1 + R2 + R3 is twice the farthest range,
// R3 being the third side of a triangle. The image's range, R1 + R2, is no shorter there.
double farthest_m(double range_m, double first_m, double cos_turn) {
  return 2.0 * range_m * (range_m - first_m) / (2.0 * range_m - first_m * (1.0 - cos_turn));
}

// Of a direction at any azimuth, within half a turn of `beside_rad`.
inline double all_round_azimuth_rad(double forward, double right, double beside_rad) {
  const double ahead_rad = core::series_arctangent(right, std::abs(forward));
  const double azimuth_rad =
      forward < 0.0 ? std::copysign(core::kPi, right) - ahead_rad : ahead_rad;
  const double apart_rad = azimuth_rad - beside_rad;
  return azimuth_rad - (apart_rad > core::kPi    ? 2.0 * core::kPi
                        : apart_rad < -core::kPi ? -2.0 * core::kPi
                                                 : 0.0);
}

// Of a way back along `line_m`: angles, their derivative as the line's end moves, and whether a
// beam in the middle sees it and the first direction.
template <bool cone, bool all_round>
inline void measure_return(const BounceView& view, const Axes& axes, const AxisWeights& first,
                           const glm::dvec3& line_m, const glm::dvec3& moves, MirroredRays& ways,
                           int k) {
  const double back_m = glm::length(line_m);
  const double inverse = 1.0 / std::max(back_m, 1e-30);
  const glm::dvec3 line = inverse * line_m;
  const double forward = glm::dot(line, axes.forward), right = glm::dot(line, axes.right),
               up = glm::dot(line, axes.up);
  const double flat = std::sqrt(forward * forward + (cone ? up * up : right * right));
  const double flat_inverse = 1.0 / std::max(flat, 1e-9);
  const double grows = glm::dot(moves, line);
  const glm::dvec3 turns = inverse * (moves - grows * line);
  const AxisWeights higher =
      cone ? elevation_derivative(true, forward * flat_inverse, up * flat_inverse, flat, right)
           : elevation_derivative(false, flat, up, forward * flat_inverse, right * flat_inverse);
  const double turned = higher.forward * glm::dot(turns, axes.forward) +
                        higher.right * glm::dot(turns, axes.right) +
                        higher.up * glm::dot(turns, axes.up);
  const double square =
      higher.forward * higher.forward + higher.right * higher.right + higher.up * higher.up;
  ways.back_m[k] = back_m;
  ways.back_m_per_rad[k] = grows;
  ways.turn[k] = turned / std::max(square, 1e-6);
  if constexpr (all_round) {
    ways.azimuth_rad[k] = all_round_azimuth_rad(forward, right, ways.angles.azimuth_rad[k]);
  } else {
    ways.azimuth_rad[k] = core::series_arctangent(right, cone ? flat : forward);
  }
  ways.elevation_rad[k] = core::series_arctangent(up, cone ? forward : flat);
  const double along = first.forward * forward + first.right * right;
  const double across = std::abs(first.forward * right - first.right * forward);
  const double beside = cone ? 1.0 : view.beam_tangent * along - across;
  ways.returns[k] = all_round ? beside : std::min(forward, beside);
}

template <bool cone, bool all_round>
inline void measure_all(const BounceView& view, MirroredRays& ways) {
  const Axes axes(view.antenna);
  const glm::dvec3 antenna_m = view.antenna.position_m;
  const int end = whole_packets(ways.rays.count);
  for (int k = 0; k < end; ++k) {
    const double ce = ways.angles.cos_elevation[k], se = ways.angles.sin_elevation[k];
    const double ca = ways.angles.cos_azimuth[k], sa = ways.angles.sin_azimuth[k];
    const glm::dvec3 mirror = ways.mirrors.normal.at(k);
    const glm::dvec3 normal = ways.hits.normal.at(k);
    const glm::dvec3 direction = ways.hits.direction.at(k);
    // The image of the antenna looks along the mirrored ray, at the plane of the facet.
    const glm::dvec3 unmirrored = axes.in_scene(elevation_derivative(cone, ce, se, ca, sa));
    const glm::dvec3 higher = unmirrored - (2.0 * glm::dot(unmirrored, mirror)) * mirror;
    const double length_m = ways.mirrors.distance_m[k] + ways.hits.distance_m[k];
    const double m_per_rad = length_m * glm::dot(higher, normal) / ways.hits.sin_grazing[k];
    const glm::dvec3 moves = length_m * higher + m_per_rad * direction;
    ways.length_m[k] = length_m;
    ways.m_per_rad[k] = m_per_rad;
    const glm::dvec3 line_m = ways.hits.point_m.at(k) - antenna_m;
    measure_return<cone, all_round>(view, axes, direction_weights(cone, ce, se, ca, sa), line_m,
                                    moves, ways, k);
    const double inverse = 1.0 / std::max(ways.back_m[k], 1e-30);
    const glm::dvec3 half = (-inverse) * line_m - direction;
    const double half_length = glm::length(half);
    ways.sin_out[k] = -inverse * glm::dot(line_m, normal);
    ways.normal_on_half[k] = glm::dot(half, normal) / std::max(half_length, 1e-30);
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
  const glm::dvec3 caster_m = view.caster_m;
  const int end = whole_packets(rays.count);
  for (int i = 0; i < end; ++i) {
    const glm::dvec3 along{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
    const glm::dvec3 origin_m{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
    const glm::dvec3 out{rays.normal_x[i], rays.normal_y[i], rays.normal_z[i]};
    const auto distance = static_cast<double>(rays.distance[i]);
    const double along_m = glm::length(along);
    const glm::dvec3 direction = (1.0 / along_m) * along;
    // A ray that met nothing may have none.
    const glm::dvec3 normal = (1.0 / std::max(glm::length(out), 1e-30)) * out;
    hits.direction.put(i, direction);
    hits.normal.put(i, normal);
    hits.point_m.put(i, origin_m + distance * along + caster_m);
    hits.distance_m[i] = along_m * distance;
    hits.sin_grazing[i] = std::min(-glm::dot(direction, normal), 1.0);
  }
}

FANBEAM_HOT(void, measure_polarisation, (const BounceView& view, FirstRays& first), (view, first)) {
  const glm::dvec3 up = view.antenna.up;
  const int end = whole_packets(first.rays.count);
  for (int i = 0; i < end; ++i) {
    const glm::dvec3 direction = first.hits.direction.at(i);
    const glm::dvec3 field = glm::cross(direction, up);
    const glm::dvec3 across = glm::cross(direction, first.hits.normal.at(i));
    const double squares = glm::dot(field, field) * glm::dot(across, across);
    const double product = glm::dot(field, across);
    // Head on both polarisations reflect alike.
    const double share = std::min(product * product / std::max(squares, 1e-30), 1.0);
    first.perpendicular[i] = squares > 1e-24 ? share : 1.0;
  }
}

FANBEAM_HOT(void, aim_mirrored_rays, (const BounceView& view, MirroredRays& mirrored),
            (view, mirrored)) {
  const RayHits& mirrors = mirrored.mirrors;
  const glm::dvec3 caster_m = view.caster_m;
  const double range_m = view.farthest_m;
  const int end = whole_packets(mirrored.rays.count);
  for (int k = 0; k < end; ++k) {
    const glm::dvec3 point_m = mirrors.point_m.at(k);
    const glm::dvec3 normal = mirrors.normal.at(k);
    const glm::dvec3 direction = mirrors.direction.at(k);
    const double first_m = mirrors.distance_m[k];
    const glm::dvec3 onwards = direction + (2.0 * mirrors.sin_grazing[k]) * normal;
    mirrored.rays.aim(k, terrain::secondary_origin_m(point_m, normal, first_m) - caster_m, onwards,
                      farthest_m(range_m, first_m, glm::dot(direction, onwards)));
  }
}

FANBEAM_HOT(void, measure_ways, (const BounceView& view, MirroredRays& mirrored),
            (view, mirrored)) {
  if (view.cone) {
    measure_all<true, false>(view, mirrored);
  } else if (view.all_round) {
    measure_all<false, true>(view, mirrored);
  } else {
    measure_all<false, false>(view, mirrored);
  }
}

}  // namespace fanbeam::renderer
