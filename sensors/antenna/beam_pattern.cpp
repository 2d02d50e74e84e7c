#include "sensors/antenna/beam_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"

namespace fanbeam::sensors {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
// (sin x / x)^2 = 1/2 at x = 1.391557378251510.
constexpr double kHalfPowerSinc = 1.391557378251510 / core::kPi;
// (cos(pi u) / (1 - 4 u^2))^2 = 1/2.
constexpr double kHalfPowerCosine = 0.5944823904664727;
constexpr double kFirstNullSinc = 1.0;
constexpr double kFirstNullCosine = 1.5;

// Gauss-Legendre nodes and weights, 8 points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> kNodes = {0.1834346424956498, 0.5255324099163290,
                                          0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873,
                                            0.2223810344533745, 0.1012285362903763};

template <class Function>
double integral_of_panel(double from, double to, const Function& function) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i)
    sum +=
        kWeights[i] * (function(middle - half * kNodes[i]) + function(middle + half * kNodes[i]));
  return sum * half;
}

template <class Function>
double integral(double from, double to, double widest_panel, const Function& function) {
  const double panels = std::max(1.0, std::ceil((to - from) / widest_panel));
  double sum = 0.0;
  for (double panel = 0.0; panel < panels; panel += 1.0)
    sum += integral_of_panel(from + (to - from) * (panel / panels),
                             from + (to - from) * ((panel + 1.0) / panels), function);
  return sum;
}

double table_gain(const BeamCut& cut, double offset_rad) {
  const std::vector<double>& angle = cut.table_angle_rad;
  if (angle.empty() || !(offset_rad >= angle.front() && offset_rad <= angle.back())) return 0.0;
  const auto above = std::upper_bound(angle.begin(), angle.end(), offset_rad);
  if (above == angle.end()) return cut.table_gain.back();
  const auto i = static_cast<std::size_t>(above - angle.begin());
  const double share = (offset_rad - angle[i - 1]) / (angle[i] - angle[i - 1]);
  return cut.table_gain[i - 1] + share * (cut.table_gain[i] - cut.table_gain[i - 1]);
}

// Integral of exp(-(s x)^2); of two angles on one side of the peak the far tails would cancel in
// erf.
double gaussian_integral(double s, double from, double to) {
  const double scale = std::sqrt(core::kPi) / (2.0 * s);
  if (from > 0.0) return scale * (std::erfc(s * from) - std::erfc(s * to));
  if (to < 0.0) return scale * (std::erfc(-s * to) - std::erfc(-s * from));
  return scale * (std::erf(s * to) - std::erf(s * from));
}

// The square of a straight line from g0 to g1 over a segment, segment by segment.
double table_two_way_integral(const BeamCut& cut, double from, double to) {
  double sum = 0.0;
  for (std::size_t i = 1; i < cut.table_angle_rad.size(); ++i) {
    const double a = std::max(from, cut.table_angle_rad[i - 1]);
    const double b = std::min(to, cut.table_angle_rad[i]);
    if (!(a < b)) continue;
    const double g0 = table_gain(cut, a);
    const double g1 = table_gain(cut, b);
    sum += (b - a) / 3.0 * (g0 * g0 + g0 * g1 + g1 * g1);
  }
  return sum;
}

double gaussian_gain(const BeamCut& cut, double offset_rad) {
  const double x = offset_rad / cut.half_power_width_rad;
  return std::exp(-4.0 * kLn2 * x * x);
}

double cosecant_gain(const BeamCut& cut, double offset_rad) {
  const double below_rad = -offset_rad;
  if (below_rad <= cut.cosecant_from_rad) return gaussian_gain(cut, offset_rad);
  if (below_rad > cut.cosecant_to_rad) return 0.0;
  const double ratio = std::sin(cut.peak_depression_rad + cut.cosecant_from_rad) /
                       std::sin(cut.peak_depression_rad + below_rad);
  return gaussian_gain(cut, cut.cosecant_from_rad) * ratio * ratio;
}

