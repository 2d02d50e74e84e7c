// Weights that are laid over samples before a Fourier transform, to trade width for side lobes.
//
// Of the periodic form, for spectra, w[n] of n = 0..N-1 is symmetric about n = N/2, and w[N] would repeat
// w[0]; the symmetric form of N weights is the periodic one of N - 1 with its first weight again at the
// end. For the cosine sums periodic is what makes their lines exact; designs of side lobes hold theirs in
// the symmetric form alone (Taylor of 12 channels: -34.0 dB instead of -28.2; Chebyshev: exactly the
// level). Periodic, with u = n/N:
//
//   rectangular      1
//   hann             0.5 - 0.5 cos 2 pi u
//   hamming          0.54 - 0.46 cos 2 pi u
//   blackman         0.42 - 0.5 cos 2 pi u + 0.08 cos 4 pi u
//   blackman_harris  0.35875 - 0.48829 cos 2 pi u + 0.14128 cos 4 pi u - 0.01168 cos 6 pi u
//   taylor           the first N of N + 1 weights, 1 + 2 sum over m < nbar of
//                    F_m cos(2 pi m (n - N/2) / (N + 1)); level in dB below the peak
//   chebyshev        the first N of the N + 1 weights of Dolph's window, level in dB; dropping the
//                    last lifts the side lobes (-56.6 dB of -60 for N = 1024)
//   kaiser           I0(beta sqrt(1 - (2u - 1)^2)) / I0(beta)
//
// Sources: F. J. Harris, Proc. IEEE 66, 1978; T. T. Taylor, IRE Trans. AP-3, 1955 (coefficients as
// in Carrara, Goodman, Majewski, "Spotlight Synthetic Aperture Radar", 1995, app. D.2); C. L.
// Dolph, Proc. IRE 34, 1946.
//
// Inputs: length 1 or more; Taylor nbar 1 to 50, level 10 to 120 dB; Chebyshev level 20 to 200 dB;
// Kaiser beta 0 to 100. E-RANGE, E-NONFINITE otherwise. Weights are not scaled; one of length 1 is 1.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::signal {

enum class WindowKind {
  rectangular,
  hann,
  hamming,
  blackman,
  blackman_harris,
  taylor,
  chebyshev,
  kaiser
};

struct Window {
  WindowKind kind = WindowKind::rectangular;
  int taylor_nbar = 5;
  double level_dB = 35.0;  // Taylor and Chebyshev: side lobes this far below the peak
  double kaiser_beta = 8.6;
  bool symmetric = false;
  bool operator==(const Window&) const = default;
};

std::vector<double> window_weights(const Window& window, int length);

// "hann", "blackman-harris", and so on; with its parameter behind a colon where the kind has one:
// "taylor:35" (dB, and "taylor:45:6" with nbar), "chebyshev:60" (dB), "kaiser:8.6" (beta). Symmetric.
// Nothing for any other text, and for parameters beyond the limits above.
std::optional<Window> window_of(std::string_view text);
// The text that window_of reads.
std::string name(const Window& window);

}  // namespace fanbeam::signal
