#include "tracking/simulation/beat_waves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/constants.h"
#include "signal/angle/angle_peak.h"
#include "tracking/simulation/directions.h"

namespace fanbeam::tracking {
namespace {

using Complex = std::complex<double>;

constexpr double kFineLeft = 1e-4;  // of the energy: what neighbours leave beside a wave
constexpr std::size_t kWaveBlocks = 100;
constexpr int kMostSteps = 20;
constexpr double kEnded_bins = 1e-7;
constexpr double kNearBy_bins = 1.0;  // farther than that a fit has gone to another tone
constexpr double kBent_bins = 1e-3;   // a difference that moves nothing

Complex turned(double turns) { return std::polar(1.0, 2.0 * core::kPi * turns); }

// Of one element's amplitude.
double amplitude_noise_W(const SoughtRamp& ramp, const Beat& beat) {
  return beat.amplitude_noise_ratio * ramp.noise_W /
         static_cast<double>(ramp.records.front().size());
}

// What the wave's curvature adds to its phase at an element, in turns.
double curved_turns(const ReceiverLine& line, std::size_t element, double sine, double range_m) {
  const double place_m = line.elements_m[element].y;
  return 0.5 * place_m * place_m * (1.0 - sine * sine) / (range_m * line.wavelength_m);
}

double wave_turns(const ReceiverLine& line, std::size_t element, double sine, double range_m) {
  return curved_turns(line, element, sine, range_m) -
         sine * line.elements_m[element].y / line.wavelength_m;
}

// Its amplitudes become those of plane waves.
void find_direction(const SoughtRamp& ramp, const ReceiverLine& line, double range_m, Beat& beat) {
  const double noise_W = amplitude_noise_W(ramp, beat);
  const double seen_sine = std::sin(
      signal::azimuth_peak(beat.amplitudes, line.elements_m, line.wavelength_m).azimuth_rad);
  for (std::size_t c = 0; c < beat.amplitudes.size(); ++c)
    beat.amplitudes[c] *= turned(-curved_turns(line, c, seen_sine, range_m));
  beat.azimuth_rad =
      signal::azimuth_peak(beat.amplitudes, line.elements_m, line.wavelength_m).azimuth_rad;
  beat.azimuth_sigma_rad =
      direction_sigmas_rad(beat.amplitudes, {beat.azimuth_rad}, line.pitch_wavelengths, noise_W)[0];
  beat.lone_wave =
      is_lone_wave(beat.amplitudes, line.elements_m, line.wavelength_m, beat.azimuth_rad, kFineLeft,
                   static_cast<double>(beat.amplitudes.size()) * noise_W);
}

// One of the two: its amplitude, its beat and bend about the tone's, the sine of its azimuth. The bend is known.
struct Wave {
  Complex amplitude = 0.0;
  double bin = 0.0, sine = 0.0, bend_bins = 0.0;
};
constexpr int kOfOne = 4, kOfBoth = 2 * kOfOne;
using Normal = Eigen::Matrix<double, kOfBoth, kOfBoth>;
using Step = Eigen::Matrix<double, kOfBoth, 1>;
struct PairFit {
  std::array<Wave, 2> waves;
  Normal normal = Normal::Zero();  // the lower half
  double left_W = 0.0;             // of the samples
};

// The samples about a tone and two waves in them. Means over blocks: within a bin or two of the tone a wave hardly turns
// in one, and loses the same in all of them.
class WavePair {
 public:
  WavePair(const signal::ToneRecords& records, const BentTone& tone, const ReceiverLine& line,
           double range_m, double sweep)
      : line_(line), range_m_(range_m), sweep_(sweep), samples_(records.front().size()) {
    block_ = std::max<std::size_t>(1, samples_ / kWaveBlocks);
    const auto count = static_cast<double>(samples_);
    blocks_.assign(records.size(), std::vector<Complex>(samples_ / block_));
    for (std::size_t n = 0; n < samples_ / block_ * block_; ++n) {
      const double t = (static_cast<double>(n) - 0.5 * (count - 1.0)) / count;
      const Complex unbeaten = turned(-tone.tone.bin * t - 0.5 * tone.curvature_bins * t * t) /
                               static_cast<double>(block_);
      for (std::size_t c = 0; c < records.size(); ++c)
        blocks_[c][n / block_] += records[c][n] * unbeaten;
    }
  }

