// Beats of a triangle to targets: which two belong together, and what they say.
#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/pairing/triangle.h"
#include "tracking/simulation/sampled_frame.h"

namespace fanbeam::tracking {
namespace {

constexpr double kCoarseSigma_m = 0.3, kCoarseSigma_mps = 0.3;
// What taking turns leaves where it ends (bent_tones.h).
constexpr double kSettled_bins = 2e-4;
// Of a coarse cell's direction, by neighbours in range and speed.
constexpr double kPulled_rad = 5e-4;
// Two tones that are one beat are up to 0.7 bins apart: evenly.
constexpr double kMerged_bins = 0.7 / 3.4641;
constexpr double kSure = 9.0;  // three standard deviations, squared
// Of a beam: farther apart two directions are two coarse detections.
constexpr double kOneCell = 0.6;
constexpr double kNowhere_Hz = 1e15;

}  // namespace

// Of range, speed and the directions of what is one plane wave each: two cars of one speed beside each
// other are in one coarse cell's reach, and told apart by where they are.
double SampledRadar::misfit(const signal::TriangleModel& model, const SampledBeats& beats,
                            std::size_t up, std::size_t down, const signal::RangeSpeed& place,
                            const Coarse& cell) {
  const signal::RangeSpeed pair = solve(model, {beats.up[up].Hz, beats.down[down].Hz});
  const Beat &rising = beats.up[up], &falling = beats.down[down];
  double sum = std::pow((pair.range_m - place.range_m) / kCoarseSigma_m, 2) +
               std::pow((pair.radial_speed_mps - place.radial_speed_mps) / kCoarseSigma_mps, 2);
  const auto compare = [&sum](const auto& one, const auto& other) {
    if (one.lone_wave && other.lone_wave)
      sum += std::pow(one.azimuth_rad - other.azimuth_rad, 2) /
             (kAgree_rad * kAgree_rad + one.azimuth_sigma_rad * one.azimuth_sigma_rad +
              other.azimuth_sigma_rad * other.azimuth_sigma_rad);
  };
  compare(rising, falling);
  compare(rising, cell);
  compare(falling, cell);
  return sum;
}

// The pair of beats that fits a coarse place best, if any does and better than `best`.
void SampledRadar::try_place(const signal::TriangleModel& model, const SampledBeats& beats,
                             const signal::RangeSpeed& place, const Coarse& cell, Pair& best) {
  for (std::size_t i = 0; i < beats.up.size(); ++i)
    for (std::size_t j = 0; j < beats.down.size(); ++j) {
      const double one = misfit(model, beats, i, j, place, cell);
      if (one < best.misfit)
        best = {one, i, j, place, solve(model, {beats.up[i].Hz, beats.down[j].Hz}), true};
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

// The triangle's direction, if that is one target's, else the coarse cell's, whose neighbours in speed
// are out of the way. Beats that hold more than one wave have range and speed of both.
SampledRadar::Found SampledRadar::as_it_is(const SampledBeats& beats, const Pair& best,
                                           const Coarse& coarse) const {
  const Beat &rising = beats.up[best.up], &falling = beats.down[best.down];
  const bool lone = rising.lone_wave && falling.lone_wave;
  const double fine_rad = 0.5 * (rising.azimuth_rad + falling.azimuth_rad);
  const bool fine =
      lone && std::abs(std::sin(fine_rad) - std::sin(coarse.azimuth_rad)) < kOneCell * beam_sine();
  Found found{best.up, best.down, best.place};
  if (!lone && radar_.array_elements > 1) found.merged_bins = kMerged_bins;
  if (fine) {
    found.azimuth_rad = fine_rad;
    found.azimuth_sigma_rad = 0.5 * std::hypot(rising.azimuth_sigma_rad, falling.azimuth_sigma_rad);
  } else {
    found.azimuth_rad = coarse.azimuth_rad;
    found.azimuth_sigma_rad = coarse.azimuth_sigma_rad;
    found.azimuth_systematic_rad =
        coarse.lone_wave || coarse.directions > 1 ? kPulled_rad : beam_sine() / std::sqrt(12.0);
  }
  return found;
}

// Two targets of which both ramps have two beats, and no direction tells which belong together: those
// that fit the coarse place better, wrong by half of what they are apart where that does not tell
// either.
std::vector<SampledRadar::Found> SampledRadar::by_misfit(
    const signal::TriangleModel& model, const SampledBeats& beats, const Pair& best,
    const Coarse& coarse, const std::vector<std::size_t>& up,
    const std::vector<std::size_t>& down) const {
  const auto fit = [&](std::size_t i, std::size_t j) {
    return misfit(model, beats, up[i], down[j], best.coarse, coarse);
  };
  const double straight = fit(0, 0) + fit(1, 1), crossed = fit(0, 1) + fit(1, 0);
  const std::size_t swapped = crossed < straight ? 1 : 0;
  const double apart_Hz = std::min(std::abs(beats.up[up[0]].Hz - beats.up[up[1]].Hz),
                                   std::abs(beats.down[down[0]].Hz - beats.down[down[1]].Hz));
  std::vector<Found> result;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t one = up[i], other = down[i == swapped ? 0 : 1];
    result.push_back({one, other, solve(model, {beats.up[one].Hz, beats.down[other].Hz}),
                      coarse.azimuth_rad, coarse.azimuth_sigma_rad, kPulled_rad,
                      std::abs(crossed - straight) < kSure ? apart_Hz * radar_.ramp_s : 0.0});
  }
  return result;
}

// The pair as it is, or where a beat of it is one of two tones of a peak, both targets: each with the
// beat of the other ramp, near enough in range and speed, that comes from its direction.
std::vector<SampledRadar::Found> SampledRadar::apart(const signal::TriangleModel& model,
                                                     const SampledBeats& beats, const Pair& best,
                                                     const Coarse& coarse) const {
  const std::vector<std::size_t> up = of_peak(beats.up, best.up);
  const std::vector<std::size_t> down = of_peak(beats.down, best.down);
  if (up.size() == 1 && down.size() == 1) return {as_it_is(beats, best, coarse)};
  if (radar_.array_elements < 2 && up.size() == 2 && down.size() == 2)
    return by_misfit(model, beats, best, coarse, up, down);
  const bool by_up = up.size() > 1;
  const std::vector<Beat>& others = by_up ? beats.down : beats.up;
  std::vector<Found> result;
  for (const std::size_t one : by_up ? up : down) {
    const Beat& own = (by_up ? beats.up : beats.down)[one];
    std::size_t other = by_up ? best.down : best.up;
    double apart_rad = kAgree_rad;
    bool alone = false;  // no other target is in either beat
    for (std::size_t k = 0; k < others.size(); ++k) {
      const std::size_t i = by_up ? one : k, j = by_up ? k : one;
      const double differ_rad = std::abs(others[k].azimuth_rad - own.azimuth_rad);
      if (!own.lone_wave || !others[k].lone_wave || differ_rad >= apart_rad ||
          !(misfit(model, beats, i, j, best.coarse, coarse) < Pair{}.misfit))
        continue;
      apart_rad = differ_rad;
      other = k;
      alone = true;
    }
    const std::size_t i = by_up ? one : other, j = by_up ? other : one;
    // The tone of a target that is elsewhere and only shares this peak.
    if (!alone && !(misfit(model, beats, i, j, best.coarse, coarse) < Pair{}.misfit)) continue;
    Found found{i, j, solve(model, {beats.up[i].Hz, beats.down[j].Hz}), own.azimuth_rad,
                own.azimuth_sigma_rad};
    if (alone) {
      found.azimuth_rad = 0.5 * (own.azimuth_rad + others[other].azimuth_rad);
      found.azimuth_sigma_rad =
          0.5 * std::hypot(own.azimuth_sigma_rad, others[other].azimuth_sigma_rad);
    } else {
      found.merged_bins = kMerged_bins;
      if (!own.lone_wave) found.azimuth_systematic_rad = beam_sine() / std::sqrt(12.0);
    }
    if (std::abs(std::sin(found.azimuth_rad) - std::sin(coarse.azimuth_rad)) <=
        kOneCell * beam_sine())
      result.push_back(found);
  }
  if (result.empty()) result.push_back(as_it_is(beats, best, coarse));
  return result;
}

RadarMeasurement SampledRadar::measured(const SampledBeats& beats, const Found& one) const {
  const double sigma_Hz =
      0.5 * std::hypot(beats.up[one.up].sigma_Hz, beats.down[one.down].sigma_Hz);
  // Of a beat that is off by a bin.
  const double per_bin_m = 0.25 * core::kSpeedOfLight_mps / radar_.bandwidth_Hz;
  const double per_bin_mps = 0.25 * waveform_.wavelength_m() / radar_.ramp_s;
  const double bins = one.merged_bins + kSettled_bins;
  return {one.place.range_m,
          one.place.radial_speed_mps,
          one.azimuth_rad,
          2.0 * per_bin_m * radar_.ramp_s * sigma_Hz,
          2.0 * per_bin_mps * radar_.ramp_s * sigma_Hz,
          one.azimuth_sigma_rad,
          bins * per_bin_m,
          bins * per_bin_mps,
          one.azimuth_systematic_rad};
}

}  // namespace fanbeam::tracking
