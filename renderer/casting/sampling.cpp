#include "renderer/casting/sampling.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

Sampling reference_sampling(std::uint64_t seed, int passes) {
  Sampling sampling;
  sampling.sub_columns = 16;
  sampling.jittered_passes = passes;
  sampling.rays_per_cell = 8.0;
  sampling.refinement_depth = 0;
  sampling.largest_step_rad = 1.0e-4;
  sampling.deposit_intervals = false;
  sampling.seed = seed;
  return sampling;
}

Sampling sampling_for(double rays_per_cell) {
  Sampling sampling;
  // Azimuth first, while a sub-column keeps a third of a ray per cell, and 0.7 where there are
  // three or more: below that cells share too many rays (docs/performance-notes.md).
  sampling.sub_columns = rays_per_cell < 0.65   ? 1
                         : rays_per_cell < 2.2  ? 2
                         : rays_per_cell < 3.5  ? 3
                         : rays_per_cell < 10.0 ? 4
                         : rays_per_cell < 18.0 ? 6
                                                : 8;
  sampling.rays_per_cell = rays_per_cell / sampling.sub_columns;
  return sampling;
}

Sampling profile_sampling_for(double slices) {
  // The beam is over two columns wide: finer sub-columns than these do not show.
  constexpr int kMostSubColumns = 8;
  const int wanted = std::max(1, static_cast<int>(std::ceil(slices)));
  Sampling sampling;
  sampling.caster = CasterKind::profile;
  sampling.slices_per_sub_column = (wanted + kMostSubColumns - 1) / kMostSubColumns;
  sampling.sub_columns =
      (wanted + sampling.slices_per_sub_column - 1) / sampling.slices_per_sub_column;
  // Few azimuths are left to rays; many slices deserve better ones.
  sampling.rays_per_cell = std::max(1.0, sampling.slices_per_sub_column / 2.0);
  // Between two whole numbers the error of slices falls faster than that of bounces, and costs less.
  sampling.bounce_share = slices / wanted;
  return sampling;
}

Sampling sampling_for(CasterKind caster, double samples) {
  return caster == CasterKind::profile ? profile_sampling_for(samples) : sampling_for(samples);
}

int slices_per_column(const Sampling& sampling) {
  return sampling.sub_columns * sampling.slices_per_sub_column;
}

double rays_per_cell_and_column(const Sampling& sampling) {
  return sampling.sub_columns * sampling.rays_per_cell * std::max(1, sampling.jittered_passes);
}

double samples_in(const Sampling& sampling) {
  return sampling.caster == CasterKind::profile
             ? slices_per_column(sampling) * sampling.bounce_share
             : rays_per_cell_and_column(sampling);
}

double default_samples(CasterKind caster) {
  return caster == CasterKind::profile ? kDefaultSlicesPerColumn : kDefaultRaysPerCell;
}

Sampling default_sampling(CasterKind caster) {
  return sampling_for(caster, default_samples(caster));
}

Sampling finer_in_elevation(const Sampling& sampling, int times) {
  Sampling finer = sampling;
  finer.rays_per_cell *= times;
  finer.gap_cells /= times;
  finer.largest_step_rad /= times;
  finer.largest_step_rows /= times;
  return finer;
}

Sampling refined_sampling(CasterKind caster, double target_grey) {
  // Sub-columns are not refined. With four of slices, where in them things stand is 0.2 to 0.3 grey
  // over a city, with eight 0.05.
  const bool fine = caster == CasterKind::profile && target_grey < 0.5;
  Sampling sampling = sampling_for(caster, fine ? 8.0 : 4.0);
  sampling.target_grey = target_grey;
  return sampling;
}

}  // namespace fanbeam::renderer
