// Power over range and azimuth by Capon's method: sharper than the beams of the array, which its
// side lobes do not limit either.
//
//   R[r] = 1 / (M g) sum over d of y y^H,  y the channels of the cell (r, d)
//   P[r, a] = capon_spectrum of R[r] (signal/angle/spatial_spectrum.h), loading 1e-3
//
// Range by range, with all Doppler cells as snapshots, so that what stands at one range in two
// directions is told apart as long as its speeds differ by a cell. M g is the noise bandwidth of the
// Doppler window in cells (g = noise_gain): a lone scatterer keeps its power, and noise adds that of
// all Doppler cells.
// Inputs: a range-Doppler cube with slots compensated; elements as many as channels; azimuths not
// empty; noise bandwidth above 0. E-RANGE otherwise.
// Source: J. Capon, Proc. IEEE 57, 1969. Accuracy as of capon_spectrum.
// Cost: M N^2 products a range cell and N^2 for every azimuth.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "signal/cube.h"
#include "signal/transform/cube_maps.h"

namespace fanbeam::signal {

// Row: azimuth, column: range cell.
PowerMap capon_range_azimuth(const FloatCube& range_doppler,
                             const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                             const std::vector<double>& azimuths_rad, double noise_bandwidth_cells);

}  // namespace fanbeam::signal
