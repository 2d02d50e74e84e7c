#include "renderer/casting/profile/profile_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "core/errors.h"
#include "core/parallel.h"
#include "renderer/casting/profile/slice_sweep.h"
#include "renderer/casting/ray_kernel.h"

namespace fanbeam::renderer {

namespace {

// The points asked for, by the slice they lie in.
struct PointsOfSlices {
  std::vector<std::size_t> begin;  // one more than slices
  std::vector<SightPoint> points;
};

}  // namespace

struct ProfileCaster::Frame {
  const sensors::AntennaFrame& antenna;
  const std::vector<std::uint32_t>& ray_groups;  // rising
  const PathLossTable& path_loss;
  const std::vector<Slice>& slices;
  const EdgeIndex& edges;
  const PointsOfSlices& points;
  std::uint8_t* clear;
  std::size_t tile;   // slices that share their candidates
  double dark_below;  // tangent of the elevation at which the antenna's pattern begins
  bool with_cscope;

  SliceSweep::Sights sights(std::size_t slice) const {
    return {points.points.data() + points.begin[slice],
            points.points.data() + points.begin[slice + 1], clear};
  }
};

namespace {

glm::dvec2 horizontal(const glm::dvec3& direction) {
  const glm::dvec2 flat(direction.x, direction.y);
  const double length = glm::length(flat);
  return length > 1e-9 ? flat / length : glm::dvec2(0.0, 1.0);
}

double turn_rad(const glm::dvec2& from, const glm::dvec2& to) {
  return std::atan2(from.y * to.x - from.x * to.y, glm::dot(from, to));
}

// Points beyond the slices, and in azimuths left to rays, stay at kAskRays.
PointsOfSlices sort_points(const std::vector<Slice>& slices, const glm::dvec3& sensor_m,
                           const glm::dvec2& forward, SightLines& sight) {
  std::vector<std::size_t> slice_of(sight.to_m.size());
  PointsOfSlices sorted;
  sorted.begin.assign(slices.size() + 1, 0);
  const double half_rad = slices.front().width_rad / 2;
  const auto before = [half_rad](const Slice& slice, double heading_rad) {
    return slice.heading_rad + half_rad < heading_rad;
  };
  for (std::size_t i = 0; i < sight.to_m.size(); ++i) {
    const double heading_rad = turn_rad(forward, glm::dvec2(sight.to_m[i] - sensor_m));
    const auto at = std::lower_bound(slices.begin(), slices.end(), heading_rad, before);
    const bool inside = at != slices.end() && heading_rad >= at->heading_rad - half_rad;
    slice_of[i] = inside ? static_cast<std::size_t>(at - slices.begin()) : slices.size();
    if (inside) ++sorted.begin[slice_of[i] + 1];
  }
  for (std::size_t s = 0; s < slices.size(); ++s) sorted.begin[s + 1] += sorted.begin[s];
  sorted.points.resize(sorted.begin.back());
  std::vector<std::size_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (std::size_t i = 0; i < sight.to_m.size(); ++i) {
    if (slice_of[i] == slices.size()) continue;
    const glm::dvec3 there = sight.to_m[i] - sensor_m;
    sorted.points[next[slice_of[i]]++] = {glm::length(glm::dvec2(there)), there.z, i};
  }
  return sorted;
}

// An antenna that counts as level leans by half of this at most.
constexpr double kLeaning_rad = 2e-3;

// What a box covers of the horizon, seen from above; the whole of it from inside.
struct HeadingSpan {
  double left_rad = -core::kPi, right_rad = core::kPi;
  double nearest_m = 0.0;
};

HeadingSpan headings_of(const terrain::Box_m& box, const glm::dvec2& sensor_m,
                        const glm::dvec2& forward) {
  const glm::dvec2 low = glm::dvec2(box.low) - sensor_m, high = glm::dvec2(box.high) - sensor_m;
  const glm::dvec2 nearest = glm::clamp(glm::dvec2(0.0), low, high);
  HeadingSpan span;
  span.nearest_m = glm::length(nearest);
  if (span.nearest_m == 0.0) return span;
  const double middle_rad = turn_rad(forward, (low + high) / 2.0);
  double left_rad = 0.0, right_rad = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
    const double beside_rad = std::remainder(turn_rad(forward, at) - middle_rad, 2.0 * core::kPi);
    left_rad = std::min(left_rad, beside_rad);
    right_rad = std::max(right_rad, beside_rad);
  }
  span.left_rad = middle_rad + left_rad;
  span.right_rad = middle_rad + right_rad;
  return span;
}

}  // namespace

