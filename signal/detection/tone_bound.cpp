#include "signal/detection/tone_bound.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kNear_bins = 6.0;
constexpr double kSame_bins = 1e-3;
constexpr double kNever = std::numeric_limits<double>::infinity();

// Sums over the samples about their middle, all real: of the phasor, its derivative, the second less
// its sign.
struct Overlaps {
  double plain = 0.0, slope = 0.0, square = 0.0;
};

Overlaps overlaps(double apart_bins, std::size_t samples) {
  Overlaps sums;
  const auto count = static_cast<double>(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = 2.0 * core::kPi * (static_cast<double>(n) - 0.5 * (count - 1.0)) / count;
    const double cosine = std::cos(apart_bins * t);
    sums.plain += cosine;
    sums.slope -= t * std::sin(apart_bins * t);
    sums.square += t * t * cosine;
  }
  return sums;
}

// Places are periodic: the nearest of the other's.
double bins_to(const Tone& one, const Tone& other, std::size_t samples) {
  return std::remainder(other.bin - one.bin, static_cast<double>(samples));
}

// Sum over the records of conj(A_i) A_j, both at the middle sample.
double shared_power(const Tone& one, const Tone& other, double apart_bins, std::size_t samples) {
  std::complex<double> sum = 0.0;
  for (std::size_t c = 0; c < one.amplitudes.size(); ++c)
    sum += std::conj(one.amplitudes[c]) * other.amplitudes[c];
  const auto count = static_cast<double>(samples);
  return (sum * unit_phasor(apart_bins * 0.5 * (count - 1.0) / count)).real();
}

ToneBound alone(const Tone& tone, std::size_t samples, double noise_W) {
  const auto count = static_cast<double>(samples);
  const double square = (count * count - 1.0) / (count * count);
  return {tone.power > 0.0
              ? 6.0 * noise_W / (4.0 * core::kPi * core::kPi * count * tone.power * square)
              : kNever,
          1.0};
}

// To more than what rounding leaves.
bool definite(const Eigen::LLT<Eigen::MatrixXd>& matrix) {
  return matrix.info() == Eigen::Success && matrix.rcond() > 1e-12;
}

// Of the first of these.
ToneBound among(const std::vector<const Tone*>& tones, std::size_t samples, double noise_W) {
  const auto k = static_cast<Eigen::Index>(tones.size());
  Eigen::MatrixXd plain(k, k), slope(k, k), square(k, k), power(k, k);
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) {
      const Tone &one = *tones[static_cast<std::size_t>(i)],
                 &other = *tones[static_cast<std::size_t>(j)];
      const double apart_bins =
          bins_to(*tones[0], other, samples) - bins_to(*tones[0], one, samples);
      const Overlaps sums = overlaps(apart_bins, samples);
      plain(i, j) = sums.plain;
      slope(i, j) = sums.slope;
      square(i, j) = sums.square;
      power(i, j) = shared_power(one, other, apart_bins, samples);
    }
  // Positive definite, but for tones that nothing tells apart.
  const Eigen::LLT<Eigen::MatrixXd> amplitudes(plain);
  if (!definite(amplitudes)) return {kNever, kNever};
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(k, k);
  const Eigen::MatrixXd inverse = amplitudes.solve(unit), leaks = amplitudes.solve(slope);
  const Eigen::MatrixXd left = square - slope.transpose() * leaks;
  const Eigen::LLT<Eigen::MatrixXd> places(left.cwiseProduct(power));
  if (!definite(places)) return {kNever, kNever};
  const Eigen::MatrixXd per_noise = 0.5 * places.solve(unit);
  double leaked = 0.0;
  for (Eigen::Index j = 1; j < k; ++j)
    leaked += leaks(0, j) * leaks(0, j) * per_noise(j, j) * power(j, j);
  const double variance = noise_W * per_noise(0, 0);
  const double noise_ratio = static_cast<double>(samples) * (inverse(0, 0) + leaked);
  const bool known = variance >= 0.0 && noise_ratio >= 0.0 && std::isfinite(variance);
  return known ? ToneBound{variance, noise_ratio} : ToneBound{kNever, kNever};
}

}  // namespace

std::vector<ToneBound> tone_bounds(const std::vector<Tone>& tones, std::size_t samples,
                                   double noise_W) {
  if (samples < 2) refuse("samples", static_cast<double>(samples), "2 or more");
  check_not_negative("noise_W", noise_W);
  for (const Tone& tone : tones) {
    check_finite("tones.bin", {std::complex<double>(tone.bin)});
    check_finite("tones.amplitudes", tone.amplitudes);
    if (tone.amplitudes.size() != tones.front().amplitudes.size())
      refuse("tones.amplitudes", static_cast<double>(tone.amplitudes.size()),
             "as many for each tone");
  }
  std::vector<ToneBound> bounds;
  for (const Tone& tone : tones) {
    std::vector<const Tone*> near{&tone};
    bool twice = false;
    for (const Tone& other : tones) {
      if (&other == &tone || !(other.power > 0.0)) continue;
      twice = twice || std::abs(bins_to(tone, other, samples)) < kSame_bins;
      if (std::abs(bins_to(tone, other, samples)) < kNear_bins &&
          std::none_of(near.begin() + 1, near.end(), [&](const Tone* one) {
            return std::abs(bins_to(*one, other, samples)) < kSame_bins;
          }))
        near.push_back(&other);
    }
    bounds.push_back(twice              ? ToneBound{kNever, kNever}
                     : near.size() == 1 ? alone(tone, samples, noise_W)
                                        : among(near, samples, noise_W));
  }
  return bounds;
}

}  // namespace fanbeam::signal
