#include "renderer/casting/ray_kernel.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/random.h"
#include "core/stop.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/echo_density.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/gap_finder.h"
#include "renderer/casting/packet_sender.h"
#include "renderer/casting/ray_aim.h"
#include "renderer/casting/ray_batch.h"

namespace fanbeam::renderer {
namespace {

using terrain::RayPacket;

// Silhouettes against the sky, and borders of materials, are halved this often beyond the refinement
// depth: a C-scope row above the horizon that is lit by half a ray interval shows at once, and there are
// few of them.
constexpr int kHorizonLevels = 3;

// Borders of materials are sought to this part of a C-scope row: close by a range cell covers several
// rows, and the mean of many sub-columns, each a range cell off, would smear the brighter ground over them.
constexpr double kEdgeRows = 0.25;

bool is_cone(const World& world) { return world.sensor.scan.surface == sensors::ScanSurface::cone; }

double gap_limit_m(const RayFrame& frame) {
  return frame.sampling.gap_cells * std::max(1.0, 1.0 / frame.sampling.rays_per_cell) *
         frame.world.sensor.range.cell_m;
}

template <int N>
class GroupCaster {
 public:
  GroupCaster(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
              std::vector<RayPacket<N>>* record)
      : frame_(frame),
        group_(group),
        scratch_(scratch),
        sums_(sums),
        sender_(frame.world.surfaces(), frame.world.sensor.range, frame.antenna.position_m, record),
        aim_(frame.antenna, is_cone(frame.world),
             azimuths_are_upright(frame.antenna, frame.world.sensor.scan.surface)),
        echo_(frame.world, frame.path_loss, frame.antenna.position_m),
        gap_limit_m_(gap_limit_m(frame)) {
    for (int a = 0; a < kGroupAzimuths; ++a) {
      const double centre_rad =
          sums.first_azimuth_rad + (kGroupAzimuths * group + a + 0.5) * sums.step_rad;
      columns_[a] = {centre_rad, std::cos(centre_rad), std::sin(centre_rad), sums.step_rad};
      elevation_share_[a] = elevation_place(sub_column(a), frame.places.first_elevation);
    }
  }

  void run() {
    frame_.fan.place(frame_.antenna, columns_[0].centre_rad,
                     columns_[kGroupAzimuths - 1].centre_rad, scratch_.edges);
    if (scratch_.edges.size() < 2) {
      clear_sums();
    } else if (frame_.sampling.jittered_passes > 0) {
      clear_sums();
      for (int pass = 0; pass < frame_.sampling.jittered_passes; ++pass) {
        cast_jittered_fan(pass);
        lose_in_rain_cells();
        deposit_points();
      }
    } else {
      cast_fan();
      if (frame_.sampling.deposit_intervals) {
        refine();
        lose_in_rain_cells();
        deposit_intervals();
      } else {
        lose_in_rain_cells();
        clear_sums();
        deposit_points();
      }
    }
  }

 private:
  int rows() const { return static_cast<int>(scratch_.edges.size()) - 1; }
  int sub_column(int azimuth) const { return kGroupAzimuths * group_ + azimuth; }
  double* range_bins(int azimuth) const {
    return sums_.range_W_per_rad.data() +
           static_cast<std::size_t>(sub_column(azimuth)) * static_cast<std::size_t>(sums_.cells);
  }
  double* elevation_bins(int azimuth) const {
    return sums_.elevation_W_m3_per_rad.data() +
           static_cast<std::size_t>(sub_column(azimuth)) * static_cast<std::size_t>(sums_.rows);
  }
  void clear_sums() {
    std::fill_n(range_bins(0), kGroupAzimuths * sums_.cells, 0.0);
    std::fill_n(elevation_bins(0), kGroupAzimuths * sums_.rows, 0.0);
  }

  // Fills batch after batch by place(first, count), casts and shades `count` new rays of the chain. A
  // group may take a second: a request to stop is seen between two batches.
  template <class Place>
  void cast_rays(int count, const Place& place) {
    const int first = scratch_.rays.append(count);
    for (int done = 0; done < count; done += kBatchRays) {
      core::throw_if_stopped();
      const int filled = std::min(kBatchRays, count - done);
      place(done, filled);
      batch_.close(filled);
      aim_.point(batch_);
      sender_.cast(batch_);
      scratch_.hit_count +=
          static_cast<std::uint64_t>(echo_.shade(batch_, first + done, scratch_.rays));
      std::copy_n(batch_.offset_rad, filled, scratch_.rays.offset_rad.data() + first + done);
    }
    scratch_.ray_count += static_cast<std::uint64_t>(count);
  }
  double gain_at(double elevation_rad) const {
    return frame_.elevation_gain(elevation_rad -
                                 frame_.world.sensor.antenna.boresight_elevation_rad);
  }

