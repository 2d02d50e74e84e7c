// Convolution through the Fourier transform, without wrapping round.
//
//   y[k] = sum over i of x[i] h[k - i],  k = 0 .. |x| + |h| - 2
//
// Both count as zero outside their samples and are padded to at least |x| + |h| - 1, so that the tail
// of an echo in the last cell leaves the record instead of appearing in the first cells, as it does
// with the circular convolution that a product of unpadded spectra is. An empty input gives an
// empty result.
//
// Accuracy: 1e-14 of the largest output. Cost: three transforms of the padded length, a
// product of 2, 3 and 5.
#pragma once

#include <complex>
#include <vector>

namespace fanbeam::signal {

std::vector<std::complex<double>> convolved(const std::vector<std::complex<double>>& x,
                                            const std::vector<std::complex<double>>& h);

}  // namespace fanbeam::signal