  // From these places, of no amplitude, if it ends near by.
  std::optional<PairFit> fit(const std::array<Wave, 2>& start) const {
    PairFit fit{start};
    // The amplitudes alone first: what a wave of none would be moved by is nothing.
    for (int turn = 0; turn <= kMostSteps; ++turn) {
      Step downhill;
      make_equations(fit, downhill);
      if (turn == 0) {
        for (const int i : {2, 3, 6, 7}) {
          fit.normal.row(i).setZero();
          fit.normal.col(i).setZero();
          fit.normal(i, i) = 1.0;
          downhill(i) = 0.0;
        }
      }
      const Eigen::LLT<Normal> root(fit.normal);
      if (root.info() != Eigen::Success) return std::nullopt;
      const Step step = root.solve(downhill);
      for (int i = 0; i < 2; ++i) {
        Wave& wave = fit.waves[static_cast<std::size_t>(i)];
        wave.amplitude += Complex(step(kOfOne * i), step(kOfOne * i + 1));
        wave.bin += step(kOfOne * i + 2);
        wave.sine += step(kOfOne * i + 3);
        const double moved_bins = wave.bin - start[static_cast<std::size_t>(i)].bin;
        if (!(std::abs(moved_bins) < kNearBy_bins) || !(std::abs(wave.sine) < 1.0))
          return std::nullopt;
      }
      if (turn > 0 && std::max(std::abs(step(2)), std::abs(step(6))) < kEnded_bins) return fit;
    }
    return std::nullopt;
  }

  // Deviations of bin and sine of each wave for this noise of a sample: the Cramer-Rao bound where it ended.
  std::array<std::array<double, 2>, 2> sigmas(const PairFit& fit, double noise_W) const {
    const Normal inverse = fit.normal.llt().solve(Normal::Identity());
    const double scale = 0.5 * noise_W / static_cast<double>(block_);
    std::array<std::array<double, 2>, 2> result{};
    for (int i = 0; i < kOfBoth; i += kOfOne)
      for (int k = 0; k < 2; ++k)
        result[static_cast<std::size_t>(i / kOfOne)][static_cast<std::size_t>(k)] =
            std::sqrt(scale * inverse(i + 2 + k, i + 2 + k));
    return result;
  }

 private:
  // Sums over blocks and channels of what the fit leaves, by how the waves change it.
  void make_equations(PairFit& fit, Step& downhill) const {
    fit.normal.setZero();
    downhill.setZero();
    fit.left_W = 0.0;
    const auto count = static_cast<double>(samples_);
    for (std::size_t c = 0; c < blocks_.size(); ++c) {
      const double place_m = line_.elements_m[c].y;
      for (std::size_t b = 0; b < blocks_[c].size(); ++b) {
        const double middle = (static_cast<double>(b) + 0.5) * static_cast<double>(block_);
        const double t = (middle - 0.5 * count) / count;
        Complex left = blocks_[c][b];
        std::array<Complex, kOfBoth> by;
        for (std::size_t i = 0; i < 2; ++i) {
          const Wave& wave = fit.waves[i];
          const double turns = wave_turns(line_, c, wave.sine, range_m_);
          const Complex unit =
              turned(wave.bin * t + 0.5 * wave.bend_bins * t * t + turns * (1.0 + sweep_ * t));
          const Complex turning = Complex(0.0, 2.0 * core::kPi) * wave.amplitude * unit;
          const double by_sine =
              -place_m * (1.0 + wave.sine * place_m / range_m_) / line_.wavelength_m;
          by[kOfOne * i] = unit;
          by[kOfOne * i + 1] = Complex(0.0, 1.0) * unit;
          by[kOfOne * i + 2] = turning * t;
          by[kOfOne * i + 3] = turning * by_sine * (1.0 + sweep_ * t);
          left -= wave.amplitude * unit;
        }
        fit.left_W += std::norm(left);
        for (int i = 0; i < kOfBoth; ++i) {
          const Complex conjugate = std::conj(by[static_cast<std::size_t>(i)]);
          downhill(i) += (conjugate * left).real();
          for (int j = 0; j <= i; ++j)
            fit.normal(i, j) += (conjugate * by[static_cast<std::size_t>(j)]).real();
        }
      }
    }
  }

  const ReceiverLine& line_;
  double range_m_, sweep_;
  std::size_t samples_, block_ = 1;
  signal::ToneRecords blocks_;
};

// Beats become those of two waves, in what the other tones leave.
class Splitter {
 public:
  Splitter(const SoughtRamp& ramp, const ReceiverLine& line)
      : ramp_(ramp), line_(line), rest_(ramp.records) {
    for (const RampTone& one : ramp.tones) add(one.bent, -1.0, rest_);
  }