// u per sine of the angle, of shapes that are the transform of an aperture.
double aperture_scale(const BeamCut& cut) {
  const double half_power =
      cut.shape == BeamCut::Shape::sinc_squared ? kHalfPowerSinc : kHalfPowerCosine;
  return half_power / std::sin(0.5 * cut.half_power_width_rad);
}

// cos(pi u) / (1 - 4 u^2) without its 0/0 at u = 1/2.
double cosine_aperture_field(double u) {
  return core::kPi / 4.0 * (normalised_sinc(u - 0.5) + normalised_sinc(u + 0.5));
}

// Angles at which a pattern's slope or value jumps.
std::vector<double> knots(const BeamCut& cut) {
  std::vector<double> angles = {-cut.cut_rad, cut.cut_rad};
  if (cut.shape == BeamCut::Shape::table)
    for (const double angle : cut.table_angle_rad)
      if (std::abs(angle) < cut.cut_rad) angles.push_back(angle);
  if (cut.shape == BeamCut::Shape::cosecant_squared)
    for (const double below : {cut.cosecant_from_rad, cut.cosecant_to_rad})
      if (below < cut.cut_rad) angles.push_back(-below);
  std::sort(angles.begin(), angles.end());
  return angles;
}

// Integral from one angle to the other, panels ending at the pattern's knots.
template <class Function>
double integral_between_knots(const BeamCut& cut, double from, double to,
                              const Function& function) {
  const std::vector<double> angles = knots(cut);
  double sum = 0.0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double a = std::max(from, angles[i - 1]);
    const double b = std::min(to, angles[i]);
    if (a < b) sum += integral(a, b, cut.half_power_width_rad / 10.0, function);
  }
  return sum;
}

// Integral of the one-way pattern with its side lobes times weight(offset).
template <class Weight>
double weighted_width(const BeamCut& cut, const Weight& weight) {
  const double main = integral_between_knots(cut, -cut.cut_rad, cut.cut_rad, [&](double offset) {
    return one_way_gain(cut, offset) * weight(offset);
  });
  if (!(cut.side_lobe_gain > 0.0)) return main;
  constexpr double kPanel_rad = 0.05;
  return main + cut.side_lobe_gain *
                    (integral(-cut.side_lobe_extent_rad, -cut.cut_rad, kPanel_rad, weight) +
                     integral(cut.cut_rad, cut.side_lobe_extent_rad, kPanel_rad, weight));
}

}  // namespace

double normalised_sinc(double u) {
  if (u == 0.0) return 1.0;
  const double turn = std::remainder(u, 2.0);  // exact, in [-1, 1]; sin(pi turn) = sin(pi u)
  if (turn == 0.0 || std::abs(turn) == 1.0) return 0.0;
  // sin(pi - x) = sin(x) keeps the argument below pi/2, so that values near a null stay accurate.
  const double folded = std::abs(turn) > 0.5 ? std::copysign(1.0 - std::abs(turn), turn) : turn;
  return std::sin(core::kPi * folded) / (core::kPi * u);
}

double one_way_gain(const BeamCut& cut, double offset_rad) {
  if (!(std::abs(offset_rad) <= cut.cut_rad)) return 0.0;
  switch (cut.shape) {
    case BeamCut::Shape::gaussian:
      return gaussian_gain(cut, offset_rad);
    case BeamCut::Shape::sinc_squared: {
      const double field = normalised_sinc(aperture_scale(cut) * std::sin(offset_rad));
      return field * field;
    }
    case BeamCut::Shape::cosine_aperture: {
      const double field = cosine_aperture_field(aperture_scale(cut) * std::sin(offset_rad));
      return field * field;
    }
    case BeamCut::Shape::cosecant_squared:
      return cosecant_gain(cut, offset_rad);
    case BeamCut::Shape::table:
      return table_gain(cut, offset_rad);
  }
  return 0.0;
}

double two_way_gain(const BeamCut& cut, double offset_rad) {
  const double gain = one_way_gain(cut, offset_rad);
  return gain * gain;
}

