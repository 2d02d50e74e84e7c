// From expected power to one realisation: speckle of the ground, the noise of the receiver, and the
// fluctuation of point targets.
//
// A cell's power is the mean over N looks of
//     | sum over targets of sqrt(P_t f_t) e^(i phi_t)  +  z |^2
// z complex Gaussian with E|z|^2 = diffuse power + noise power, phi_t uniform, f_t the Swerling
// factor of mean 1 (core/swerling.h). Without targets that is diffuse + noise times a gamma
// variable of order N and mean 1: exponential for one look, fully developed speckle.
// Sources: J. W. Goodman, "Statistical Properties of Laser Speckle Patterns", 1975, eqs. 8 and 15
// (exponential, and the sum of looks); S. O. Rice, "Mathematical analysis of random noise", Bell
// Syst. Tech. J. 24, 1945, 3.10 (a steady signal in noise); F. T. Ulaby, M. C. Dobson, "Handbook of
// Radar Scattering Statistics for Terrain", 1989 (Rayleigh law of terrain seen with many
// scatterers a cell).
//
// What is independent: cells, looks and frames. Neighbouring columns share scatterers under the
// beam, but a frequency-scanned column has a band of its own, which decorrelates them; a beam
// scanned by turning would not. phi_t is drawn per target, column and look: all echoes of one
// target in one column and look share it, as if their paths differed by whole wavelengths.
// A C-scope of true elevation has a realisation of its own, each pixel a cell of N looks: no radar
// makes that picture. The flat-earth C-scope is drawn from the B-scope's realisation.
//
// Every number is a pure function of (seed, frame, cell, draw), see core/random.h: u is at least
// 2^-33, so that one look is at most 22.8739 times and at least 1.16e-10 times its mean.
// Inputs: powers 0 or more; looks 1 to 1000. Zero power stays zero.
// Neglected: texture (correlated or spiky clutter, K law), range correlation of speckle by a
// window, noise correlation between looks. Accuracy: the laws are exact up to the 32 bits of u,
// tested by chi-square and moments. Cost of a HiVision picture of 86 000 cells on one core: 0.5 ms up
// to 4 looks (a Philox block and a logarithm a cell, side by side), 3 ms for 28, 8 ms beyond.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/echo.h"
#include "core/swerling.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// What is drawn, and the names of the draws.
struct Fluctuation {
  bool speckle = false;   // of ground and noise, and the phases of targets
  bool swerling = false;  // of the targets' power
  int looks = 1;
  std::uint64_t seed = 0;
  std::uint64_t frame = 0;
};

// What a target gives to one cell of a picture.
struct TargetShare {
  std::uint32_t target = 0;  // index
  std::uint32_t column = 0;
  std::size_t cell = 0;  // of the row-major picture
  double power = 0.0;    // expected: W, or W m^3 in a C-scope
};

// Of a B-scope, and of a C-scope of true elevation.
std::vector<TargetShare> bscope_shares(const std::vector<core::Echo>& echoes,
                                       const sensors::Sensor& sensor);
std::vector<TargetShare> cscope_shares(const std::vector<core::Echo>& echoes,
                                       const sensors::Sensor& sensor);

// `picture` holds the diffuse power of cells of `columns` columns and is left with targets added:
// without speckle their powers in expected ground and no noise, with speckle one realisation, the
// noise of mean power `noise` in it. `cases` are the targets' by index; `stream` names the
// picture's draws (core/random.h).
void realise(std::vector<TargetShare> shares, std::span<const core::Swerling> cases,
             const Fluctuation& fluctuation, std::uint32_t stream, double noise, int columns,
             std::vector<double>& picture);

// Of the cells from `first` on gamma variables of order `looks` and mean 1: means of that many
// exponentials. Up to 28 looks they are drawn as their sum, beyond by Marsaglia and Tsang (ACM Trans.
// Math. Software 26, 2000).
void speckle_factors(const Fluctuation& fluctuation, std::uint32_t stream, std::uint64_t first,
                     std::span<double> factors);

// f_t of the header in one look of one column.
double target_factor(core::Swerling target_case, const Fluctuation& fluctuation,
                     std::uint32_t target, std::uint32_t column, std::uint32_t look);

// Largest change in dB that a draw of any of the laws above can make: that of the smallest u.
inline constexpr double kLargestFluctuation_dB = 99.3399;  // 330 log10(2)

}  // namespace fanbeam::renderer
