#include "renderer/casting/ray_kernel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/random.h"
#include "renderer/casting/deposit.h"

namespace fanbeam::renderer {
namespace {

using terrain::RayPacket;

// Silhouettes against the sky are halved this often beyond the refinement depth: a C-scope row
// above the horizon that is lit by half a ray interval shows at once, and there are few of them.
constexpr int kHorizonLevels = 3;

// Rays one packet sends, in the antenna's angles.
template <int N>
struct Lanes {
  alignas(64) double cos_elevation[N];
  alignas(64) double sin_elevation[N];
  alignas(64) double cos_azimuth[N];
  alignas(64) double sin_azimuth[N];
  alignas(64) int active[N];
};

// Direction and its derivative by elevation, as weights of the antenna's axes.
struct Axes {
  double forward, right, up;
};
inline Axes direction_weights(bool cone, double ce, double se, double ca, double sa) {
  return cone ? Axes{ca * ce, sa, ca * se} : Axes{ce * ca, ce * sa, se};
}
inline Axes elevation_derivative(bool cone, double ce, double se, double ca, double sa) {
  return cone ? Axes{-ca * se, 0.0, ca * ce} : Axes{-se * ca, -se * sa, ce};
}

inline Axes azimuth_derivative(bool cone, double ce, double se, double ca, double sa) {
  return cone ? Axes{-sa * ce, ca, -sa * se} : Axes{-ce * sa, ce * ca, 0.0};
}

// A low-discrepancy place inside the sub-column for ray `index`: multiples of the golden ratio,
// shifted from sub-column to sub-column by another irrational so that neighbours do not repeat each
// other.
inline double dither(std::uint32_t index, int sub_column) {
  // Fractions as 32-bit integers wrap round by themselves: 0.6180339887 and 0.7548776662 times
  // 2^32.
  const std::uint32_t value =
      index * 2654435769U + static_cast<std::uint32_t>(sub_column) * 3242174889U;
  return static_cast<double>(value) * 0x1p-32;
}

struct SubColumn {
  double centre_rad, cosine, sine, step_rad;

  double offset_rad(double place) const { return step_rad * (place - 0.5); }

  // Cosine and sine at `place` in [0, 1) of the sub-column; third order in a width below 5 mrad
  // leaves 2e-8.
  void at(double place, double& cos_azimuth, double& sin_azimuth) const {
    const double d = offset_rad(place);
    cos_azimuth = cosine - sine * d - cosine * d * d / 2;
    sin_azimuth = sine + cosine * d - sine * d * d / 2;
  }
};

template <int N>
class GroupCaster {
 public:
  GroupCaster(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
              std::vector<RayPacket<N>>* record)
      : frame_(frame),
        group_(group),
        scratch_(scratch),
        sums_(sums),
        record_(record),
        cone_(frame.world.sensor.scan.surface == sensors::ScanSurface::cone),
        level_(!cone_ && frame.antenna.up.z > kLevelCosine),
        gap_limit_m_(frame.sampling.gap_cells * std::max(1.0, 1.0 / frame.sampling.rays_per_cell) *
                     frame.world.sensor.range.cell_m) {
    for (int a = 0; a < kGroupAzimuths; ++a) {
      const double centre =
          sums.first_azimuth_rad + (kGroupAzimuths * group + a + 0.5) * sums.step_rad;
      columns_[a] = {centre, std::cos(centre), std::sin(centre), sums.step_rad};
    }
  }

  void run() {
    frame_.fan.place(frame_.antenna, columns_[0].centre_rad,
                     columns_[kGroupAzimuths - 1].centre_rad, scratch_.edges);
    if (scratch_.edges.size() < 2) return;
    if (frame_.sampling.jittered_passes > 0) {
      for (int pass = 0; pass < frame_.sampling.jittered_passes; ++pass) {
        cast_fan(pass);
        lose_in_rain_cells();
        for (int a = 0; a < kGroupAzimuths; ++a) deposit_points(a);
      }
      return;
    }
    cast_fan(0);
    for (int level = 0; level < frame_.sampling.refinement_depth + kHorizonLevels; ++level)
      if (!refine(level >= frame_.sampling.refinement_depth)) break;
    lose_in_rain_cells();
    for (int a = 0; a < kGroupAzimuths; ++a) {
      if (frame_.sampling.deposit_intervals)
        deposit_intervals(a);
      else
        deposit_points(a);
    }
  }

