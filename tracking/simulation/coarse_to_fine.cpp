#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "core/constants.h"
#include "signal/pairing/ghost_free.h"
#include "tracking/simulation/directions.h"
#include "tracking/simulation/simulation_private.h"

namespace fanbeam::tracking {
namespace {

// Of two waves in phase, x of c / (N d) apart, one leaves (pi x)^4 / 720 of the energy; that has to be more than noise
// gives (signal/detection/two_tones.h, one record).
constexpr double kSurelyMore = 27.0, kBeamCells = 0.8859;
constexpr double kMostMisfit = 4.0;  // of directions, over what they may be apart

// Targets that the coarse stage cannot tell apart become one.
std::vector<Seen> merged(std::vector<Seen> targets,
                         const std::function<bool(const Seen&, const Seen&)>& together) {
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (std::size_t j = i + 1; j < targets.size();) {
      Seen &a = targets[i], &b = targets[j];
      if (!together(a, b)) {
        ++j;
        continue;
      }
      const double share = a.power / (a.power + b.power);
      a.range_m = share * a.range_m + (1.0 - share) * b.range_m;
      a.rate_mps = share * a.rate_mps + (1.0 - share) * b.rate_mps;
      a.azimuth_rad = share * a.azimuth_rad + (1.0 - share) * b.azimuth_rad;
      a.power += b.power;
      a.merged = true;
      targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(j));
    }
  return targets;
}

// A chirp sequence has cells of range, speed and azimuth; the flat stretch none of range.
std::vector<Seen> coarse_targets(const std::vector<Seen>& targets, const core::HighwayRadar& radar,
                                 const SimulationSettings& settings) {
  const bool coded = settings.scheme == Scheme::coded;
  const double wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  const double cell_m = core::kSpeedOfLight_mps / (2.0 * radar.bandwidth_Hz);
  const double cell_mps =
      wavelength_m /
      (2.0 * (coded ? radar.waveforms.flat_s
                    : radar.waveforms.coarse_chirps * radar.waveforms.coarse_chirp_s));
  return merged(targets, [&](const Seen& a, const Seen& b) {
    return (coded || std::abs(a.range_m - b.range_m) < settings.merge_bins * cell_m) &&
           std::abs(a.rate_mps - b.rate_mps) < settings.merge_bins * cell_mps &&
           std::abs(std::sin(a.azimuth_rad) - std::sin(b.azimuth_rad)) <
               one_direction(radar, settings.scheme, std::min(a.power, b.power));
  });
}

signal::RangeSpeed coarse_sigma(const Seen& target, const core::HighwayRadar& radar,
                                const SimulationSettings& settings) {
  if (settings.scheme != Scheme::coded)
    return {settings.coarse_range_sigma_m, settings.coarse_speed_sigma_mps};
  const double ratio = target.bound.signal_to_noise * radar.waveforms.flat_s / radar.ramp_s;
  const double wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  return {
      core::kSpeedOfLight_mps / (4.0 * core::kPi * radar.waveforms.hop_Hz) * std::sqrt(2.0 / ratio),
      0.5 * wavelength_m * std::sqrt(6.0 / ratio) / (2.0 * core::kPi * radar.waveforms.flat_s)};
}

// What has been measured so far, and which beats it explains.
class FoundPairs {
 public:
  explicit FoundPairs(const RampPeaks& peaks)
      : peaks_(peaks), up_(peaks.up.Hz.size(), false), down_(peaks.down.Hz.size(), false) {}

  // A lone beat is of one target.
  bool can_be(const PairOfPeaks& pair) const {
    return !(up_[pair.up] && is_lone(peaks_.up, pair.up)) &&
           !(down_[pair.down] && is_lone(peaks_.down, pair.down)) &&
           !(up_[pair.up] && down_[pair.down]);
  }
  void add(const RadarMeasurement& measurement, const PairOfPeaks& pair) {
    measurements.push_back(measurement);
    up_[pair.up] = down_[pair.down] = true;
  }

  std::vector<RadarMeasurement> measurements;

 private:
  static bool is_lone(const Peaks& peaks, std::size_t i) { return peaks.spread_Hz[i] == 0.0; }

