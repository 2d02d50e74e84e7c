// From received power to grey: one prepared scale per sensor.
//
// grey = 255 (level - low) / (high - low), clamped to 0..255, with the level in dB by mapping:
//   stc   10 log10(P (4 pi)^3 R^3 L / (Pt G0^2 lambda^2 phi c)): the NRCS of flat ground that would
//         return P at full beam (sensitivity-time control); phi is the integral of the two-way
//         azimuth pattern, c the range cell
//   log   10 log10(P / 1 W): received power in dBW, low and high in dBW
//   seed  10 log10(P / 1 W) between the seed's minimum and maximum signal (seed_signal.h); the
//         sensor's low_dB and high_dB are not used. Real ground clips, because
//         those signals assume sigma0 = 1
// P is linear received power in W, 0 or more, and includes the noise when noise shall be seen. R
// is the middle of the range cell. Zero power is grey 0. Nothing is scaled per frame. Flat ground
// is taken at grazing incidence, cosine 1.
//
// The C-scope's input S is the sum over range of P R^3 in W m^3. Its level is, by mapping:
//   stc   that of a B-scope cell with P R^3 = S
//   log   10 log10(S / (R0^3 1 W)), R0^3 = sum over the range cells of R^3 / C-scope rows
//   seed  as if S came from the middle of the nearest range cell, like the seed's maximum signal
// R0 of log follows from one demand: the same power P in every range cell, shared evenly among the
// rows, is P sum(R^3) / rows in each pixel and shall have the level of P. Receiver noise is such a
// power: it is the same grey in both pictures, and a window that fits the B-scope fits the C-scope.
//
// Errors: E-NONFINITE for NaN, E-RANGE for negative power. Infinite levels clamp. Accuracy 1e-12
// dB; one logarithm per pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

// Sum over the range cells of R^3, R their middles, in m^3.
double compensated_cells_m3(const RangeGate& gate);

class GreyScale {
 public:
  // Throws as seed_signal_limits does.
  explicit GreyScale(const Sensor& sensor);

  double low_dB() const { return low_dB_; }
  double high_dB() const { return high_dB_; }
  double window_dB() const { return high_dB_ - low_dB_; }
  double dB_per_grey() const { return window_dB() / 255.0; }

  // The largest power that is still shown as grey 0.
  double bscope_floor_W(int range_row) const;
  double cscope_floor_W_m3() const;

  // Unrounded, 0 to 255. -infinity is 0, +infinity 255.
  double grey_of_level(double level_dB) const;

  // Of B-scope cells. -infinity for zero power.
  double level_dB(double power_W, int range_row) const;
  double bscope_grey(double power_W, int range_row) const;
  // Of C-scope cells.
  double cscope_level_dB(double compensated_power_W_m3) const;
  double cscope_grey(double compensated_power_W_m3) const;
  // The same of many cells, those of one row or of any, within 1e-11 grey. `grey` is as long as the
  // powers.
  void bscope_grey(std::span<const double> power_W, int range_row, double* grey) const;
  void cscope_grey(std::span<const double> compensated_power_W_m3, double* grey) const;

 private:
  void grey_of_ratios(std::span<const double> values, double factor, const char* field,
                      double* grey) const;

  double low_dB_ = 0.0;
  double high_dB_ = 0.0;
  double greys_per_dB_ = 0.0;
  std::vector<double> level_per_power_per_W_;  // by range row
  double level_per_compensated_per_W_m3_ = 0.0;
};

// Rounds to the nearest whole number, halves up, after clamping to 0..255; never decreases as
// `grey` rises.
// Throws InputError E-NONFINITE for NaN.
std::uint8_t grey8(double grey);
// grey8 of many; `rounded` is as long.
void round_greys(std::span<const double> grey, std::uint8_t* rounded);

}  // namespace fanbeam::sensors
