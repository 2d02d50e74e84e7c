// Below what nothing of a bounce can be seen.
#pragma once

#include <vector>

#include "renderer/surfaces/bistatic_nrcs.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// By range cell, the density of an echo that stays unseen although it filled the whole beam: in the
// B-scope's cell, and in one row of the C-scope. A hundredth of what shows there without it, of the
// larger of the display's floor and the receiver's mean noise, if `noise` is in every cell: 0.04 dB.
std::vector<double> faintest_echoes_W_per_rad2(const sensors::Sensor& sensor, bool noise);

// The mirror in which even the brightest surface of the world stays unseen: filling the elevation
// beam of one range cell it returns at most 4 K rho gamma / R^2. A tenth of that range is where its
// echo may lie.
double faintest_mirror(const sensors::Sensor& sensor, const std::vector<BistaticNrcs>& nrcs,
                       const std::vector<double>& faintest_W_per_rad2);

// By range cell, the power that a change of what bounces add is held against when they are sampled:
// two fifths up the display's window (-31 dB of the default one), or less where a C-scope would show
// less. It has nothing of the weather or of the other surfaces in it, or the plan's effects would
// decide where rays go, and a faint one that is left out would be seen in the noise of sampling.
std::vector<double> shown_powers_W(const sensors::Sensor& sensor);

// Tangent of the angle between two directions that a beam in their middle still sees.
double widest_tangent(const sensors::BeamCut& cut);

}  // namespace fanbeam::renderer
