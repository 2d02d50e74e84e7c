// Channels of a transformed cube become beams: the range-azimuth-Doppler cube.
//
//   line arrays   Z[a] = 1 / sum w  sum over m of w[m] Y[m] exp(+j 2 pi m (a - A0) / A),
//                 A0 = floor(A / 2): sin(azimuth) = (a - A0) / A  wavelength / pitch
//   any array     Z[b] = 1 / sum w  sum over m of w[m] Y[m] exp(+j 2 pi (u_b . p_m) / wavelength)
//
// The sign undoes the lead of elements nearer to the scatterer (signal/waveform/array.h). A lone
// plane wave from a beam's direction keeps its power. Channels of a line must run from left to
// right at one pitch, as those of `line_array` do. Beam b of a grid is elevation * azimuths +
// azimuth.
//
// Inputs: angle cells 0 (as many as channels) or at least the channels; elements as many as
// channels; wavelength and pitch positive; directions finite. E-RANGE otherwise.
// Neglected: near field; the change of wavelength over the sweep (0.1 % for 250 MHz at 76 GHz).
// Accuracy: 1e-6 (float) of the largest value. Cost: one pass by Fourier transform for a line;
// channels x beams x cells products for a grid.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "signal/cube.h"
#include "signal/fourier/window.h"

namespace fanbeam::signal {

template <typename Real>
void angle_transform(const Cube<Real>& range_doppler, const Window& window, int angle_cells,
                     Cube<Real>& result);

// Azimuth of each angle cell of a line. Cells beyond end-fire (pitch below half a wavelength) get
// -pi/2 or pi/2; a pitch above half a wavelength leaves azimuths ambiguous, and the one nearest to
// boresight is told.
std::vector<double> angle_cell_azimuths_rad(int angle_cells, double pitch_m, double wavelength_m);

struct BeamGrid {
  std::vector<double> azimuths_rad;
  std::vector<double> elevations_rad = {0.0};
};

// `weights`: one per channel; empty for all 1.
template <typename Real>
void beam_transform(const Cube<Real>& range_doppler, const std::vector<glm::dvec3>& elements_m,
                    double wavelength_m, const BeamGrid& grid, const std::vector<double>& weights,
                    Cube<Real>& result);

}  // namespace fanbeam::signal