  void cast_fan() {
    scratch_.rays.clear();
    const double* const edges = scratch_.edges.data();
    for (int i = 0; i < kBatchRays; ++i) batch_.set_column(i, columns_[i % kGroupAzimuths]);
    cast_rays(kGroupAzimuths * rows(), [&](int first, int count) {
      for (int lane = 0; lane < count; lane += kGroupAzimuths) {
        const int row = (first + lane) / kGroupAzimuths;
        for (int a = 0; a < kGroupAzimuths; ++a) {
          const double elevation_rad =
              edges[row] + elevation_share_[a] * (edges[row + 1] - edges[row]);
          batch_.elevation_rad[lane + a] = elevation_rad;
          batch_.gain[lane + a] = gain_at(elevation_rad);
          batch_.offset_rad[lane + a] = columns_[a].offset_rad(
              frame_.places.azimuth_place(static_cast<std::uint32_t>(row), sub_column(a)));
        }
      }
    });
    scratch_.rays.link_fan();
  }

  void cast_jittered_fan(int pass) {
    scratch_.rays.clear();
    const double* const edges = scratch_.edges.data();
    const core::RandomKey key{frame_.sampling.seed, core::kStreamReferenceJitter, 0};
    const auto passes = static_cast<std::uint64_t>(frame_.sampling.jittered_passes);
    for (int i = 0; i < kBatchRays; ++i) batch_.set_column(i, columns_[i % kGroupAzimuths]);
    cast_rays(kGroupAzimuths * rows(), [&](int first, int count) {
      for (int lane = 0; lane < count; ++lane) {
        const int row = (first + lane) / kGroupAzimuths, azimuth = lane % kGroupAzimuths;
        const std::uint64_t cell = static_cast<std::uint64_t>(sub_column(azimuth)) * passes +
                                   static_cast<std::uint64_t>(pass);
        const auto words = core::random_words(key, cell, static_cast<std::uint32_t>(row));
        const double share = core::uniform_from(words[1]);
        batch_.elevation_rad[lane] = edges[row] + share * (edges[row + 1] - edges[row]);
        batch_.gain[lane] = gain_at(batch_.elevation_rad[lane]);
        batch_.offset_rad[lane] = columns_[azimuth].offset_rad(core::uniform_from(words[0]));
      }
    });
    scratch_.rays.link_fan();
  }

  void refine() {
    const sensors::Display& display = frame_.world.sensor.display;
    const GapFinder finder(gap_limit_m_, kEdgeRows * display.cscope_span_rad / display.cscope_rows);
    const int depth = frame_.sampling.refinement_depth;
    finder.search_fan(scratch_.rays, depth == 0, scratch_.marks, scratch_.gaps);
    for (int level = 0; level < depth + kHorizonLevels && !scratch_.gaps.empty(); ++level) {
      const int first = scratch_.rays.count();
      fill_gaps();
      finder.search_halves(scratch_.rays, level + 1 >= depth, scratch_.gaps, first,
                           scratch_.halves);
      std::swap(scratch_.gaps, scratch_.halves);
    }
  }

  // A ray in the middle of every gap, in the azimuth of the one below: what differs from there may differ
  // in azimuth alone, and a ray in an azimuth of its own would take from the share of a narrow thing that
  // was met, never from one that was missed. Gaps are nearly in order of elevation, so that a packet's rays
  // stay close together.
  void fill_gaps() {
    RayChain& rays = scratch_.rays;
    const std::vector<RayGap>& gaps = scratch_.gaps;
    const int first = rays.count();
    cast_rays(static_cast<int>(gaps.size()), [&](int done, int count) {
      for (int lane = 0; lane < count; ++lane) {
        const RayGap& gap = gaps[static_cast<std::size_t>(done + lane)];
        const double elevation_rad = (rays.elevation_rad[static_cast<std::size_t>(gap.below)] +
                                      rays.elevation_rad[static_cast<std::size_t>(gap.above)]) /
                                     2;
        batch_.set_column(lane, columns_[azimuth_of(gap.below)]);
        batch_.elevation_rad[lane] = elevation_rad;
        batch_.gain[lane] = gain_at(elevation_rad);
        batch_.offset_rad[lane] = rays.offset_rad[static_cast<std::size_t>(gap.below)];
      }
    });
    for (std::size_t i = 0; i < gaps.size(); ++i)
      rays.link(gaps[i], first + static_cast<std::int32_t>(i));
  }
  int azimuth_of(std::int32_t ray) const {
    return scratch_.rays.azimuth[static_cast<std::size_t>(ray)];
  }

