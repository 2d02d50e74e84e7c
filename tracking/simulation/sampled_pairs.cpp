// Beats of a triangle to targets: which two belong together, and what they say.
#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/pairing/triangle.h"
#include "tracking/simulation/measurement_bound.h"
#include "tracking/simulation/sampled_frame.h"

namespace fanbeam::tracking {
namespace {

constexpr double kCoarseSigma_m = 0.3, kCoarseSigma_mps = 0.3;
// Side lobes of neighbours, the bend of beats, the direction of a moving target.
constexpr double kSystematic_m = 0.005, kSystematic_mps = 0.005, kSystematic_rad = 5e-4;
// Of a beam: farther apart two directions are two coarse detections.
constexpr double kOneCell = 0.6;
constexpr double kNowhere_Hz = 1e15;
constexpr double kUnresolved_bins = 0.7;  // between tones that could be two

}  // namespace

double SampledRadar::misfit(const signal::TriangleModel& model, const SampledBeats& beats,
                            std::size_t up, std::size_t down, const signal::RangeSpeed& coarse) {
  const signal::RangeSpeed pair = solve(model, {beats.up[up].Hz, beats.down[down].Hz});
  const Beat &rising = beats.up[up], &falling = beats.down[down];
  const double disagreement = rising.lone_wave && falling.lone_wave
                                  ? (rising.azimuth_rad - falling.azimuth_rad) / kAgree_rad
                                  : 0.0;
  return std::pow((pair.range_m - coarse.range_m) / kCoarseSigma_m, 2) +
         std::pow((pair.radial_speed_mps - coarse.radial_speed_mps) / kCoarseSigma_mps, 2) +
         disagreement * disagreement;
}

// The pair of beats that fits a coarse place best, if any does and better than `best`.
void SampledRadar::try_place(const signal::TriangleModel& model, const SampledBeats& beats,
                             const signal::RangeSpeed& coarse, Pair& best) {
  for (std::size_t i = 0; i < beats.up.size(); ++i)
    for (std::size_t j = 0; j < beats.down.size(); ++j) {
      const double one = misfit(model, beats, i, j, coarse);
      if (one < best.misfit)
        best = {one, i, j, coarse, solve(model, {beats.up[i].Hz, beats.down[j].Hz}), true};
    }
}

namespace {

// The beats that share the peak of this one.
std::vector<std::size_t> of_peak(const std::vector<Beat>& beats, std::size_t one) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < beats.size(); ++i)
    if (beats[i].peak == beats[one].peak) result.push_back(i);
  return result;
}

}  // namespace

// Two coarse detections of one pair and one direction are one target.
bool SampledRadar::seen_before(const std::vector<Found>& found, const Found& one, double apart) {
  return std::any_of(found.begin(), found.end(), [&](const Found& other) {
    return other.up == one.up && other.down == one.down &&
           std::abs(std::sin(other.azimuth_rad) - std::sin(one.azimuth_rad)) < apart;
  });
}

void SampledRadar::add(const std::vector<Found>& more, std::vector<Found>& found) const {
  for (const Found& one : more)
    if (!seen_before(found, one, 0.5 * beam_sine())) found.push_back(one);
}

// Without those of pairs that are found: their frequencies are out of reach.
SampledBeats SampledRadar::left_over(SampledBeats beats, const std::vector<Found>& found) {
  for (const Found& one : found) {
    beats.up[one.up].Hz = beats.down[one.down].Hz = kNowhere_Hz;
  }
  return beats;
}