ProfileCaster::ProfileCaster(const World& world, const Sampling& sampling)
    : world_(world), sampling_(sampling), tables_(world) {
  if (!world.solids.others.empty()) rays_ = std::make_unique<RayCaster>(world, sampling);
  if (world.surfaces->terrain() == nullptr)
    throw core::InternalError("slices without a ground to cut");
  const terrain::HeightField& ground = *world.surfaces->terrain();
  const auto [low, high] = std::minmax_element(ground.height_m.begin(), ground.height_m.end());
  lowest_m_ = *low;
  highest_m_ = *high;
}

std::vector<Slice> ProfileCaster::level_slices(const sensors::AntennaFrame& antenna,
                                               const FanSums& sums) const {
  const glm::dvec2 forward = horizontal(antenna.forward);
  const int count = sums.sub_columns * sampling_.slices_per_sub_column;
  const double width_rad = sums.step_rad / sampling_.slices_per_sub_column;
  std::vector<Slice> slices;
  slices.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double azimuth_rad = sums.first_azimuth_rad + (i + 0.5) * width_rad;
    const glm::dvec2 along = horizontal(
        sensors::direction(antenna, azimuth_rad, world_.sensor.antenna.boresight_elevation_rad,
                           world_.sensor.scan.surface));
    slices.push_back({along, turn_rad(forward, along), width_rad});
  }
  return slices;
}

// Evenly over all headings in which some elevation of the beam sees the fan.
std::vector<Slice> ProfileCaster::tilted_slices(const sensors::AntennaFrame& antenna,
                                                const FanSums& sums) const {
  const glm::dvec2 forward = horizontal(antenna.forward);
  const sensors::Antenna& beams = world_.sensor.antenna;
  const double reach_rad = sensors::reach_rad(beams.elevation);
  double left_rad = core::kPi, right_rad = -core::kPi;
  constexpr int kSteps = 16;
  for (int e = 0; e <= kSteps; ++e) {
    const double elevation_rad =
        std::clamp(beams.boresight_elevation_rad + reach_rad * (2.0 * e / kSteps - 1.0),
                   -core::kPi / 2, core::kPi / 2);
    for (int a = 0; a <= kSteps; ++a) {
      const double azimuth_rad =
          sums.first_azimuth_rad + sums.sub_columns * sums.step_rad * a / kSteps;
      const double heading_rad =
          turn_rad(forward, horizontal(sensors::direction(antenna, azimuth_rad, elevation_rad,
                                                          world_.sensor.scan.surface)));
      left_rad = std::min(left_rad, heading_rad);
      right_rad = std::max(right_rad, heading_rad);
    }
  }
  const double wanted_rad = sums.step_rad / sampling_.slices_per_sub_column;
  const int count = static_cast<int>(std::ceil((right_rad - left_rad) / wanted_rad)) + 1;
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

void ProfileCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope, FanSums& sums,
                         SightLines& sight) const {
  lay_out_fan(world_, sampling_, with_cscope, sums);
  const double sensor_m = antenna.position_m.z;
  const PathLossTable path_loss(world_.attenuation, sensor_m, std::min(sensor_m, lowest_m_) - 10.0,
                                std::max(sensor_m, highest_m_) + 300.0);
  const bool level =
      world_.sensor.scan.surface == sensors::ScanSurface::plane && antenna.up.z > kLevelCosine;
  if (!level && rays_) {
    rays_->cast(antenna, with_cscope, sums, sight);
    return;
  }
  const std::vector<Slice> slices =
      level ? level_slices(antenna, sums) : tilted_slices(antenna, sums);
  // About a column's worth: fewer candidates, or fewer lists that an edge is in.
  const auto tile = static_cast<std::size_t>(
      std::clamp(sampling_.sub_columns * sampling_.slices_per_sub_column, 4, 16));
  std::vector<double> headings_rad;
  for (const Slice& slice : slices) headings_rad.push_back(slice.heading_rad);
  const EdgeIndex edges(world_, {antenna.position_m.x, antenna.position_m.y},
                        horizontal(antenna.forward), headings_rad, tile);
  const std::vector<std::uint32_t> ray_groups =
      level ? groups_for_rays(antenna, slices, sums) : std::vector<std::uint32_t>{};
  sight.clear.assign(sight.to_m.size(), kAskRays);
  const PointsOfSlices points =
      sort_points(slices, antenna.position_m, horizontal(antenna.forward), sight);
  // Below it nothing comes back; a tilted antenna looks anywhere.
  constexpr double kSteepest = 1e9;
  const sensors::Antenna& beams = world_.sensor.antenna;
  const double lowest_rad =
      std::max(beams.boresight_elevation_rad - sensors::reach_rad(beams.elevation) - kLeaning_rad,
               -std::atan(kSteepest));
  const Frame frame{antenna,
                    ray_groups,
                    path_loss,
                    slices,
                    edges,
                    points,
                    sight.clear.data(),
                    tile,
                    level ? std::tan(lowest_rad) : -kSteepest,
                    with_cscope};
  if (level)
    cast_level(frame, sums);
  else
    cast_across(frame, sums);
  sums.slices = slices.size() - ray_groups.size() * kGroupAzimuths *
                                    static_cast<std::size_t>(sampling_.slices_per_sub_column);
  if (!ray_groups.empty()) rays_->cast_groups(antenna, with_cscope, ray_groups, sums);
  look_along_rays(*world_.surfaces, antenna.position_m, sight);
}

