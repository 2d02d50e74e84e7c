// The design probability that makes a detector keep its false-alarm rate on cells that a window or
// padding correlates, or that are sums over several channels.
//
// Noise cells of a windowed spectrum, L the transform's length, are complex Gaussian with
//   E[Y[r] conj(Y[r + k])] / E[|Y|^2] = sum w[n]^2 exp(+j 2 pi k n / L) / sum w[n]^2,
// and the product of the two axes' values in two dimensions. With reference cells that resemble
// each other the estimate fluctuates more than the formulas say: cell averaging over 16 cells, two
// guard cells and a Hann window gives 2.2e-3 for a design of 1e-3.
//
//   cell averaging, one look  exact: |Y0|^2 - (alpha / N) sum |Yi|^2 is a quadratic form of Gaussian
//                             values with one positive eigenvalue p, so that
//                             Pfa = product over the others of p / (p - q)
//   everything else           average, over backgrounds drawn with the right correlation, of the
//                             exceedance of the cell given its background. The backgrounds are drawn
//                             weaker than they are and weighted back (importance sampling), from
//                             counter-based random numbers: the same result in every run and on any
//                             number of threads. `relative_error` estimates its standard error.
//                             Where guard cells do not cover the main lobe of the window, the
//                             background all but tells the cell, and this finds no rate: not done
//
// The factor found is told as the design probability that gives it for independent cells, so that
// edges with fewer reference cells follow: the mean rate of a short line of one look is kept to about 20 %. Its
// single cells are not: simulated at 1e-3 with 12 looks, Chebyshev windows of 60 dB and the window of fanbeam fmcw, the
// first and last three range cells have it 1.9 to 2.3 times with smaller-of, 0.4 to 0.8 with greater-of and
// up to 1.3 with cell averaging; the first and last six 1.2 to 1.9 times with the ordered statistic.
// `looks`: cells are sums of this many independent channels, as `range_doppler_map` with
// Projection::sum makes. A map by Projection::max has another law and is not covered.
// Source of the method: own derivation; quadratic forms after G. Turin, Biometrika 47, 1960.
// Inputs: wanted probability in (0, 1), up to kMostCalibratedCells reference cells, looks 1 to kMostLooks; E-RANGE
// otherwise. Accuracy: 1e-9 for the exact case; about 1 % for 1e-4 and N = 16. Cost: what is exact
// grows as N^3, 0.1 s for N = 92; what is drawn takes 0.3 s of one thread for N = 16, 0.6 s for N =
// 92 and 12 looks, 17 s for N = 600 and 12 looks; the last eight are remembered, of all threads.
#pragma once

#include <complex>
#include <vector>

#include "signal/detection/cfar.h"

namespace fanbeam::signal {

// Weights of the two windows and the transforms' lengths. Empty weights: independent cells.
struct CellCorrelation {
  std::vector<double> column_weights;  // of the transform along the map's columns (range)
  int column_length = 0;
  std::vector<double> row_weights;  // of the transform along the map's rows (Doppler)
  int row_length = 0;
  bool operator==(const CellCorrelation&) const = default;
};

struct CfarCalibration {
  double design_probability = 0.0;  // for CfarSettings, which refuse 0
  double factor = 0.0;              // far from edges
  double relative_error = 0.0;      // of the rate, one standard deviation; 0 where exact
  // For CfarSettings: 1 for cell averaging, else the mean of 500 backgrounds. Its standard error is a
  // 22nd of the estimate's own: for the 75 % quantile of independent cells of one look
  // 1.4 % with 16 cells, 0.6 % with 92 (closed form of order statistics).
  double mean_estimate = 1.0;
  // Whether the guard cells cover the main lobe: without, nothing is calibrated that has to be drawn.
  bool covered() const { return factor > 0.0; }
};

// Of a cell's power, the least share that its reference cells may leave untold. Simulated with 12 looks and a window of 60
// dB the rate is right where it is 0.63 (one guard cell on each side) and 14 to 825 times too high where it is 0.06 and
// less (none on one axis); a Taylor window of 35 dB leaves 0.97 of one guard cell and 0.09 to 0.33 without.
inline constexpr double kLeastUntold = 0.5;

// Of more channels than this the sum may be calibrated as of so many: the factor is too large then, at 1e-6 by
// 0.35 dB at twice as many (Wilson and Hilferty), and false alarms are rarer.
inline constexpr int kMostLooks = 256;
inline constexpr int kMostCalibratedCells = 2000;

// `settings.design_probability` is the rate that is wanted.
CfarCalibration calibrated_cfar(const CfarSettings& settings, const CellCorrelation& correlation,
                                int looks = 1);

// E[Y[r] conj(Y[r + lag])] / E[|Y|^2]. Weights not empty, length at least theirs.
std::complex<double> cell_correlation(const std::vector<double>& weights, int length, int lag);

}  // namespace fanbeam::signal
