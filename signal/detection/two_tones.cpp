#include "signal/detection/two_tones.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kReach = 1.6, kStep = 0.1, kFinest = 1e-5;  // bins
constexpr double kLeastShare = 0.003;                        // of the stronger one's power
constexpr double kModelError = 1e-4;                         // of the energy
constexpr double kCloser = 0.02;                             // places nearer than that are one
constexpr int kMostMoves = 8;

using Sums = std::vector<std::complex<double>>;  // of every record

// Records about a peak: without its frequency and bend, summed over blocks of samples, which a tone within two
// bins hardly turns in; what it does is exact, a factor.
class Correlator {
 public:
  Correlator(const ToneRecords& records, double near_bin, double curvature_bins)
      : near_bin_(near_bin), samples_(records.front().size()) {
    block_ = std::max<std::size_t>(1, samples_ / kBlocks);
    while (samples_ % block_ != 0) --block_;
    const double middle = 0.5 * (count() - 1.0);
    std::vector<std::complex<double>> phasors;
    for (std::size_t n = 0; n < samples_; ++n) {
      const double t = (static_cast<double>(n) - middle) / count();
      phasors.push_back(unit_phasor(-near_bin * t - 0.5 * curvature_bins * t * t));
    }
    for (const auto& record : records) {
      blocks_.emplace_back(samples_ / block_);
      for (std::size_t n = 0; n < samples_; ++n)
        blocks_.back()[n / block_] += record[n] * phasors[n];
    }
  }
  double count() const { return static_cast<double>(samples_); }
  std::size_t records() const { return blocks_.size(); }

  // Of every record, with the phase of the middle sample.
  Sums at(double bin) const {
    const double off = bin - near_bin_, middle = 0.5 * (count() - 1.0);
    const auto size = static_cast<double>(block_);
    const std::complex<double> step = unit_phasor(-off * size / count());
    const std::complex<double> first = unit_phasor(-off * (0.5 * (size - 1.0) - middle) / count());
    const double whole = dirichlet(off, block_), scale = whole > 0.0 ? size / whole : 1.0;
    Sums sums;
    for (const auto& blocks : blocks_) {
      std::complex<double> sum = 0.0, phasor = first;
      for (const auto& block : blocks) {
        sum += block * phasor;
        phasor *= step;
      }
      sums.push_back(scale * sum);
    }
    return sums;
  }

  // Mean of exp(j 2 pi apart n / N) about the middle sample: real.
  double overlap(double apart) const { return dirichlet(apart, samples_) / count(); }

  // Energy that tones at the two places explain.
  double explained(const Sums& p, const Sums& q, double apart) const {
    const double rho = overlap(apart);
    double sum = 0.0;
    for (std::size_t c = 0; c < p.size(); ++c)
      sum += std::norm(p[c]) + std::norm(q[c]) - 2.0 * rho * (std::conj(p[c]) * q[c]).real();
    return sum / (count() * (1.0 - rho * rho));
  }

  Tone tone(double bin, const Sums& own, const Sums& other, double apart) const {
    const double rho = overlap(apart), scale = 1.0 / (count() * (1.0 - rho * rho));
    Tone tone;
    tone.bin = bin;
    const double middle_turns = bin * 0.5 * (count() - 1.0) / count();
    for (std::size_t c = 0; c < own.size(); ++c) {
      const std::complex<double> amplitude = scale * (own[c] - rho * other[c]);
      tone.amplitudes.push_back(amplitude * unit_phasor(-middle_turns));
      tone.power += std::norm(amplitude);
    }
    return tone;
  }

 private:
  static constexpr std::size_t kBlocks = 100;
  // Sum of exp(j 2 pi off n / N) over so many samples about their middle.
  double dirichlet(double off, std::size_t samples) const {
    const double x = core::kPi * off / count(), sine = std::sin(x);
    const auto length = static_cast<double>(samples);
    return std::abs(sine) < 1e-14 ? length : std::sin(length * x) / sine;
  }

  double near_bin_;
  std::size_t samples_, block_ = 1;
  ToneRecords blocks_;
};

struct Places {
  double first = 0.0, second = 0.0, energy = -1.0;
};