// Groups whose slices some box may meet. A level antenna may lean by 1 mrad, which moves a point by
// the tangent of its elevation times as much in azimuth: a sub-column and 2 mrad beside it cover
// elevations to 60 deg.
std::vector<std::uint32_t> ProfileCaster::groups_for_rays(const sensors::AntennaFrame& antenna,
                                                          const std::vector<Slice>& slices,
                                                          const FanSums& sums) const {
  std::vector<bool> wanted(static_cast<std::size_t>(sums.sub_columns / kGroupAzimuths), false);
  const glm::dvec2 sensor_m(antenna.position_m.x, antenna.position_m.y);
  const glm::dvec2 forward = horizontal(antenna.forward);
  const auto per_sub = static_cast<std::size_t>(sampling_.slices_per_sub_column);
  for (const terrain::Box_m& box : world_.solids.others) {
    const HeadingSpan span = headings_of(box, sensor_m, forward);
    if (span.nearest_m > world_.sensor.range.maximum_m()) continue;
    const auto before = [](const Slice& slice, double heading_rad) {
      return slice.heading_rad < heading_rad;
    };
    const auto slice_at = [&](double heading_rad) {
      return static_cast<std::size_t>(
          std::lower_bound(slices.begin(), slices.end(), heading_rad, before) - slices.begin());
    };
    const std::size_t first = slice_at(span.left_rad - sums.step_rad - kLeaning_rad);
    const std::size_t last = slice_at(span.right_rad + sums.step_rad + kLeaning_rad);
    for (std::size_t i = first; i < last; ++i) wanted[i / per_sub / kGroupAzimuths] = true;
  }
  std::vector<std::uint32_t> groups;
  for (std::size_t g = 0; g < wanted.size(); ++g)
    if (wanted[g]) groups.push_back(static_cast<std::uint32_t>(g));
  return groups;
}