 private:
  static constexpr int kRows = N / kGroupAzimuths;

  void cast_fan(int pass);
  bool refine(bool horizon_only);
  bool wants_ray_between(const CastRay& below, const CastRay& above, bool horizon_only) const;
  void cast_requests();
  void lose_in_rain_cells();
  void aim(Lanes<N>& lanes, int lane, int azimuth, double place, double cos_elevation,
           double sin_elevation) const;
  void send(Lanes<N>& lanes, RayPacket<N>& packet);
  // `rays` gets all N lanes, the inactive ones as sky.
  void shade(const Lanes<N>& lanes, const RayPacket<N>& packet, const double* elevation_rad,
             CastRay* rays);
  void deposit_intervals(int azimuth);
  void deposit_points(int azimuth);
  double end_of_interval_m(const CastRay& ray, const CastRay* neighbour, double edge_rad) const;
  void add(int azimuth, double near_m, double far_m, double low_rad, double high_rad,
           const CastRay& ray);

  const RayFrame& frame_;
  int group_;
  RayScratch& scratch_;
  FanSums& sums_;
  std::vector<RayPacket<N>>* record_;
  bool cone_;
  bool level_;          // azimuth alone does not change the range of level ground
  double gap_limit_m_;  // neighbours farther apart than this are not one piece of surface
  std::array<SubColumn, kGroupAzimuths> columns_;
};

template <int N>
inline void fill_packet(const sensors::AntennaFrame& antenna, bool cone, double far_m,
                        const Lanes<N>& lanes, RayPacket<N>& packet) {
  const glm::dvec3 f = antenna.forward;
  const glm::dvec3 r = antenna.right;
  const glm::dvec3 u = antenna.up;
  for (int i = 0; i < N; ++i) {
    const Axes w = direction_weights(cone, lanes.cos_elevation[i], lanes.sin_elevation[i],
                                     lanes.cos_azimuth[i], lanes.sin_azimuth[i]);
    packet.aim(i, antenna.position_m, w.forward * f + w.right * r + w.up * u, far_m);
  }
}

// What the facets that were hit look like, lane by lane. Floats: the normal comes in floats.
template <int N>
struct Facets {
  alignas(64) float x_m[N], y_m[N], z_m[N];
  alignas(64) float sin_grazing[N];  // negative for back faces
  alignas(64) float range_slope[N];
  alignas(64) int upright[N];
};

template <int N>
inline void measure_facets(const sensors::AntennaFrame& antenna, bool cone, const Lanes<N>& lanes,
                           const RayPacket<N>& packet, Facets<N>& facets) {
  const glm::dvec3 f = antenna.forward;
  const glm::dvec3 r = antenna.right;
  const glm::dvec3 u = antenna.up;
  for (int i = 0; i < N; ++i) {
    const Axes w = elevation_derivative(cone, lanes.cos_elevation[i], lanes.sin_elevation[i],
                                        lanes.cos_azimuth[i], lanes.sin_azimuth[i]);
    const float higher_x = static_cast<float>(w.forward * f.x + w.right * r.x + w.up * u.x);
    const float higher_y = static_cast<float>(w.forward * f.y + w.right * r.y + w.up * u.y);
    const float higher_z = static_cast<float>(w.forward * f.z + w.right * r.z + w.up * u.z);
    const float nx = packet.normal_x[i], ny = packet.normal_y[i], nz = packet.normal_z[i];
    const float along =
        nx * packet.direction_x[i] + ny * packet.direction_y[i] + nz * packet.direction_z[i];
    const float square = nx * nx + ny * ny + nz * nz;
    facets.sin_grazing[i] = -along / std::sqrt(square);
    facets.range_slope[i] = (nx * higher_x + ny * higher_y + nz * higher_z) / along;
    facets.upright[i] = nz * nz < 0.49F * square ? 1 : 0;
    facets.x_m[i] = packet.origin_x[i] + packet.direction_x[i] * packet.distance[i];
    facets.y_m[i] = packet.origin_y[i] + packet.direction_y[i] * packet.distance[i];
    facets.z_m[i] = packet.origin_z[i] + packet.direction_z[i] * packet.distance[i];
  }
}
// Points a lane. Where the antenna is tilted, or the scan a cone, a step in azimuth alone would
// change the range of level ground: the elevation then goes along with it, so that rays of one
// interval stay in its cells.
template <int N>
void GroupCaster<N>::aim(Lanes<N>& lanes, int lane, int azimuth, double place, double ce,
                         double se) const {
  const SubColumn& column = columns_[azimuth];
  column.at(place, lanes.cos_azimuth[lane], lanes.sin_azimuth[lane]);
  lanes.cos_elevation[lane] = ce;
  lanes.sin_elevation[lane] = se;
  if (level_) return;
  const auto upwards = [&](const Axes& w) {
    const sensors::AntennaFrame& antenna = frame_.antenna;
    return w.forward * antenna.forward.z + w.right * antenna.right.z + w.up * antenna.up.z;
  };
  const double by_azimuth = upwards(azimuth_derivative(cone_, ce, se, column.cosine, column.sine));
  const double by_elevation =
      upwards(elevation_derivative(cone_, ce, se, column.cosine, column.sine));
  if (std::abs(by_elevation) < 0.1)
    return;  // rolled on its side: range no longer follows elevation
  const double d = -by_azimuth / by_elevation * column.offset_rad(place);
  lanes.cos_elevation[lane] = ce - se * d - ce * d * d / 2;
  lanes.sin_elevation[lane] = se + ce * d - se * d * d / 2;
}

template <int N>
void GroupCaster<N>::send(Lanes<N>& lanes, RayPacket<N>& packet) {
  const sensors::RangeGate& gate = frame_.world.sensor.range;
  fill_packet(frame_.antenna, cone_, gate.maximum_m() + 2.0 * gate.cell_m, lanes, packet);
  if (record_ != nullptr) {
    for (int i = 0; i < N; ++i)
      if (lanes.active[i] == 0)
        packet.near[i] = packet.distance[i] * 2.0F;  // an empty interval: never hits
    record_->push_back(packet);
  }
  frame_.world.surfaces->intersect(lanes.active, packet);
}

template <int N>
void GroupCaster<N>::shade(const Lanes<N>& lanes, const RayPacket<N>& packet,
                           const double* elevation_rad, CastRay* rays) {
  Facets<N> facets;
  measure_facets(frame_.antenna, cone_, lanes, packet, facets);
  const terrain::RayScene& surfaces = *frame_.world.surfaces;
  const double boresight_rad = frame_.world.sensor.antenna.boresight_elevation_rad;
  for (int i = 0; i < N; ++i) {
    CastRay& ray = rays[i];
    ray = CastRay{};
    ray.elevation_rad = elevation_rad[i];
    if (lanes.active[i] == 0) continue;
    ++scratch_.ray_count;
    if (packet.geometry[i] == terrain::kNoHit) continue;
    ++scratch_.hit_count;
    ray.range_m = packet.distance[i];
    // Walls and roofs of one mesh do not share intervals.
    ray.surface = 2 * packet.geometry[i] + (facets.upright[i] != 0 ? 1U : 0U);
    const double sin_grazing = static_cast<double>(facets.sin_grazing[i]);
    if (sin_grazing <= 0.0 || ray.range_m <= 0.0F) continue;
    ray.range_slope = facets.range_slope[i];
    const double range_m = static_cast<double>(ray.range_m);
    const terrain::MaterialId material =
        surfaces.material(packet.geometry[i], packet.primitive[i],
                          static_cast<double>(facets.x_m[i]), static_cast<double>(facets.y_m[i]));
    const double jacobian = cone_ ? lanes.cos_azimuth[i] : 1.0;  // ray_caster.h says why not cos(e)
    ray.density_W_per_rad2 = static_cast<float>(
        frame_.radar_constant_W_m2 * frame_.nrcs[material].sigma0_over_sine(sin_grazing) *
        frame_.elevation_gain(elevation_rad[i] - boresight_rad) *
        frame_.path_loss.two_way_factor(static_cast<double>(facets.z_m[i]), range_m) * jacobian /
        (range_m * range_m));
  }
}

template <int N>
void GroupCaster<N>::cast_fan(int pass) {
  const std::vector<double>& edges = scratch_.edges;
  const int count = static_cast<int>(edges.size()) - 1;
  const bool jittered = frame_.sampling.jittered_passes > 0;
  const core::RandomKey key{frame_.sampling.seed, core::kStreamReferenceJitter, 0};
  Lanes<N> lanes;
  RayPacket<N> packet;
  double elevation_rad[N];
  CastRay cast[N];
  for (auto& rays : scratch_.rays) rays.resize(static_cast<std::size_t>(count));
  for (int first = 0; first < count; first += kRows) {
    for (int row = 0; row < kRows; ++row) {
      const int j = std::min(first + row, count - 1);
      const double middle_rad = (edges[j] + edges[j + 1]) / 2;
      double ce = std::cos(middle_rad), se = std::sin(middle_rad);
      for (int a = 0; a < kGroupAzimuths; ++a) {
        const int i = row * kGroupAzimuths + a;
        const int sub_column = kGroupAzimuths * group_ + a;
        lanes.active[i] = first + row < count ? -1 : 0;
        elevation_rad[i] = middle_rad;
        double place = dither(static_cast<std::uint32_t>(j), sub_column);
        if (jittered) {
          const std::uint64_t cell =
              static_cast<std::uint64_t>(sub_column) *
                  static_cast<std::uint64_t>(frame_.sampling.jittered_passes) +
              static_cast<std::uint64_t>(pass);
          const auto words = core::random_words(key, cell, static_cast<std::uint32_t>(j));
          place = core::uniform_from(words[0]);
          elevation_rad[i] = edges[j] + core::uniform_from(words[1]) * (edges[j + 1] - edges[j]);
          ce = std::cos(elevation_rad[i]);
          se = std::sin(elevation_rad[i]);
        }
        aim(lanes, i, a, place, ce, se);
      }
    }
    send(lanes, packet);
    shade(lanes, packet, elevation_rad, cast);
    for (int i = 0; i < N && first + i / kGroupAzimuths < count; ++i)
      scratch_.rays[i % kGroupAzimuths][static_cast<std::size_t>(first + i / kGroupAzimuths)] =
          cast[i];
  }
}

template <int N>
bool GroupCaster<N>::wants_ray_between(const CastRay& below, const CastRay& above,
                                       bool horizon_only) const {
  constexpr double kSmallestStep_rad = 1e-5;  // 4 cm at 3.7 km: finer than any surface we model
  if (above.elevation_rad - below.elevation_rad < kSmallestStep_rad) return false;
  const bool sky_below = below.surface == terrain::kNoHit;
  const bool sky_above = above.surface == terrain::kNoHit;
  if (horizon_only || sky_below || sky_above) return sky_below != sky_above;
  return below.surface != above.surface ||
         static_cast<double>(std::abs(above.range_m - below.range_m)) > gap_limit_m_;
}

template <int N>
bool GroupCaster<N>::refine(bool horizon_only) {
  for (int a = 0; a < kGroupAzimuths; ++a) {
    auto& wanted = scratch_.wanted[a];
    wanted.clear();
    const auto& rays = scratch_.rays[a];
    for (std::size_t i = 1; i < rays.size(); ++i)
      if (wants_ray_between(rays[i - 1], rays[i], horizon_only))
        wanted.push_back((rays[i - 1].elevation_rad + rays[i].elevation_rad) / 2);
  }
  // By elevation, so that a packet's rays stay close together.
  scratch_.requests.clear();
  std::array<std::size_t, kGroupAzimuths> next{};
  for (;;) {
    int lowest = -1;
    for (int a = 0; a < kGroupAzimuths; ++a) {
      if (next[a] < scratch_.wanted[a].size() &&
          (lowest < 0 || scratch_.wanted[a][next[a]] < scratch_.wanted[lowest][next[lowest]]))
        lowest = a;
    }
    if (lowest < 0) break;
    scratch_.requests.push_back({scratch_.wanted[lowest][next[lowest]++], lowest});
  }
  if (scratch_.requests.empty()) return false;
  cast_requests();
  for (int a = 0; a < kGroupAzimuths; ++a) {
    if (scratch_.refined[a].empty()) continue;
    scratch_.merged.resize(scratch_.rays[a].size() + scratch_.refined[a].size());
    std::merge(
        scratch_.rays[a].begin(), scratch_.rays[a].end(), scratch_.refined[a].begin(),
        scratch_.refined[a].end(), scratch_.merged.begin(),
        [](const CastRay& x, const CastRay& y) { return x.elevation_rad < y.elevation_rad; });
    std::swap(scratch_.rays[a], scratch_.merged);
  }
  return true;
}

template <int N>
void GroupCaster<N>::cast_requests() {
  Lanes<N> lanes;
  RayPacket<N> packet;
  double elevation_rad[N];
  CastRay cast[N];
  for (auto& refined : scratch_.refined) refined.clear();
  const std::size_t count = scratch_.requests.size();
  for (std::size_t first = 0; first < count; first += N) {
    for (std::size_t i = 0; i < N; ++i) {
      const auto& request = scratch_.requests[std::min(first + i, count - 1)];
      lanes.active[i] = first + i < count ? -1 : 0;
      elevation_rad[i] = request.elevation_rad;
      // Keyed by the elevation itself: the same ray gets the same azimuth whatever was refined
      // before it.
      const auto index = static_cast<std::uint32_t>((request.elevation_rad + core::kPi) * 1e7);
      aim(lanes, static_cast<int>(i), request.azimuth,
          dither(index, kGroupAzimuths * group_ + request.azimuth), std::cos(request.elevation_rad),
          std::sin(request.elevation_rad));
    }
    send(lanes, packet);
    shade(lanes, packet, elevation_rad, cast);
    for (std::size_t i = 0; i < N && first + i < count; ++i)
      scratch_.refined[scratch_.requests[first + i].azimuth].push_back(cast[i]);
  }
}

// A pass of its own, and only in scenes with rain cells. Every ray is taken through the middle of
// its sub-column: it crosses the walls of a cell up to half a sub-column away from its true place.
template <int N>
void GroupCaster<N>::lose_in_rain_cells() {
  if (!frame_.world.rain_cells) return;
  const sensors::AntennaFrame& antenna = frame_.antenna;
  for (int a = 0; a < kGroupAzimuths; ++a) {
    for (CastRay& ray : scratch_.rays[a]) {
      if (!(ray.density_W_per_rad2 > 0.0F)) continue;
      const Axes w =
          direction_weights(cone_, std::cos(ray.elevation_rad), std::sin(ray.elevation_rad),
                            columns_[a].cosine, columns_[a].sine);
      const glm::dvec3 direction =
          w.forward * antenna.forward + w.right * antenna.right + w.up * antenna.up;
      ray.density_W_per_rad2 *= static_cast<float>(frame_.world.rain_cells->two_way_power_factor(
          antenna.position_m, antenna.position_m + static_cast<double>(ray.range_m) * direction));
    }
  }
}

template <int N>
double GroupCaster<N>::end_of_interval_m(const CastRay& ray, const CastRay* neighbour,
                                         double edge_rad) const {
  const double range_m = static_cast<double>(ray.range_m);
  const double limit_m = gap_limit_m_;
  if (neighbour != nullptr && neighbour->surface == ray.surface &&
      std::abs(static_cast<double>(neighbour->range_m) - range_m) <= limit_m)
    return (range_m + static_cast<double>(neighbour->range_m)) / 2;
  const double denominator =
      1.0 + static_cast<double>(ray.range_slope) * (edge_rad - ray.elevation_rad);
  const double along_plane_m = denominator > 0.1 ? range_m / denominator - range_m : limit_m;
  return range_m + std::clamp(along_plane_m, -limit_m / 2, limit_m / 2);
}

template <int N>
void GroupCaster<N>::add(int azimuth, double near_m, double far_m, double low_rad, double high_rad,
                         const CastRay& ray) {
  const sensors::Sensor& sensor = frame_.world.sensor;
  const auto sub_column = static_cast<std::size_t>(kGroupAzimuths * group_ + azimuth);
  const double power = static_cast<double>(ray.density_W_per_rad2) * (high_rad - low_rad);
  const double from = (near_m - sensor.range.minimum_m) / sensor.range.cell_m;
  const double to = (far_m - sensor.range.minimum_m) / sensor.range.cell_m;
  deposit(from, to, power,
          &sums_.range_W_per_rad[sub_column * static_cast<std::size_t>(sums_.cells)], sums_.cells);
  const double range_m = static_cast<double>(ray.range_m);
  if (range_m < sensor.range.minimum_m) ++scratch_.blanked_count;
  if (!frame_.with_cscope || range_m < sensor.range.minimum_m ||
      range_m >= sensor.range.maximum_m())
    return;
  const double per_rad = sensor.display.cscope_rows / sensor.display.cscope_span_rad;
  deposit((sensor.display.cscope_top_rad - high_rad) * per_rad,
          (sensor.display.cscope_top_rad - low_rad) * per_rad, power * range_m * range_m * range_m,
          &sums_.elevation_W_m3_per_rad[sub_column * static_cast<std::size_t>(sums_.rows)],
          sums_.rows);
}

template <int N>
void GroupCaster<N>::deposit_intervals(int azimuth) {
  const std::vector<CastRay>& rays = scratch_.rays[azimuth];
  const std::size_t count = rays.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CastRay& ray = rays[i];
    if (!(ray.density_W_per_rad2 > 0.0F)) continue;
    const CastRay* below = i > 0 ? &rays[i - 1] : nullptr;
    const CastRay* above = i + 1 < count ? &rays[i + 1] : nullptr;
    const double low_rad =
        below != nullptr ? (below->elevation_rad + ray.elevation_rad) / 2 : scratch_.edges.front();
    const double high_rad =
        above != nullptr ? (above->elevation_rad + ray.elevation_rad) / 2 : scratch_.edges.back();
    const double a_m = end_of_interval_m(ray, below, low_rad);
    const double b_m = end_of_interval_m(ray, above, high_rad);
    add(azimuth, std::min(a_m, b_m), std::max(a_m, b_m), low_rad, high_rad, ray);
  }
}

template <int N>
void GroupCaster<N>::deposit_points(int azimuth) {
  const std::vector<CastRay>& rays = scratch_.rays[azimuth];
  const double share = 1.0 / std::max(1, frame_.sampling.jittered_passes);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CastRay ray = rays[i];
    if (!(ray.density_W_per_rad2 > 0.0F)) continue;
    ray.density_W_per_rad2 *= static_cast<float>(share);
    const double range_m = static_cast<double>(ray.range_m);
    add(azimuth, range_m, range_m, scratch_.edges[i], scratch_.edges[i + 1], ray);
  }
}

}  // namespace

// Everything is inlined into these two, so that the whole loop is compiled for the processor it
// runs on.
FANBEAM_HOT FANBEAM_INLINE_ALL void cast_group(const RayFrame& frame, int group,
                                               RayScratch& scratch, FanSums& sums,
                                               std::vector<RayPacket<8>>* record) {
  GroupCaster<8>(frame, group, scratch, sums, record).run();
}
FANBEAM_HOT FANBEAM_INLINE_ALL void cast_group(const RayFrame& frame, int group,
                                               RayScratch& scratch, FanSums& sums,
                                               std::vector<RayPacket<16>>* record) {
  GroupCaster<16>(frame, group, scratch, sums, record).run();
}

}  // namespace fanbeam::renderer
