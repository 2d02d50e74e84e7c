// Place and amplitude of one tone in noise, to the Cramer-Rao bound.
//
//   x[n] = A exp(j 2 pi b n / N) + noise, b in bins, not whole
//
// `refined_tone` climbs sum over records of |sum_n w[n] x[n] exp(-j 2 pi b n / N)|^2 from a start
// within half a bin by Newton's method. With all weights 1 that is the maximum-likelihood estimate
// of a lone tone: sigma_b = sqrt(6 / eta) / (2 pi), eta = N |A|^2 / s2 summed over the records,
// above the threshold of about 15 dB below which wrong peaks win (D. C. Rife, R. R. Boorstyn, IEEE
// Trans. IT-20, 1974). A window costs its variance ratio (signal/fourier/window_figures.h), but
// keeps neighbouring tones from pulling: use it when others are within some ten bins. Records share
// b and have amplitudes of their own (channels of a cube).
//
// Inputs: two samples or more, finite, records of one size; weights none or as many as samples.
// E-RANGE, E-NONFINITE otherwise. Accuracy of the climb: 1e-10 bins by default. Cost: some 6 sums over the
// samples.
#pragma once

#include <complex>
#include <vector>

namespace fanbeam::signal {

struct Tone {
  double bin = 0.0;  // may leave 0..N-1 by a fraction: bins are periodic
  std::vector<std::complex<double>> amplitudes;  // one per record, at sample 0
  double power = 0.0;                            // sum of |amplitude|^2
};

using ToneRecords = std::vector<std::vector<std::complex<double>>>;

// Ends after a step shorter than `tolerance_bins`, which leaves about its square.
Tone refined_tone(const ToneRecords& records, double near_bin,
                  const std::vector<double>& weights = {}, double tolerance_bins = 1e-11);

// Tones at known places, all at once: the amplitudes that leave least of the records.
std::vector<Tone> tones_at(const ToneRecords& records, const std::vector<double>& bins);

// The strongest tone of one record, from its padded spectrum.
Tone strongest_tone(const std::vector<std::complex<double>>& samples,
                    const std::vector<double>& weights = {});

}  // namespace fanbeam::signal