// The pair as it is, or where a beat of it is one of two tones of a peak, both targets: each with the
// beat of the other ramp, near enough in range and speed, that comes from its direction.
std::vector<SampledRadar::Found> SampledRadar::apart(const signal::TriangleModel& model,
                                                     const SampledBeats& beats, const Pair& best,
                                                     const Coarse& coarse) const {
  const std::vector<std::size_t> up = of_peak(beats.up, best.up);
  const std::vector<std::size_t> down = of_peak(beats.down, best.down);
  // The coarse cell's direction, whose neighbours in speed are out of the way; where another target pulls it,
  // the triangle's, if that is one target's.
  const auto as_it_is = [&] {
    const Beat &rising = beats.up[best.up], &falling = beats.down[best.down];
    const double fine_rad = 0.5 * (rising.azimuth_rad + falling.azimuth_rad);
    const bool fine =
        !coarse.lone_wave && coarse.directions == 1 && rising.lone_wave && falling.lone_wave &&
        std::abs(std::sin(fine_rad) - std::sin(coarse.azimuth_rad)) < kOneCell * beam_sine();
    // Two directions of one pair of beats: its range and speed are of both.
    const bool shared = coarse.directions > 1 && !(rising.lone_wave && falling.lone_wave);
    return Found{best.up,    best.down,
                 best.place, fine ? fine_rad : coarse.azimuth_rad,
                 shared,     !fine && !coarse.lone_wave && coarse.directions == 1};
  };
  if (up.size() == 1 && down.size() == 1) return {as_it_is()};
  const bool by_up = up.size() > 1;
  const std::vector<Beat>& others = by_up ? beats.down : beats.up;
  std::vector<Found> result;
  for (const std::size_t one : by_up ? up : down) {
    const double own_rad = (by_up ? beats.up : beats.down)[one].azimuth_rad;
    std::size_t other = by_up ? best.down : best.up;
    double apart_rad = kAgree_rad, azimuth = own_rad;
    bool alone = false;
    for (std::size_t k = 0; k < others.size(); ++k) {
      const std::size_t i = by_up ? one : k, j = by_up ? k : one;
      if (!(misfit(model, beats, i, j, best.coarse) < Pair{}.misfit)) continue;
      const double theirs_rad = others[k].azimuth_rad;
      if (std::abs(theirs_rad - own_rad) >= apart_rad) continue;
      apart_rad = std::abs(theirs_rad - own_rad);
      azimuth = 0.5 * (theirs_rad + own_rad);
      other = k;
      alone = true;
    }
    const std::size_t i = by_up ? one : other, j = by_up ? other : one;
    // The tone of a target that is elsewhere and only shares this peak.
    if (!alone && !(misfit(model, beats, i, j, best.coarse) < Pair{}.misfit)) continue;
    if (std::abs(std::sin(azimuth) - std::sin(coarse.azimuth_rad)) > kOneCell * beam_sine())
      continue;
    result.push_back(
        {i, j, solve(model, {beats.up[i].Hz, beats.down[j].Hz}), azimuth, !alone, false});
  }
  if (result.empty()) result.push_back(as_it_is());
  return result;
}

RadarMeasurement SampledRadar::measured(const SampledBeats& beats, const Found& one) const {
  const double ratio =
      std::min(beats.up[one.up].signal_to_noise, beats.down[one.down].signal_to_noise);
  const MeasurementBound bound = bound_at(radar_, ratio, one.azimuth_rad);
  const double wider = std::sqrt(beats.variance_ratio);
  RadarMeasurement measurement{one.place.range_m,
                               one.place.radial_speed_mps,
                               one.azimuth_rad,
                               wider * bound.range_sigma_m,
                               wider * bound.range_rate_sigma_mps,
                               bound.azimuth_sigma_rad,
                               kSystematic_m,
                               kSystematic_mps,
                               kSystematic_rad};
  if (one.half_merged || one.merged) {
    // One beat or both are those of two targets less than a third of a bin apart.
    const double bins = kUnresolved_bins / std::sqrt(12.0);
    measurement.range_systematic_m +=
        0.5 * bins * core::kSpeedOfLight_mps / (2.0 * radar_.bandwidth_Hz);
    measurement.range_rate_systematic_mps += 0.25 * bins * waveform_.wavelength_m() / radar_.ramp_s;
  }
  if (one.merged) measurement.azimuth_systematic_rad = beam_sine() / std::sqrt(12.0);
  return measurement;
}

}  // namespace fanbeam::tracking
