#include "renderer/stages/double_bounce.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/stages/bounce_fan.h"
#include "renderer/stages/bounce_limits.h"

namespace fanbeam::renderer {
namespace {

// Of a strip: packets are fuller, and both have a say in where more rays go (measured,
// docs/performance-notes.md).
constexpr int kPictureColumns = 2;

void add_fan(const BounceFrame& frame, FanSums& sums) {
  const int strips = (sums.sub_columns + frame.sub_columns - 1) / frame.sub_columns;
  std::vector<std::vector<BounceShare>> foreign(static_cast<std::size_t>(strips));
  std::vector<std::uint64_t> cast(foreign.size(), 0);
  core::parallel_for(foreign.size(), [&](std::size_t i) {
    cast[i] = cast_bounce_strip(frame, static_cast<int>(i), sums, foreign[i]);
  });
  for (const std::vector<BounceShare>& shares : foreign)
    for (const BounceShare& share : shares) {
      share.deposit_in(sums);
      if (frame.alone != nullptr) frame.alone->add(share);
    }
  for (const std::uint64_t count : cast) sums.rays += count;
}

// Elevations of the fan, from the sampling of surfaces.
Sampling fan_sampling(const Sampling& surfaces, const BounceSampling& bounces) {
  Sampling sampling = surfaces;
  sampling.rays_per_cell = bounces.rays_per_cell;
  return sampling;
}

BounceSampling bounce_sampling(const sensors::Sensor& sensor, const Sampling& surfaces, int level) {
  BounceSampling sampling;
  sampling.jittered_passes = surfaces.jittered_passes;
  sampling.seed = surfaces.seed;
  sampling.azimuths = kPictureColumns * surfaces.sub_columns;
  sampling.rays_per_cell = surfaces.rays_per_cell;
  if (surfaces.jittered_passes > 0) return sampling;
  // Measured (docs/performance-notes.md): half as many as surfaces have, azimuth first, and few rays
  // before refinement.
  const double per_sub_column = surfaces.caster == CasterKind::profile
                                    ? surfaces.slices_per_sub_column
                                    : surfaces.rays_per_cell;
  const double samples =
      std::ldexp(surfaces.bounce_share * surfaces.sub_columns * per_sub_column / 2.0, level);
  const int azimuths = std::clamp(static_cast<int>(std::lround(1.5 * std::sqrt(samples))), 1, 64);
  sampling.azimuths = kPictureColumns * azimuths;
  sampling.rays_per_cell = 0.375 * samples / azimuths;
  sampling.smallest_change = 0.9 * std::pow(samples, -1.5);
  // Few rays go far apart: a tenth of a frame over a city. Many the library casts better as packets.
  if (samples < 1.5) sampling.mirrored = terrain::Packing::apart;
  sampling.longest_reach_m =
      surfaces.gap_cells / 2 * std::max(1.0, 1.0 / sampling.rays_per_cell) * sensor.range.cell_m;
  return sampling;
}

}  // namespace

DoubleBounce::DoubleBounce(const World& world, const Sampling& sampling, bool noise)
    : world_(world),
      sampling_(sampling),
      shown_W_(shown_powers_W(world.sensor)),
      tracer_(world, noise) {}

void DoubleBounce::add(const sensors::AntennaFrame& antenna, int level, FanSums& sums,
                       BounceFan* alone) const {
  if (alone != nullptr) alone->lay_out(sums);
  if (!tracer_.any()) return;
  const BounceSampling sampling = bounce_sampling(world_.sensor, sampling_, level);
  const ElevationFan fan(world_, fan_sampling(sampling_, sampling), ElevationFan::Nearest::antenna);
  add_fan({world_.sensor, sampling, shown_W_, fan, tracer_, antenna, pass_place(level),
           kPictureColumns * sampling_.sub_columns, alone},
          sums);
}

}  // namespace fanbeam::renderer