  const RampPeaks& peaks_;
  std::vector<bool> up_, down_;
};

// How far apart the directions of two beats are, over what two beats of one target may be.
double direction_misfit(const RampPeaks& peaks, const PairOfPeaks& pair, double sigma_rad) {
  const double apart_rad = peaks.up.azimuth_rad[pair.up] - peaks.down.azimuth_rad[pair.down];
  return std::abs(apart_rad) /
         (sigma_rad + peaks.up.spread_rad[pair.up] + peaks.down.spread_rad[pair.down]);
}

// The beats that may come from where a coarse target is seen; all for a radar that has no directions.
std::vector<double> from_direction(const Peaks& peaks, const Seen& target,
                                   const core::HighwayRadar& radar, Scheme scheme) {
  if (radar.array_elements < 2) return peaks.Hz;
  const double own_rad = target.bound.azimuth_sigma_rad +
                         (target.merged ? one_direction(radar, scheme, target.power) : 0.0);
  std::vector<double> result;
  for (std::size_t i = 0; i < peaks.Hz.size(); ++i)
    if (std::abs(peaks.azimuth_rad[i] - target.azimuth_rad) <=
        kMostMisfit * (own_rad + peaks.spread_rad[i]))
      result.push_back(peaks.Hz[i]);
  return result;
}

// A flat stretch has no cells of range: of targets that share its speed it tells a range between them. What
// is left are the pairs of beats with one of their speeds that come from one direction, those that agree best
// first; crossed pairs have another speed by 1 m/s for every 0.6 m.
void add_pairs_of_speed(const signal::TriangleModel& fine, const RampPeaks& peaks,
                        const std::vector<Seen>& coarse, const core::HighwayRadar& radar,
                        const SimulationSettings& settings, FoundPairs& found) {
  struct Candidate {
    double misfit;
    signal::RangeSpeed place;
    PairOfPeaks pair;
  };
  const double cell_mps =
      0.5 * core::kSpeedOfLight_mps / radar.centre_frequency_Hz / radar.waveforms.flat_s;
  const signal::PairingLimits limits{0.0, 1.1 * radar.most_range_m, settings.most_speed_mps};
  std::vector<Candidate> candidates;
  for (const signal::RangeSpeed& place :
       signal::pair_all(fine, peaks.up.Hz, peaks.down.Hz, limits)) {
    const PairOfPeaks pair = peaks_at(fine, peaks, place);
    for (const Seen& one : coarse) {
      if (std::abs(place.radial_speed_mps - one.rate_mps) > settings.merge_bins * cell_mps)
        continue;
      const double misfit = direction_misfit(peaks, pair, one.bound.azimuth_sigma_rad);
      if (misfit <= kMostMisfit) candidates.push_back({misfit, place, pair});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
  for (const auto& [misfit, place, pair] : candidates)
    if (found.can_be(pair)) found.add(measured_pair(fine, peaks, place, radar), pair);
}

}  // namespace

double one_direction(const core::HighwayRadar& radar, Scheme scheme, double signal_to_noise) {
  if (radar.array_elements < 2) return std::numeric_limits<double>::infinity();
  const double in_phase = std::pow(720.0 * kSurelyMore / signal_to_noise, 0.25) / core::kPi;
  const double cells = scheme == Scheme::coded ? kBeamCells : std::max(kLeastDirections, in_phase);
  return cells / (radar.array_elements * radar.array_pitch_wavelengths);
}

std::vector<RadarMeasurement> coarse_to_fine(
    const signal::TriangleModel& fine, const RampPeaks& peaks, const std::vector<Seen>& targets,
    const core::HighwayRadar& radar, const SimulationSettings& settings, const Draws& draws) {
  const std::vector<Seen> coarse = coarse_targets(targets, radar, settings);
  FoundPairs found(peaks);
  std::vector<Seen> by_speed_alone;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const signal::RangeSpeed sigma = coarse_sigma(coarse[i], radar, settings);
    const auto noise = draws.normal(i, 3);
    const signal::RangeSpeed place{coarse[i].range_m + sigma.range_m * noise[0],
                                   coarse[i].rate_mps + sigma.radial_speed_mps * noise[1]};
    signal::TwoStageOptions options;
    // Merged beats are up to 0.6 bin away, whatever the coarse stage knows.
    options.coarse_range_sigma_m = std::max(sigma.range_m, settings.coarse_range_sigma_m);
    options.coarse_speed_sigma_mps =
        std::max(sigma.radial_speed_mps, settings.coarse_speed_sigma_mps);
    const std::optional<signal::RangeSpeed> refined =
        signal::refine_two_stage({place},
                                 {fine, from_direction(peaks.up, coarse[i], radar, settings.scheme),
                                  from_direction(peaks.down, coarse[i], radar, settings.scheme)},
                                 options)
            .front();
    if (settings.scheme == Scheme::coded && (!refined || coarse[i].merged)) {
      by_speed_alone.push_back(coarse[i]);
      continue;
    }
    if (!refined) continue;
    const PairOfPeaks pair = peaks_at(fine, peaks, *refined);
    RadarMeasurement measured = with_sigmas(*refined, coarse[i].azimuth_rad, coarse[i].bound);
    state_spread(fine, peaks, pair, measured);
    // Two directions, evenly as far apart as one may be, as for merged beats; half a circle for one receiver.
    if (coarse[i].merged)
      measured.azimuth_systematic_rad =
          std::min(core::kPi, one_direction(radar, settings.scheme, coarse[i].power)) /
          std::sqrt(12.0);
    found.add(measured, pair);
  }
  add_pairs_of_speed(fine, peaks, by_speed_alone, radar, settings, found);
  return found.measurements;
}

}  // namespace fanbeam::tracking
