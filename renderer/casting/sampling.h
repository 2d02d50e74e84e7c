// How finely a frame is sampled: the settings that trade accuracy for time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/number_range.h"

namespace fanbeam::renderer {

// Two ways to see a scene: ray_caster.h and profile/profile_caster.h.
enum class CasterKind { rays, profile };

struct Sampling {
  CasterKind caster = CasterKind::rays;
  // Profile caster: azimuth slices per sub-column. What follows then only concerns the azimuths
  // that are left to rays.
  int slices_per_sub_column = 1;
  // Azimuth sub-columns per picture column. Azimuth is what limits the error over cities: spend
  // here first.
  int sub_columns = 4;
  // Rays per range cell of visible ground and per sub-column; below 1, cells share rays.
  double rays_per_cell = 1.0;
  // Between neighbouring rays that are more than `gap_cells` apart or hit different surfaces, halve
  // this many times. Silhouettes against the sky, and borders of materials down to a part of a C-scope
  // row, three times more.
  int refinement_depth = 2;
  double gap_cells = 1.2;
  // Largest angle between neighbouring rays, on the ground close by and on what stands above the
  // horizon.
  double largest_step_rad = 3.0e-3;
  // The same above the horizon, in rows of the C-scope.
  double largest_step_rows = 1.0;
  // Of the samples of bounces that go with the rest (stages/double_bounce.h).
  double bounce_share = 1.0;
  // One ray stands for its whole range interval (false: for the cell it falls in, unbiased, wants
  // many rays).
  bool deposit_intervals = true;
  // Reference: this many passes over each sub-column, rays jittered in azimuth and elevation, keyed
  // by `seed`. Neither with target_grey nor with estimate_error: rays of all levels would be the same.
  int jittered_passes = 0;
  std::uint64_t seed = 0;
  // Above 0: every frame is refined until its estimated error, RMS over a picture's displayed grey,
  // is at most this (accuracy/refinement.h).
  double target_grey = 0.0;
  // Estimate the error of what the other settings give; as many rays again, or twice as many slices.
  bool estimate_error = false;
};

// Converged rendering as all errors are stated against: 16 jittered azimuths per pass and column, 8
// rays per range cell, no interval, no refinement. `seed` offsets the jitter, for the reference's
// own error; fewer passes than the 16 of `--reference` make a quick look.
Sampling reference_sampling(std::uint64_t seed, int passes = 16);

inline constexpr double kDefaultRaysPerCell = 4.0;
// Below it a ray would give to cells farther away than the plan's bounds count (largest_echo.h).
inline constexpr double kFewestRaysPerCell = 0.3;
// That may be asked for, of rays and of slices.
inline constexpr core::NumberRange kSamplesPerCell{kFewestRaysPerCell, 10000.0};
// The same where 0 asks for the caster's default.
inline constexpr core::NumberRange kSamplesOrDefault{
    .low = kSamplesPerCell.low, .high = kSamplesPerCell.high, .or_zero = true};

// `rays_per_cell` rays per range cell and column, split between azimuth and range in the proportion
// that measured best (docs/performance.md): azimuth first.
Sampling sampling_for(double rays_per_cell);

// `times` as many rays in each elevation, neighbours as much closer together.
Sampling finer_in_elevation(const Sampling& sampling, int times);

// Where refinement to `target_grey` begins: four azimuths per column, of slices eight below 0.5
// grey, each crossing every range cell once.
Sampling refined_sampling(CasterKind caster, double target_grey);

inline constexpr double kDefaultSlicesPerColumn = 4.0;

// `slices` azimuth slices per column through the profile caster; each crosses every range cell once.
// Of a fraction there is the next whole number of them, with as many fewer samples of bounces.
Sampling profile_sampling_for(double slices);

// One of the two: what `--rays-per-cell` sets, rays or slices, and what it is unless set.
Sampling sampling_for(CasterKind caster, double samples);
double default_samples(CasterKind caster);
// What a sampling casts of either, all passes together.
int slices_per_column(const Sampling& sampling);
double rays_per_cell_and_column(const Sampling& sampling);
// What sampling_for makes it of: those, of slices with the fraction that bounces tell.
double samples_in(const Sampling& sampling);
Sampling default_sampling(CasterKind caster);

}  // namespace fanbeam::renderer
