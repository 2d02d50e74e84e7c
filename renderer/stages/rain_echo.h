// The echo of rain and snow in the air between the antenna and what its rays hit.
//
//     dP = K g_el(e)^2 eta(place) L(place) dR dOmega / R^2 ,   K = Pt G0^2 lambda^2 / (4 pi)^3 / loss
// with the volume R^2 dR dOmega of a range cell and a solid angle (Skolnik, Introduction to Radar
// Systems, 3rd ed., section 7.6; Doviak and Zrnic, Doppler Radar and Weather Observations, 2nd ed.,
// section 4.4). dOmega = J de daz as in ray_caster.h. The echo adds to the power of surfaces, before
// the azimuth beam.
//
// One plane of azimuth per picture column is cut into elevation intervals, dense where range cells
// of level ground border each other, at most a tenth of a degree elsewhere. Rays along each border,
// at both sides of the column, say how far the air is free, and where they differ a ray in each of
// its sub-columns; between two elevations the free share of an interval falls linearly with range.
// Inside a range cell eta is that of the middle and the loss decays exponentially; over elevation
// both are interpolated between values 0.1 deg apart, or 2 deg where no top, base or melting layer
// lies within the beam. Azimuths of a plane scan share them beside rain cells: those of a level
// antenna, and where no border of a layer lies within the beam those of one whose tilt changes no height
// within range by more than 75 m: at 3.7 km 0.02 rad, as of level at the aircraft 127 km from the
// scene's origin.
//
// Neglected: depolarisation, multiple scattering, echo that reaches the antenna by way of the ground.
// Accuracy: 0.02 dB over level ground against the closed form; where a silhouette cuts the beam, half
// of a sub-column of its place; what is narrower than a column and stands within one may be missed.
// Cost: docs/physics/rain-echo.md.
#pragma once

#include "renderer/casting/caster.h"
#include "renderer/plan/scene_facts.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

// Adds to `sums` what `world.volume_echo` returns. `sub_columns_per_column` as in the sampling.
void add_rain_echo(const World& world, const sensors::AntennaFrame& antenna,
                   int sub_columns_per_column, FanSums& sums);

// Along which directions of an antenna echo and loss are worked out.
struct RainDirections {
  double step_rad = 0.0;  // of elevation, at most
  bool shared = false;    // by all azimuths beside rain cells
};
RainDirections rain_directions(const World& world, const sensors::AntennaFrame& antenna);

// Upper bound of the change of a pixel by the echo, in dB: the largest eta filling the whole beam,
// side lobes included, without loss (largest_echo.h), spread by the range response, over the floor
// of the display's pictures (display_floor.h) where that is most.
double rain_echo_bound_dB(const SceneFacts& facts);

}  // namespace fanbeam::renderer