// The best pair with its places within `reach` of these, `step` apart.
Places best_near(const Correlator& correlator, const Places& centre, double reach, double step) {
  const auto grid = [&](double about) {
    std::vector<std::pair<double, Sums>> places;
    const int steps = static_cast<int>(std::lround(reach / step));
    for (int i = -steps; i <= steps; ++i)
      places.emplace_back(about + i * step, correlator.at(about + i * step));
    return places;
  };
  const auto first = grid(centre.first);
  const auto second = centre.first == centre.second ? first : grid(centre.second);
  Places best;
  for (const auto& [a, p] : first)
    for (const auto& [b, q] : second) {
      if (b - a < kCloser) continue;
      const double energy = correlator.explained(p, q, b - a);
      if (energy > best.energy) best = {a, b, energy};
    }
  return best;
}

// Of two in phase a coarser grid finds the middle and not how far they are apart: its best place may be beyond the
// finer one's edge, which then moves.
Places best_about(const Correlator& correlator, Places best, double step) {
  const double reach = 4.0 * step;
  for (int move = 0; move < kMostMoves; ++move) {
    const Places next = best_near(correlator, best, reach, step);
    const double moved =
        std::max(std::abs(next.first - best.first), std::abs(next.second - best.second));
    best = next;
    if (moved < reach - 0.5 * step) break;
  }
  return best;
}

double energy_of_one(const Correlator& correlator, double near_bin) {
  double centre = near_bin, best = -1.0;
  for (double step = 0.3; step > kFinest; step *= 0.5) {
    double place = centre;
    for (const double bin : {centre - step, centre, centre + step}) {
      double energy = 0.0;
      for (const auto& sum : correlator.at(bin)) energy += std::norm(sum);
      if (energy > best) {
        best = energy;
        place = bin;
      }
    }
    centre = place;
  }
  return best / correlator.count();
}

// A lone tone leaves nothing but noise in the bins beside its own: the cheap answer to most peaks.
bool leaves_more(const Correlator& correlator, double bin, double noise_W) {
  const auto energy_at = [&](double place) {
    double energy = 0.0;
    for (const auto& sum : correlator.at(place)) energy += std::norm(sum);
    return energy / correlator.count();
  };
  double beside = 0.0;
  for (const double off : {-2.0, -1.0, 1.0, 2.0}) beside += energy_at(bin + off);
  const double c = 4.0 * static_cast<double>(correlator.records());
  return beside > noise_W * (c + 6.0 * std::sqrt(c) + 20.0) &&
         beside > kModelError * energy_at(bin);
}

}  // namespace

std::optional<std::pair<Tone, Tone>> two_tones(const ToneRecords& records, double near_bin,
                                               double curvature_bins, double noise_W,
                                               double least_apart_bins) {
  if (records.empty() || records.front().size() < 2)
    refuse("samples", records.empty() ? 0.0 : static_cast<double>(records.front().size()),
           "2 or more");
  check_not_negative("noise_W", noise_W);
  const Correlator correlator(records, near_bin, curvature_bins);
  if (!leaves_more(correlator, near_bin, noise_W)) return std::nullopt;
  Places best = best_near(correlator, {near_bin, near_bin, 0.0}, kReach, kStep);
  // Of two whose phases oppose the peak may be beyond the stronger one.
  const double middle = 0.5 * (best.first + best.second);
  if (std::max(near_bin - best.first, best.second - near_bin) > kReach - kStep)
    best = best_near(correlator, {middle, middle, 0.0}, kReach, kStep);
  for (double step = 0.25 * kStep; step > kFinest; step *= 0.25)
    best = best_about(correlator, best, step);
  const auto c = static_cast<double>(correlator.records());
  const double gained = best.energy - energy_of_one(correlator, near_bin);
  if (!(gained > noise_W * (c + 6.0 * std::sqrt(c) + 20.0) && gained > kModelError * best.energy) ||
      best.second - best.first < least_apart_bins)
    return std::nullopt;
  const Sums p = correlator.at(best.first), q = correlator.at(best.second);
  const double apart = best.second - best.first;
  std::pair<Tone, Tone> tones{correlator.tone(best.first, p, q, apart),
                              correlator.tone(best.second, q, p, apart)};
  if (std::min(tones.first.power, tones.second.power) <
      kLeastShare * std::max(tones.first.power, tones.second.power))
    return std::nullopt;
  return tones;
}

}  // namespace fanbeam::signal
