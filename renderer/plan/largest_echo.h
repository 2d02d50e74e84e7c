// Upper bounds of the echo that a scene can put into a pixel, from what is in the scene, wherever
// it stands.
//
// Surfaces. A ray's share of power is K g^2 (sigma0 / sin psi) L de daz / R^2 (ray_caster.h), and
// every elevation holds one surface: with G the largest sigma0 / sin psi of any material and
// L <= 1, a range cell gets at most K G Omega / R^2, Omega the two-way pattern integrated over the
// part of it that is asked about. R is kSpreadCells before the cell's near edge, since rays spread
// their power over half the way to their neighbours.
// Air. K eta cell Omega / (R1 R2) between the edges R1 and R2 of the cell (rain_echo.h).
// Point targets. K g^2 / R^4 times the sum of their largest cross-sections, as if all stood there.
// A row of the C-scope of true elevation sums P R^3 over range: K G Omega_row R_max (each elevation
// has one range, R^3 / R^2 <= R_max), K eta Omega_row sum(R^3 cell / (R1 R2)), K g^2 sigma / R_min.
//
// Over ground that mirrors a target has up to 16 times its power (both ways over two paths in
// phase), in the cell of the mean r of its paths: their product is at least R_min (2 r - R_min).
// Not in here: double bounce, which has no bound below the whole window (effect_catalogue.cpp); where
// it is possible, nothing has that depends on the largest echo.
// Cost: a microsecond.
#pragma once

#include "renderer/plan/display_floor.h"
#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

// A wall and the ground as a corner, or a point target and its mirror image.
bool corners_possible(const SceneFacts& facts);
bool mirrored_targets_possible(const SceneFacts& facts);
inline bool has_mirrored_echo(const SceneFacts& facts) {
  return corners_possible(facts) || mirrored_targets_possible(facts);
}

// How many range cells away from a cell a ray may hit and still give to it: half of gap_cells (1.2)
// over the rays per cell and sub-column (sampling.h), from 0.3 rays up.
inline constexpr double kSpreadCells = 2.0;

// What echoes.
struct EchoSources {
  double sigma0_over_sine = 0.0;
  double eta_m2_per_m3 = 0.0;
  double rcs_m2 = 0.0;
  double mirrored_rcs_m2 = 0.0;  // over ground that mirrors
};

EchoSources all_sources(const SceneFacts& facts);

// Through which part of the two-way pattern.
struct BeamPart {
  double solid_rad2 = 0.0;      // integral over azimuth and elevation
  double row_solid_rad2 = 0.0;  // the most of it inside one row of the C-scope
  double gain = 0.0;            // the largest value
};

// Two-way integrals with side lobes: the shape over its cut, and the level behind it (in azimuth as
// far as the fan goes).
double azimuth_level_rad(const sensors::Sensor& sensor);    // of the level alone
double elevation_level_rad(const sensors::Sensor& sensor);  // the same
double azimuth_width_rad(const sensors::Sensor& sensor);
double elevation_width_rad(const sensors::Sensor& sensor);
double cscope_row_rad(const sensors::Display& display);

BeamPart whole_beam(const sensors::Sensor& sensor);

AddedPower largest_echo(const EchoSources& sources, const BeamPart& part,
                        const sensors::Sensor& sensor);

}  // namespace fanbeam::renderer
