// Plane waves in a snapshot, fitted together: least squares over the azimuth and the complex amplitude of all of
// them, by Gauss-Newton from where they are. Waves within a beam that are fitted in turn walk to their places
// in steps that shrink by a few hundredths; together they are there in a few.
// In white noise the maximum-likelihood estimate; it reaches the Cramer-Rao bound where the waves are told apart at
// all (tests/signal/source_directions_test.cpp). Azimuths alone: elevations stay.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "signal/angle/plane_wave.h"

namespace fanbeam::signal {

// `most_step_rad` bounds each step in azimuth. Leaves the waves where no step makes less of the rest. Needs more
// than 1.5 elements for each wave; else nothing moves. Returns what is left without the waves.
Snapshot fit_together(const Snapshot& snapshot, const std::vector<glm::dvec3>& elements_m,
                      double wavelength_m, double most_step_rad, std::vector<PlaneWave>& waves);

}  // namespace fanbeam::signal