double one_way_gain_with_side_lobes(const BeamCut& cut, double offset_rad) {
  const double off_rad = std::abs(offset_rad);
  if (off_rad > cut.cut_rad && off_rad <= cut.side_lobe_extent_rad) return cut.side_lobe_gain;
  return one_way_gain(cut, offset_rad);
}

double two_way_gain_with_side_lobes(const BeamCut& cut, double offset_rad) {
  const double gain = one_way_gain_with_side_lobes(cut, offset_rad);
  return gain * gain;
}

double reach_rad(const BeamCut& cut) {
  return cut.side_lobe_gain > 0.0 ? std::max(cut.cut_rad, cut.side_lobe_extent_rad) : cut.cut_rad;
}

BeamCut main_beam(const BeamCut& cut) {
  BeamCut main = cut;
  main.side_lobe_gain = main.side_lobe_extent_rad = 0.0;
  const bool sinc = cut.shape == BeamCut::Shape::sinc_squared;
  if (sinc || cut.shape == BeamCut::Shape::cosine_aperture) {
    const double sine = (sinc ? kFirstNullSinc : kFirstNullCosine) / aperture_scale(cut);
    if (sine < 1.0) main.cut_rad = std::min(cut.cut_rad, std::asin(sine));
  }
  return main;
}

double two_way_integral(const BeamCut& cut, double from_rad, double to_rad) {
  if (to_rad < from_rad) return -two_way_integral(cut, to_rad, from_rad);
  const double from = std::clamp(from_rad, -cut.cut_rad, cut.cut_rad);
  const double to = std::clamp(to_rad, -cut.cut_rad, cut.cut_rad);
  if (!(from < to)) return 0.0;
  switch (cut.shape) {
    case BeamCut::Shape::gaussian:
      return gaussian_integral(std::sqrt(8.0 * kLn2) / cut.half_power_width_rad, from, to);
    case BeamCut::Shape::sinc_squared:
    case BeamCut::Shape::cosine_aperture:
    case BeamCut::Shape::cosecant_squared:
      return integral_between_knots(cut, from, to,
                                    [&](double offset) { return two_way_gain(cut, offset); });
    case BeamCut::Shape::table:
      return table_two_way_integral(cut, from, to);
  }
  return 0.0;
}

double two_way_width(const BeamCut& cut) {
  return two_way_integral(cut, -cut.cut_rad, cut.cut_rad);
}

double directivity(const Antenna& antenna, ScanSurface surface) {
  const auto even = [](double) { return 1.0; };
  const auto cosine_from = [](double peak_rad) {
    return [peak_rad](double offset_rad) { return std::max(0.0, std::cos(peak_rad + offset_rad)); };
  };
  const double solid_angle_sr =
      surface == ScanSurface::cone
          ? weighted_width(antenna.azimuth, cosine_from(0.0)) *
                weighted_width(antenna.elevation, even)
          : weighted_width(antenna.azimuth, even) *
                weighted_width(antenna.elevation, cosine_from(antenna.boresight_elevation_rad));
  return 4.0 * core::kPi / solid_angle_sr;
}

TwoWayTable::TwoWayTable(const BeamCut& cut) : reach_rad_(reach_rad(cut)) {
  constexpr double kStepsPerWidth = 1024.0;
  constexpr double kMostSteps = 1048576.0;
  const double steps = std::clamp(
      std::ceil(2.0 * reach_rad_ / cut.half_power_width_rad * kStepsPerWidth), 1.0, kMostSteps);
  steps_per_rad_ = steps / (2.0 * reach_rad_);
  last_step_ = 2.0 * reach_rad_ * steps_per_rad_;  // as the caller's offset at the edge evaluates
  const auto nodes = static_cast<std::size_t>(steps) + 1;
  gain_.reserve(nodes + 1);
  for (std::size_t i = 0; i < nodes; ++i)
    gain_.push_back(two_way_gain_with_side_lobes(
        cut, reach_rad_ * ((2.0 * static_cast<double>(i) - steps) / steps)));
  gain_.push_back(gain_.back());
}

}  // namespace fanbeam::sensors
