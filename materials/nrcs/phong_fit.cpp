#include "materials/nrcs/phong_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/number_range.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

constexpr double kGolden = 0.61803398874989485;
// The RMS is known to about 5e-7 dB; a parameter that gains less is left out.
constexpr double kNegligible_dB = 1e-6;
constexpr int kRefinements = 60;  // golden^60 = 3e-13 of the starting interval

// Least value of a function on [low, high]: best of a grid, then golden section around it.
template <class Function>
double minimum_at(Function&& value, double low, double high, int intervals) {
  const double step = (high - low) / intervals;
  int best = 0;
  double best_value = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= intervals; ++i) {
    const double candidate = value(low + i * step);
    if (candidate < best_value) {
      best_value = candidate;
      best = i;
    }
  }
  double left = low + std::max(0, best - 1) * step;
  double right = low + std::min(intervals, best + 1) * step;
  double inner_left = right - kGolden * (right - left);
  double inner_right = left + kGolden * (right - left);
  double value_left = value(inner_left);
  double value_right = value(inner_right);
  for (int i = 0; i < kRefinements; ++i) {
    if (value_left <= value_right) {
      right = inner_right;
      inner_right = inner_left;
      value_right = value_left;
      inner_left = right - kGolden * (right - left);
      value_left = value(inner_left);
    } else {
      left = inner_left;
      inner_left = inner_right;
      value_left = value_right;
      inner_right = left + kGolden * (right - left);
      value_right = value(inner_right);
    }
  }
  const double refined = 0.5 * (left + right);
  // The grid point may lie on a bound that golden section only approaches.
  return value(refined) < best_value ? refined : low + best * step;
}

struct Candidate {
  double a = 0.0;
  double b = 0.0;
  double c = 1.0;
  double rms_dB = std::numeric_limits<double>::infinity();
};

class DecibelFit {
 public:
  explicit DecibelFit(const std::vector<NrcsSample>& samples) {
    for (const NrcsSample& sample : samples) {
      sine_.push_back(std::sin(sample.grazing_rad));
      level_dB_.push_back(10.0 * std::log10(sample.sigma0));
    }
    lobe_.resize(samples.size());
  }

  Candidate best() {
    const Candidate lambert = scaled(1.0, 0.0, 1.0);
    // Exponents are searched evenly in log(c): the form changes as much from 1 to 2 as from 10 to
    // 20.
    const auto of_exponent = [this](double log_c) { return best_at(std::exp(log_c)).rms_dB; };
    const double log_c = minimum_at(of_exponent, 0.0, std::log(100.0), 46);
    const Candidate lobed = best_at(std::exp(log_c));
    // At c = 1 both terms have one shape; the plain form is preferred where the lobe gains nothing.
    return lobed.rms_dB < lambert.rms_dB - kNegligible_dB ? lobed : lambert;
  }

 private:
  Candidate best_at(double c) {
    set_exponent(c);
    const auto of_ratio = [this, c](double log_ratio) {
      return scaled(1.0, std::exp(log_ratio), c).rms_dB;
    };
    const double log_ratio = minimum_at(of_ratio, -12.0, 25.0, 37);
    Candidate best = scaled(1.0, std::exp(log_ratio), c);
    for (const Candidate& bound : {scaled(0.0, 1.0, c), scaled(1.0, 0.0, c)})
      if (bound.rms_dB <= best.rms_dB + kNegligible_dB) best = bound;
    return best;
  }

  void set_exponent(double c) {
    for (std::size_t i = 0; i < sine_.size(); ++i) lobe_[i] = std::pow(sine_[i], c);
  }

  // a : b as given, scaled so that the mean deviation is 0 dB; infinitely far off where a form under
  // the least double has no decibels.
  Candidate scaled(double a, double b, double c) const {
    const auto count = static_cast<double>(sine_.size());
    double sum_dB = 0.0;
    double sum_dB2 = 0.0;
    for (std::size_t i = 0; i < sine_.size(); ++i) {
      const double form = a * sine_[i] + b * lobe_[i];
      if (form == 0.0) return {};
      const double difference_dB = level_dB_[i] - 10.0 * std::log10(form);
      sum_dB += difference_dB;
      sum_dB2 += difference_dB * difference_dB;
    }
    const double mean_dB = sum_dB / count;
    const double scale = std::pow(10.0, mean_dB / 10.0);
    const double variance_dB2 = std::max(0.0, sum_dB2 / count - mean_dB * mean_dB);
    return {a * scale, b * scale, b == 0.0 ? 1.0 : c, std::sqrt(variance_dB2)};
  }

  std::vector<double> sine_;
  std::vector<double> level_dB_;
  std::vector<double> lobe_;
};

}  // namespace

PhongFit fit_phong(const std::vector<NrcsSample>& samples) {
  core::require_range("samples", static_cast<double>(samples.size()), {3.0, 1e6});
  for (const NrcsSample& sample : samples) {
    core::require_range("grazing_rad", sample.grazing_rad, {1e-6, core::kPi / 2.0});
    core::require_range("sigma0", sample.sigma0, {1e-30, 1e6});
  }
  const Candidate best = DecibelFit(samples).best();
  PhongFit fit{PhongNrcs(best.a, best.b, best.c), best.rms_dB, 0.0};
  for (const NrcsSample& sample : samples) {
    const double fitted = fit.nrcs.sigma0(std::sin(sample.grazing_rad));
    fit.max_dB = std::max(fit.max_dB, std::abs(10.0 * std::log10(fitted / sample.sigma0)));
  }
  return fit;
}

const std::vector<double>& standard_fit_angles_deg() {
  static const std::vector<double> angles = {1.0,  1.5,  2.0,  3.0,  4.0,  5.0,  7.0, 10.0,
                                             15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0};
  return angles;
}

std::vector<NrcsSample> sample_model(const std::function<double(double grazing_rad)>& sigma0,
                                     const std::vector<double>& grazing_deg) {
  std::vector<NrcsSample> samples;
  for (const double angle_deg : grazing_deg)
    samples.push_back({core::radians(angle_deg), sigma0(core::radians(angle_deg))});
  return samples;
}

}  // namespace fanbeam::materials
