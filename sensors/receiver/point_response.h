// Range response of a point target: received power along range, normalised to a total of 1.
//
// One sweep per column. The sweep of bandwidth B is weighted by a window w over its length and
// transformed; with x the range offset in bins of c / 2B the response is |W(x)|^2 over the integral
// of w^2 (Parseval), W(x) = sum over m of a_|m| sinc(x - m). All windows are cosine sums
// w(t) = a_0 + 2 sum a_m cos(2 pi m t), |t| <= 1/2:
//   rectangular  1                          first lobe -13.26 dB, width 0.886 bins
//   hann         1/2, 1/4                   -31.5 dB, 1.44
//   hamming      0.54, 0.23                 -42.7 dB, 1.30
//   taylor       F_m of Taylor's design     as asked for (default -35 dB, 1.18 bins)
// (F. J. Harris, On the use of windows for harmonic analysis with the discrete Fourier transform,
// Proc. IEEE 66, 1978, table I; T. T. Taylor, IRE Trans. AP-3, 1955.)
//
// One sweep over the whole scan. A target at azimuth a is lit only while the beam passes: its
// spectrum is the one-way power pattern (the two-way field) g(azimuth(f) - a), and the response the
// squared transform of that. A Gaussian beam of one-way half-power width w, swept at s radians per
// hertz, gives the spectrum exp(-4 ln2 (s f / w)^2) and the response
//     exp(-r^2 / (2 sigma^2)), half-power width = (2 sqrt(2) ln2 / pi) (c / 2) s / w ,
// 0.6241 c / 2B_w, B_w = w / s: the frequencies between the half-power points. Beams of any shape
// are taken as the Gaussian with the same two-way half-power width in `half_power_width_rad`.
// HiVision, 22.473 MHz over 41 deg: B_w = 0.4385 MHz, 213 m; 6.67 m would take 719 MHz.
//
// Neglected: phase errors of the sweep, change of the pattern along it, range-Doppler coupling.
// Accuracy: closed forms, 1e-14. Cost: up to 2n - 1 sines per value, n terms.
#pragma once

#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

// a_0, a_1, ...; a_0 alone for a rectangular window. Not for Window::none.
std::vector<double> window_coefficients(const Waveform& waveform);

class PointResponse {
 public:
  // For a column of the sensor; only a frequency-scanned sweep over the whole scan differs from
  // column to column. The sensor must have a response: has_point_response.
  PointResponse(const Sensor& sensor, int column);

  // Power per metre at a distance from the target's range.
  double density_per_m(double offset_m) const;

  // The scale on which it changes: c / 2B, or the standard deviation of the Gaussian.
  double scale_m() const { return scale_m_; }

  // Full width between the half-power points.
  double half_power_width_m() const;

 private:
  double scale_m_ = 0.0;
  double peak_per_m_ = 0.0;
  std::vector<double> coefficients_;  // empty: Gaussian
};

// Whether the sensor file asks for more than an ideal range cell.
bool has_point_response(const Sensor& sensor);

// Whether columns differ.
bool point_response_varies(const Sensor& sensor);

}  // namespace fanbeam::sensors
