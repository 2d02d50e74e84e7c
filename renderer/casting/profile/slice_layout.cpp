#include "renderer/casting/profile/slice_layout.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/heading.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

// A beam to straight below or above spans it, but for rounding.
constexpr double kHalfTurn_rad = core::kPi + 1e-6;

// To there an antenna that counts as level (fan_layout.h) keeps its headings to a milliradian.
constexpr double kSteepest_rad = core::kPi / 4;

struct Headings {
  double left_rad = core::kPi, right_rad = -core::kPi;
};

Headings headings_of_fan(const World& world, const sensors::AntennaFrame& antenna,
                         const FanSums& sums) {
  constexpr int kSteps = 16;
  const glm::dvec2 forward = horizontal(antenna.forward);
  const sensors::Antenna& beams = world.sensor.antenna;
  const double reach_rad = sensors::reach_rad(beams.elevation);
  Headings headings;
  for (int e = 0; e <= kSteps; ++e) {
    const double elevation_rad =
        std::clamp(beams.boresight_elevation_rad + reach_rad * (2.0 * e / kSteps - 1.0),
                   -core::kPi / 2, core::kPi / 2);
    for (int a = 0; a <= kSteps; ++a) {
      const double azimuth_rad =
          sums.first_azimuth_rad + sums.sub_columns * sums.step_rad * a / kSteps;
      const double heading_rad =
          turn_rad(forward, horizontal(sensors::direction(antenna, azimuth_rad, elevation_rad,
                                                          world.sensor.scan.surface)));
      headings.left_rad = std::min(headings.left_rad, heading_rad);
      headings.right_rad = std::max(headings.right_rad, heading_rad);
    }
  }
  return headings;
}

}  // namespace

std::vector<Slice> level_slices(const World& world, int per_sub_column,
                                const sensors::AntennaFrame& antenna, const FanSums& sums) {
  const glm::dvec2 forward = horizontal(antenna.forward);
  const int count = sums.sub_columns * per_sub_column;
  const double width_rad = sums.step_rad / per_sub_column;
  // Any elevation has an azimuth's heading, but one straight down or up.
  const double elevation_rad =
      std::clamp(world.sensor.antenna.boresight_elevation_rad, -kSteepest_rad, kSteepest_rad);
  std::vector<Slice> slices;
  slices.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double azimuth_rad = sums.first_azimuth_rad + (i + 0.5) * width_rad;
    const glm::dvec2 along = horizontal(
        sensors::direction(antenna, azimuth_rad, elevation_rad, world.sensor.scan.surface));
    double heading_rad = turn_rad(forward, along);
    // What few wide columns are filled up with, to whole groups, may lie beyond straight behind.
    if (!slices.empty() && heading_rad < slices.back().heading_rad) heading_rad += 2.0 * core::kPi;
    slices.push_back({along, heading_rad, width_rad});
  }
  return slices;
}

std::vector<Slice> tilted_slices(const World& world, int per_sub_column,
                                 const sensors::AntennaFrame& antenna, const FanSums& sums) {
  const Headings seen = headings_of_fan(world, antenna, sums);
  // Headings on both sides of straight behind: the beam holds the nadir, or looks back past it. Then
  // all headings once, for those between the outermost that were tried may be seen as well.
  const bool all_round = seen.right_rad - seen.left_rad > kHalfTurn_rad;
  const double left_rad = all_round ? -core::kPi : seen.left_rad;
  const double span_rad = all_round ? 2.0 * core::kPi : seen.right_rad - seen.left_rad;
  const double step_rad = sums.step_rad / per_sub_column;
  const int count = static_cast<int>(std::ceil(span_rad / step_rad)) + (all_round ? 0 : 1);
  const double wanted_rad = all_round ? span_rad / count : step_rad;
  const glm::dvec2 forward = horizontal(antenna.forward);
  const glm::dvec2 clockwise(forward.y, -forward.x);
  std::vector<Slice> slices;
  slices.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double heading_rad = left_rad + (i + 0.5) * wanted_rad;
    slices.push_back({forward * std::cos(heading_rad) + clockwise * std::sin(heading_rad),
                      heading_rad, wanted_rad});
  }
  return slices;
}

std::vector<SubColumnSlices> slices_of_groups(const std::vector<std::uint32_t>& groups,
                                              const std::vector<std::uint8_t>& for_rays,
                                              int slices_per_sub_column) {
  const auto per_sub = static_cast<std::size_t>(slices_per_sub_column);
  std::vector<SubColumnSlices> columns;
  columns.reserve(groups.size() * kGroupAzimuths);
  for (const std::uint32_t group : groups) {
    for (std::size_t a = 0; a < kGroupAzimuths; ++a) {
      const std::size_t sub = group * std::size_t{kGroupAzimuths} + a;
      if (for_rays[sub] == 0) columns.push_back({sub, sub * per_sub, (sub + 1) * per_sub});
    }
  }
  return columns;
}

std::vector<std::uint32_t> groups_of_rays(const std::vector<std::uint32_t>& groups,
                                          const std::vector<std::uint8_t>& for_rays) {
  std::vector<std::uint32_t> some;
  for (const std::uint32_t group : groups) {
    const auto first = for_rays.begin() + static_cast<std::ptrdiff_t>(group) * kGroupAzimuths;
    if (std::find(first, first + kGroupAzimuths, 1) != first + kGroupAzimuths)
      some.push_back(group);
  }
  return some;
}

}  // namespace fanbeam::renderer
