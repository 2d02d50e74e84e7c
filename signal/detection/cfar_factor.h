// Threshold factors of constant false-alarm rate detectors: a cell is reported when its power
// exceeds factor x (estimate of the background from reference cells).
//
// Square-law detector, exponential powers, independent cells; alpha the factor, N reference cells:
//   cell_averaging     mean of all N            Pfa = (1 + alpha / N)^-N
//   ordered_statistic  k-th smallest of N       Pfa = product over i < k of (N - i) / (N - i + alpha)
//   greatest_of        larger of the means      Pfa = (1 + x)^-a + (1 + y)^-b - s
//   smallest_of        of two halves a + b      Pfa = s
//     x = alpha / a, y = alpha / b, s = half(a, b) + half(b, a),
//     half(a, b) = sum over j < b of C(a - 1 + j, j) r^j (1 + x + r)^-(a + j),  r = b / a
// A Swerling 1 (or 2) target of signal-to-noise ratio S is found with the same expressions at
// alpha / (1 + S). Logarithms with expm1 and log1p throughout: N (P^(-1/N) - 1) as written loses
// 8e-8 at N = 1e9.
//
// Trap: these are factors on power. The square root on amplitudes is wrong, since the mean
// amplitude is not the root of the mean power: Pfa 3.6e-3 instead of 1e-3 for N = 16.
//
// Sources: H. M. Finn, R. S. Johnson, RCA Rev. 29, 1968; H. Rohling, IEEE Trans. AES-19, 1983; V.
// G. Hansen, J. H. Sawyers, IEEE Trans. AES-16, 1980; G. V. Trunk, IEEE Trans. AES-14, 1978.
// Unequal halves (edges): the integral of the two gamma laws, derived as there.
// Inputs: probability in (0, 1); N 1 or more (1 to 1e5 for the two of halves, both not empty), k
// 1 to N. E-RANGE otherwise. Accuracy: 1e-10 relative (1e-8 for the two of halves). Correlated
// reference cells: signal/detection/cfar_calibration.h.
#pragma once

#include <string_view>

namespace fanbeam::signal {

enum class CfarKind { cell_averaging, ordered_statistic, greatest_of, smallest_of };

// "CA", "OS", "GO", "SO".
std::string_view name(CfarKind kind);

struct CfarReference {
  CfarKind kind = CfarKind::cell_averaging;
  int before = 8;  // reference cells on either side; the sides matter for the two of halves only
  int after = 8;
  int rank = 12;  // ordered statistic: k of before + after
  bool operator==(const CfarReference&) const = default;
};

double cfar_false_alarm_probability(const CfarReference& reference, double factor);
double cfar_factor(const CfarReference& reference, double false_alarm_probability);

}  // namespace fanbeam::signal
