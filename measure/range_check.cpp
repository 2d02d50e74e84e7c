#include "measure/range_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/median.h"
#include "core/parallel.h"
#include "core/turns.h"
#include "renderer/casting/ray_caster.h"
#include "sensors/cells.h"

namespace fanbeam::measure {
namespace {

using terrain::RayPacket;

constexpr int kLanes = 16;
constexpr std::size_t kPacketsPerTask = 256;

// Recorded packets mark lanes without a ray by an empty interval.
bool holds_ray(const RayPacket<kLanes>& packet, int lane) {
  return packet.near[lane] <= packet.distance[lane];
}

RayPacket<kLanes> cast(const terrain::RayScene& surfaces, const RayPacket<kLanes>& sent) {
  RayPacket<kLanes> packet = sent;
  alignas(64) std::array<int, kLanes> active{};
  for (int i = 0; i < kLanes; ++i)
    active[static_cast<std::size_t>(i)] = holds_ray(sent, i) ? -1 : 0;
  surfaces.intersect(active.data(), packet);
  return packet;
}

double double_range_m(const terrain::RayScene& surfaces, const glm::dvec3& antenna_m,
                      const RayPacket<kLanes>& packet, int lane) {
  const auto [a, b, c] = surfaces.triangle(packet.geometry[lane], packet.primitive[lane]);
  const glm::dvec3 direction = glm::normalize(glm::dvec3(
      static_cast<double>(packet.direction_x[lane]), static_cast<double>(packet.direction_y[lane]),
      static_cast<double>(packet.direction_z[lane])));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  return glm::dot(normal, a - antenna_m) / glm::dot(normal, direction);
}

}  // namespace

RangeCheck::RangeCheck(const renderer::World& world, const renderer::FramePose& pose,
                       const renderer::Sampling& sampling)
    : world_(world) {
  const sensors::AntennaFrame antenna = renderer::antenna_of(world.sensor, pose);
  antenna_m_ = antenna.position_m;
  packets_ = renderer::RayCaster(world, sampling).packets(antenna);
}

RangeFigures RangeCheck::ranges(int repetitions) const {
  const terrain::RayScene& surfaces = world_.surfaces();
  std::vector<double> differences_m;
  RangeFigures figures;
  double squares_m2 = 0.0;
  for (const RayPacket<kLanes>& sent : packets_) {
    const RayPacket<kLanes> packet = cast(surfaces, sent);
    for (int i = 0; i < kLanes; ++i) {
      if (!holds_ray(sent, i) || packet.geometry[i] == terrain::kNoHit) continue;
      const auto float_m = static_cast<double>(packet.distance[i]);
      const double double_m = double_range_m(surfaces, antenna_m_, packet, i);
      if (!std::isfinite(double_m)) continue;  // a facet seen exactly along its edge
      differences_m.push_back(std::abs(float_m - double_m));
      squares_m2 += differences_m.back() * differences_m.back();
      figures.other_cell += sensors::range_row(world_.sensor.range, float_m) !=
                                    sensors::range_row(world_.sensor.range, double_m)
                                ? 1
                                : 0;
    }
  }
  figures.hits = differences_m.size();
  if (!differences_m.empty()) {
    figures.median_m = core::median(differences_m);
    figures.rms_m = std::sqrt(squares_m2 / static_cast<double>(differences_m.size()));
    figures.largest_m = *std::max_element(differences_m.begin(), differences_m.end());
  }
  // What the passes find, so that they are not left out as idle.
  std::vector<double> found_m((packets_.size() + kPacketsPerTask - 1) / kPacketsPerTask);
  const auto pass = [&](bool in_double) {
    core::parallel_for(found_m.size(), [&](std::size_t task) {
      const std::size_t begin = task * kPacketsPerTask;
      const std::size_t end = std::min(begin + kPacketsPerTask, packets_.size());
      double sum_m = 0.0;
      for (std::size_t k = begin; k < end; ++k) {
        const RayPacket<kLanes> packet = cast(surfaces, packets_[k]);
        for (int i = 0; i < kLanes; ++i) {
          if (!holds_ray(packets_[k], i) || packet.geometry[i] == terrain::kNoHit) continue;
          sum_m += in_double ? double_range_m(surfaces, antenna_m_, packet, i)
                             : static_cast<double>(packet.distance[i]);
        }
      }
      found_m[task] = sum_m;
    });
  };
  const auto times = core::time_in_turns({[&] { pass(false); }, [&] { pass(true); }}, repetitions);
  figures.cast = times[0];
  figures.cast_and_double = times[1];
  return figures;
}

RobustFigures RangeCheck::against(const terrain::RayScene& other) const {
  const double moved_m = 0.01 * world_.sensor.range.cell_m;
  RobustFigures figures;
  for (const RayPacket<kLanes>& sent : packets_) {
    const RayPacket<kLanes> a = cast(world_.surfaces(), sent), b = cast(other, sent);
    for (int i = 0; i < kLanes; ++i) {
      if (!holds_ray(sent, i)) continue;
      ++figures.rays;
      const bool hit_a = a.geometry[i] != terrain::kNoHit, hit_b = b.geometry[i] != terrain::kNoHit;
      const auto apart_m = static_cast<double>(std::abs(a.distance[i] - b.distance[i]));
      if (hit_a && !hit_b) {
        ++figures.lost;
      } else if (hit_b && (!hit_a || apart_m > moved_m)) {
        ++figures.moved;
      }
    }
  }
  return figures;
}

}  // namespace fanbeam::measure