  // A pass of its own, and only in scenes with rain cells. Every ray is taken through the middle of
  // its sub-column: it crosses the walls of a cell up to half a sub-column away from its true
  // place.
  void lose_in_rain_cells() {
    if (!frame_.world.rain_cells) return;
    const sensors::AntennaFrame& antenna = frame_.antenna;
    RayChain& rays = scratch_.rays;
    for (std::int32_t ray = 0; ray < rays.count(); ++ray) {
      const auto i = static_cast<std::size_t>(ray);
      if (!(rays.density_W_per_rad2[i] > 0.0F)) continue;
      const SubColumn& column = columns_[azimuth_of(ray)];
      const AxisWeights w =
          direction_weights(is_cone(frame_.world), std::cos(rays.elevation_rad[i]),
                            std::sin(rays.elevation_rad[i]), column.cosine, column.sine);
      const glm::dvec3 direction =
          w.forward * antenna.forward + w.right * antenna.right + w.up * antenna.up;
      rays.density_W_per_rad2[i] *=
          static_cast<float>(frame_.world.rain_cells->two_way_power_factor(
              antenna.position_m,
              antenna.position_m + static_cast<double>(rays.range_m[i]) * direction));
    }
  }

  void deposit_intervals() {
    for (int a = 0; a < kGroupAzimuths; ++a) {
      IntervalDeposit deposit(frame_.world.sensor, frame_.with_cscope, gap_limit_m_,
                              scratch_.edges.front(), scratch_.edges.back(), scratch_.bins);
      scratch_.blanked_count += static_cast<std::uint64_t>(deposit.add(scratch_.rays, a));
      scratch_.bins.range.copy_to(range_bins(a));
      if (frame_.with_cscope) scratch_.bins.elevation.copy_to(elevation_bins(a));
    }
  }

  // Every ray of the fan into the cell that it falls in.
  void deposit_points();

  const RayFrame& frame_;
  int group_;
  RayScratch& scratch_;
  FanSums& sums_;
  PacketSender<N> sender_;
  RayAim aim_;
  EchoDensity echo_;
  double gap_limit_m_;
  std::array<SubColumn, kGroupAzimuths> columns_;
  std::array<double, kGroupAzimuths> elevation_share_;
  RayBatch batch_;
};

template <int N>
void GroupCaster<N>::deposit_points() {
  const sensors::RangeGate& gate = frame_.world.sensor.range;
  const sensors::Display& display = frame_.world.sensor.display;
  const double rows_per_rad = display.cscope_rows / display.cscope_span_rad;
  const bool jittered = frame_.sampling.jittered_passes > 0;
  const double share = 1.0 / std::max(1, frame_.sampling.jittered_passes);
  const RayChain& rays = scratch_.rays;
  for (int ray = 0; ray < kGroupAzimuths * rows(); ++ray) {
    const auto i = static_cast<std::size_t>(ray);
    if (!(rays.density_W_per_rad2[i] > 0.0F)) continue;
    const auto row = static_cast<std::size_t>(ray / kGroupAzimuths);
    const double low_rad = scratch_.edges[row], high_rad = scratch_.edges[row + 1];
    const double power =
        static_cast<double>(rays.density_W_per_rad2[i]) * (high_rad - low_rad) * share;
    const auto range_m = static_cast<double>(rays.range_m[i]);
    const double cell = (range_m - gate.minimum_m) / gate.cell_m;
    deposit(cell, cell, power, range_bins(ray % kGroupAzimuths), sums_.cells);
    if (range_m < gate.minimum_m) ++scratch_.blanked_count;
    if (!frame_.with_cscope || range_m < gate.minimum_m || range_m >= gate.maximum_m()) continue;
    // A jittered ray counts where it was sent: spread over its interval it would light rows beyond
    // the edge of what it hit.
    const double top_rad = jittered ? rays.elevation_rad[i] : high_rad;
    const double bottom_rad = jittered ? rays.elevation_rad[i] : low_rad;
    deposit((display.cscope_top_rad - top_rad) * rows_per_rad,
            (display.cscope_top_rad - bottom_rad) * rows_per_rad,
            power * range_m * range_m * range_m, elevation_bins(ray % kGroupAzimuths), sums_.rows);
  }
}

}  // namespace

// Everything is inlined into these two, so that the whole loop is compiled for the processor it
// runs on.
FANBEAM_HOT(void, cast_group,
            (const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
             std::vector<RayPacket<8>>* record),
            (frame, group, scratch, sums, record)) {
  GroupCaster<8>(frame, group, scratch, sums, record).run();
}
FANBEAM_HOT(void, cast_group,
            (const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
             std::vector<RayPacket<16>>* record),
            (frame, group, scratch, sums, record)) {
  GroupCaster<16>(frame, group, scratch, sums, record).run();
}

}  // namespace fanbeam::renderer