  // Tones from `first` to `last` as two waves.
  bool to_waves(std::size_t first, std::size_t last, const std::array<Wave, 2>& start,
                std::array<Beat, 2>& beats) const {
    signal::ToneRecords own = rest_;
    for (std::size_t i = first; i <= last; ++i) add(ramp_.tones[i].bent, 1.0, own);
    const double range_m = ramp_.near[first].range_m;
    const BentTone& about = ramp_.tones[first].bent;
    const NearPlaces &one_near = ramp_.near[first], &other_near = ramp_.near[last];
    const double low = std::min(one_near.least_bend_bins, other_near.least_bend_bins);
    const double high = std::max(one_near.most_bend_bins, other_near.most_bend_bins);
    const WavePair pair(own, about, line_, range_m, ramp_.sweep);
    const std::optional<PairFit> fit =
        best_fit(pair, start, low - about.curvature_bins, high - about.curvature_bins);
    if (!fit) return false;
    const bool bent_alike = fit->waves[0].bend_bins == fit->waves[1].bend_bins;
    const auto sigmas = pair.sigmas(*fit, ramp_.noise_W);
    const auto count = static_cast<double>(own.front().size());
    for (std::size_t i = 0; i < 2; ++i) {
      const Wave& wave = fit->waves[i];
      Beat& one = beats[i];
      const double bin =
          about.tone.bin + wave.bin + 0.5 * (about.curvature_bins + wave.bend_bins) / count;
      one.Hz = (bin - count * std::floor((bin + 0.5 * count) / count)) * ramp_.bin_Hz;
      const std::size_t tone = i == 0 ? first : last;
      const double unknown_bins =
          bent_alike ? ramp_.unknown_bins[tone] : ramp_.tones[tone].bent.unsettled_bins;
      one.sigma_Hz = std::min(1.0, std::hypot(sigmas[i][0], unknown_bins)) * ramp_.bin_Hz;
      one.settled_bins = 0.0;
      one.signal_to_noise =
          count * std::norm(wave.amplitude) * static_cast<double>(own.size()) / ramp_.noise_W;
      one.azimuth_rad = std::asin(wave.sine);
      one.azimuth_sigma_rad = sigmas[i][1] / std::cos(one.azimuth_rad);
      one.lone_wave = true;
      for (std::size_t c = 0; c < own.size(); ++c)
        one.amplitudes[c] = wave.amplitude * turned(wave_turns(line_, c, wave.sine, range_m));
    }
    return true;
  }

 private:
  // Two targets of different speeds bend differently, and which is which is what fits best.
  static std::optional<PairFit> best_fit(const WavePair& pair, std::array<Wave, 2> start,
                                         double low, double high) {
    std::vector<std::array<double, 2>> bends = {{0.0, 0.0}};
    if (high - low > kBent_bins) bends.insert(bends.end(), {{low, high}, {high, low}});
    std::optional<PairFit> best;
    for (const auto& [first, second] : bends) {
      start[0].bend_bins = first;
      start[1].bend_bins = second;
      const std::optional<PairFit> one = pair.fit(start);
      if (one && (!best || one->left_W < best->left_W)) best = one;
    }
    return best;
  }

  const SoughtRamp& ramp_;
  const ReceiverLine& line_;
  signal::ToneRecords rest_;
};

// A tone of two directions, if it has two.
std::optional<std::array<Wave, 2>> waves_in(const SoughtRamp& ramp, const ReceiverLine& line,
                                            const Beat& beat) {
  const std::vector<double> directions =
      directions_rad(beat.amplitudes, line.elements_m, line.wavelength_m, line.beam_sine,
                     amplitude_noise_W(ramp, beat), kLeastDirections);
  if (directions.size() < 2) return std::nullopt;
  return std::array{Wave{0.0, 0.0, std::sin(directions[0])},
                    Wave{0.0, 0.0, std::sin(directions[1])}};
}

}  // namespace

std::vector<Beat> by_direction(const SoughtRamp& ramp, const ReceiverLine& line,
                               std::vector<Beat> beats) {
  if (line.elements_m.size() < 2) return beats;
  for (std::size_t i = 0; i < beats.size(); ++i)
    find_direction(ramp, line, ramp.near[i].range_m, beats[i]);
  std::optional<Splitter> splitter;
  std::vector<Beat> result;
  for (std::size_t i = 0; i < beats.size(); ++i) {
    const bool two_tones = ramp.tones[i].jointly;
    const std::size_t last = two_tones ? i + 1 : i;
    std::optional<std::array<Wave, 2>> start;
    if (two_tones && beats[i].lone_wave && beats[last].lone_wave)
      start = {Wave{0.0, 0.0, std::sin(beats[i].azimuth_rad)},
               Wave{0.0,
                    std::remainder(ramp.tones[last].bent.tone.bin - ramp.tones[i].bent.tone.bin,
                                   static_cast<double>(ramp.records.front().size())),
                    std::sin(beats[last].azimuth_rad)}};
    else if (!two_tones && !beats[i].lone_wave)
      start = waves_in(ramp, line, beats[i]);
    std::array<Beat, 2> two = {beats[i], beats[last]};
    if (start && !splitter) splitter.emplace(ramp, line);
    if (start && splitter->to_waves(i, last, *start, two))
      result.insert(result.end(), two.begin(), two.end());
    else
      result.insert(result.end(), beats.begin() + static_cast<std::ptrdiff_t>(i),
                    beats.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    i = last;
  }
  return result;
}

}  // namespace fanbeam::tracking
