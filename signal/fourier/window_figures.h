// What a window does to a spectrum: width, side lobes, noise, and how well a tone's place can be
// read from it.
//
// With W(f) = sum over n of w[n] exp(-j 2 pi f n / N), f in bins, and t[n] = n - N/2:
//
//   half_power_width_bins   twice the f where |W(f)|^2 = |W(0)|^2 / 2; times c / 2B it is the range
//                           resolution, which a cell's spacing is not; N, the whole axis, where |W|^2 falls
//                           nowhere so far, as of hann's 0, 1, 0
//   peak_side_lobe_dB       largest |W|^2 beyond the first minimum, over |W(0)|^2; -infinity where the
//                           main lobe is all there is
//   noise_bandwidth_bins    N sum w^2 / (sum w)^2
//   snr_loss_dB             10 log10 of that: loss against no window, tone on a bin
//   scalloping_dB           |W(0)|^2 / |W(1/2)|^2: loss of a tone between two bins
//   variance_ratio          [sum t^2 w^2][sum t^2] / [sum t^2 w]^2: variance of the frequency at the
//                           windowed peak, over the Cramer-Rao bound
//
// Source: F. J. Harris, Proc. IEEE 66, 1978; the variance ratio follows from the derivative of
// |W|^2 at its peak under white noise, for high signal-to-noise ratios. Accuracy: 1e-6 relative.
#pragma once

#include <vector>

namespace fanbeam::signal {

struct WindowFigures {
  double half_power_width_bins = 0.0;
  double noise_bandwidth_bins = 0.0;
  double snr_loss_dB = 0.0;
  double scalloping_dB = 0.0;
  double variance_ratio = 0.0;
};

// `weights` need three values or more and a positive sum; E-RANGE otherwise.
WindowFigures window_figures(const std::vector<double>& weights);
// Apart from the others: it takes a transform of 16 times their number.
double peak_side_lobe_dB(const std::vector<double>& weights);

}  // namespace fanbeam::signal