void ProfileCaster::cast_level(const Frame& frame, FanSums& sums) const {
  const std::size_t count = frame.slices.size();
  const auto cells = static_cast<std::size_t>(sums.cells),
             rows = static_cast<std::size_t>(sums.rows);
  const auto per_sub = static_cast<std::size_t>(sampling_.slices_per_sub_column);
  std::mutex totals;
  core::parallel_for(static_cast<std::size_t>(sums.sub_columns), [&](std::size_t sub) {
    thread_local VisiblePieces visible;
    thread_local SweepScratch scratch;
    thread_local std::vector<double> range_bins, row_bins;
    SlicePower power(world_, frame.antenna, tables_, frame.path_loss);
    SliceSweep sweep(world_, frame.antenna.position_m, frame.edges, frame.dark_below, scratch);
    SliceBins bins;
    range_bins.assign(cells + 1, 0.0);
    bins.range_W_per_rad = range_bins.data();
    if (frame.with_cscope) {
      row_bins.assign(rows + 2, 0.0);
      bins.elevation_W_m3_per_rad = row_bins.data();
    }
    bins.weight = 1.0 / static_cast<double>(per_sub);
    std::uint64_t hits = 0;
    const bool left_to_rays = std::binary_search(frame.ray_groups.begin(), frame.ray_groups.end(),
                                                 static_cast<std::uint32_t>(sub / kGroupAzimuths));
    for (std::size_t i = sub * per_sub; !left_to_rays && i < std::min((sub + 1) * per_sub, count);
         ++i) {
      const Slice& slice = frame.slices[i];
      const auto empty = [&](VisiblePieces& pieces) {
        hits += static_cast<std::uint64_t>(pieces.count);
        power.add(slice, pieces, bins);
      };
      sweep.run(slice, frame.edges.candidates(i / frame.tile), world_.sensor.range.maximum_m(),
                visible, empty, frame.sights(i));
      empty(visible);
    }
    std::copy_n(range_bins.begin(), cells, &sums.range_W_per_rad[sub * cells]);
    if (frame.with_cscope)
      std::copy_n(row_bins.begin() + 1, rows, &sums.elevation_W_m3_per_rad[sub * rows]);
    const std::lock_guard<std::mutex> lock(totals);  // whole numbers: their sum has no order
    sums.hits += hits;
    sums.blanked += power.blanked();
  });
}

// Neighbouring slices share sub-columns here. A fixed number of parts, each with sums of its own
// that are added in their order, keeps the result the same for any number of threads.
void ProfileCaster::cast_across(const Frame& frame, FanSums& sums) const {
  constexpr std::size_t kParts = 16;
  const auto cells = static_cast<std::size_t>(sums.cells),
             rows = static_cast<std::size_t>(sums.rows);
  const std::size_t count = frame.slices.size();
  struct Part {
    std::vector<double> range_W_per_rad, elevation_W_m3_per_rad;
    std::uint64_t hits = 0, blanked = 0;
  };
  std::vector<Part> parts(kParts);
  const auto subs = static_cast<std::size_t>(sums.sub_columns);
  core::parallel_for(kParts, [&](std::size_t p) {
    thread_local VisiblePieces visible;
    thread_local SweepScratch scratch;
    Part& part = parts[p];
    part.range_W_per_rad.assign(subs * cells, 0.0);
    part.elevation_W_m3_per_rad.assign(subs * rows, 0.0);
    SlicePower power(world_, frame.antenna, tables_, frame.path_loss);
    SliceSweep sweep(world_, frame.antenna.position_m, frame.edges, frame.dark_below, scratch);
    SliceBins bins;
    bins.range_W_per_rad = part.range_W_per_rad.data();
    if (frame.with_cscope) bins.elevation_W_m3_per_rad = part.elevation_W_m3_per_rad.data();
    bins.across = true;
    bins.first_azimuth_rad = sums.first_azimuth_rad;
    bins.step_rad = sums.step_rad;
    bins.sub_columns = sums.sub_columns;
    for (std::size_t i = count * p / kParts; i < count * (p + 1) / kParts; ++i) {
      const Slice& slice = frame.slices[i];
      bins.weight = slice.width_rad / sums.step_rad;
      const auto empty = [&](VisiblePieces& pieces) {
        part.hits += static_cast<std::uint64_t>(pieces.count);
        power.add(slice, pieces, bins);
      };
      sweep.run(slice, frame.edges.candidates(i / frame.tile), world_.sensor.range.maximum_m(),
                visible, empty, frame.sights(i));
      empty(visible);
    }
    part.blanked = power.blanked();
  });
  core::parallel_for(subs, [&](std::size_t sub) {
    const auto gather = [&](std::vector<double>& to, std::vector<double> Part::*from,
                            std::size_t bins) {
      for (std::size_t b = sub * bins; b < (sub + 1) * bins; ++b) {
        to[b] = 0.0;
        for (const Part& part : parts) to[b] += (part.*from)[b];
      }
    };
    gather(sums.range_W_per_rad, &Part::range_W_per_rad, cells);
    gather(sums.elevation_W_m3_per_rad, &Part::elevation_W_m3_per_rad, rows);
  });
  for (const Part& part : parts) {
    sums.hits += part.hits;
    sums.blanked += part.blanked;
  }
}

}  // namespace fanbeam::renderer
