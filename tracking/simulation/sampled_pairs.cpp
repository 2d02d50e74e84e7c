// Beats of a triangle to targets: which two belong together, and what they say.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/constants.h"
#include "signal/pairing/triangle.h"
#include "signal/waveform/waveform.h"
#include "tracking/simulation/sampled_frame.h"

namespace fanbeam::tracking {
namespace {

// Of a coarse place, in cells of range and of speed.
constexpr double kCoarse_cells = 0.5, kCoarse_dopplers = 0.78;
// Of a beam: how far directions of one target may disagree, besides noise; how far a coarse cell's is
// pulled by neighbours in range and speed; farther apart two directions are two coarse detections.
constexpr double kAgree = 0.04, kPulled = 0.0034, kOneCell = 0.6;
constexpr double kMostDisagreement = 4.0;  // two standard deviations, squared
// Two tones that are one beat are up to 0.7 bins apart: evenly.
constexpr double kMerged_bins = 0.7 * 0.28868;  // 1 / sqrt(12)
constexpr double kMostAcross_mps = 70.0;
constexpr double kSure = 9.0;  // three standard deviations, squared
constexpr double kNowhere_Hz = 1e15;
constexpr double kTaken = 4.0;  // as much misfit as a beat is worth that another pair has

}  // namespace

template <class One, class Other>
double SampledRadar::disagreement(const One& one, const Other& other) const {
  const double known_rad = kAgree * beam_sine();
  return std::pow(one.azimuth_rad - other.azimuth_rad, 2) /
         (known_rad * known_rad + one.azimuth_sigma_rad * one.azimuth_sigma_rad +
          other.azimuth_sigma_rad * other.azimuth_sigma_rad);
}

bool SampledRadar::agree(const Beat& one, const Beat& other) const {
  return radar_.array_elements < 2 || disagreement(one, other) < kMostDisagreement;
}

// Of range, speed and the directions of what is one plane wave each: two cars of one speed beside each
// other are in one coarse cell's reach, and told apart by where they are.
double SampledRadar::misfit(const signal::TriangleModel& model, const SampledBeats& beats,
                            std::size_t up, std::size_t down, const signal::RangeSpeed& place,
                            const Coarse& cell) const {
  const signal::RangeSpeed pair = solve(model, {beats.up[up].Hz, beats.down[down].Hz});
  const Beat &rising = beats.up[up], &falling = beats.down[down];
  const double sigma_m = kCoarse_cells * core::kSpeedOfLight_mps / (2.0 * radar_.bandwidth_Hz);
  const double sigma_mps =
      kCoarse_dopplers * 0.5 * waveform_.wavelength_m() /
      (repetition_s_ * static_cast<double>(signal::stage_segments(waveform_, 0).size()));
  double sum = std::pow((pair.range_m - place.range_m) / sigma_m, 2) +
               std::pow((pair.radial_speed_mps - place.radial_speed_mps) / sigma_mps, 2);
  const auto compare = [&](const auto& one, const auto& other) {
    if (one.lone_wave && other.lone_wave) sum += disagreement(one, other);
  };
  compare(rising, falling);
  compare(rising, cell);
  compare(falling, cell);
  return sum;
}

// The pairs of beats that fit one of a cell's places, the best first.
std::vector<SampledRadar::Pair> SampledRadar::fitting(const signal::TriangleModel& model,
                                                      const SampledBeats& beats,
                                                      const std::vector<signal::RangeSpeed>& places,
                                                      const Coarse& cell) const {
  std::vector<Pair> result;
  for (const signal::RangeSpeed& place : places)
    for (std::size_t i = 0; i < beats.up.size(); ++i)
      for (std::size_t j = 0; j < beats.down.size(); ++j) {
        const double one = misfit(model, beats, i, j, place, cell);
        if (one < Pair{}.misfit)
          result.push_back(
              {one, i, j, place, solve(model, {beats.up[i].Hz, beats.down[j].Hz}), true});
      }
  std::stable_sort(result.begin(), result.end(),
                   [](const Pair& a, const Pair& b) { return a.misfit < b.misfit; });
  return result;
}

bool SampledRadar::has_beat(const std::vector<Pair>& pairs, bool of_up, std::size_t beat) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& one) {
    return one.found && (of_up ? one.up : one.down) == beat;
  });
}

// Of every cell the pair that fits best, the surest cell first. A beat that another cell's pair has is
// less likely: two cars behind each other have four pairs of beats and one direction, and of the crossed
// ones, which fit as well where the beats of a ramp are closer than cells, both beats are taken.
std::vector<SampledRadar::Pair> SampledRadar::best_pairs(
    const signal::TriangleModel& model, const SampledBeats& beats,
    const std::vector<std::vector<signal::RangeSpeed>>& places,
    const std::vector<Coarse>& cells) const {
  std::vector<std::vector<Pair>> candidates;
  for (std::size_t i = 0; i < cells.size(); ++i)
    candidates.push_back(fitting(model, beats, places[i], cells[i]));
  std::vector<Pair> result(cells.size());
  const auto cost = [&](const Pair& pair) {
    const int taken =
        (has_beat(result, true, pair.up) ? 1 : 0) + (has_beat(result, false, pair.down) ? 1 : 0);
    return pair.misfit + kTaken * taken;
  };
  for (std::size_t round = 0; round < cells.size(); ++round) {
    double least = std::numeric_limits<double>::max();
    std::size_t surest = cells.size();
    Pair best;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (result[i].found) continue;
      for (const Pair& pair : candidates[i])
        if (const double one = cost(pair); one < least) {
          least = one;
          surest = i;
          best = pair;
        }
    }
    if (surest == cells.size()) break;
    result[surest] = best;
  }
  return result;
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

// A beat that two targets take is of both, its direction too: one that only one takes is that one's.
void SampledRadar::tell_shared(const SampledBeats& beats, std::vector<Found>& found) const {
  for (Found& one : found) {
    const auto others = [&](bool up, bool down) {
      return std::any_of(found.begin(), found.end(), [&](const Found& other) {
        return &other != &one && (!up || other.up == one.up) && (!down || other.down == one.down);
      });
    };
    const bool up = others(true, false), down = others(false, true);
    if (!up && !down) continue;
    one.merged_bins = std::max(one.merged_bins, kMerged_bins);
    if (radar_.array_elements < 2 || others(true, true)) continue;  // told apart by direction
    const Beat& own = up ? beats.down[one.down] : beats.up[one.up];
    if (up != down && own.lone_wave) {
      one.azimuth_rad = own.azimuth_rad;
      one.azimuth_sigma_rad = own.azimuth_sigma_rad;
      one.azimuth_systematic_rad = 0.0;
    } else {
      one.azimuth_systematic_rad = std::max(one.azimuth_systematic_rad, kAgree * beam_sine());
    }
  }
}

// With the direction of both beats, if that is one target's, else of the one that is, else the coarse
// cell's, whose neighbours in speed are out of the way. Beats that hold more than one wave have range
// and speed of both; one receiver cannot know.
SampledRadar::Found SampledRadar::found_of(const SampledBeats& beats, std::size_t up,
                                           std::size_t down, const signal::RangeSpeed& place,
                                           const Coarse& coarse) const {
  const Beat &rising = beats.up[up], &falling = beats.down[down];
  const bool both = rising.lone_wave && falling.lone_wave && agree(rising, falling);
  Found found{up, down, place};
  if (!both && radar_.array_elements > 1) found.merged_bins = kMerged_bins;
  if (both) {
    found.azimuth_rad = 0.5 * (rising.azimuth_rad + falling.azimuth_rad);
    found.azimuth_sigma_rad = 0.5 * std::hypot(rising.azimuth_sigma_rad, falling.azimuth_sigma_rad);
  } else if (rising.lone_wave != falling.lone_wave && !coarse.lone_wave) {
    const Beat& own = rising.lone_wave ? rising : falling;
    found.azimuth_rad = own.azimuth_rad;
    found.azimuth_sigma_rad = own.azimuth_sigma_rad;
  } else {
    found.azimuth_rad = coarse.azimuth_rad;
    found.azimuth_sigma_rad = coarse.azimuth_sigma_rad;
    found.azimuth_systematic_rad = coarse.lone_wave || coarse.directions > 1
                                       ? kPulled * beam_sine()
                                       : beam_sine() / std::sqrt(12.0);
  }
  return found;
}

// Two targets of which both ramps have two beats. Which belong together is told by their directions,
// else by the pair that fits the coarse place: the other two are what is left (the sum of the misfits
// of both is of no use: its middle is the same either way). Where neither is sure they may be wrong by
// half of what they are apart.
std::vector<SampledRadar::Found> SampledRadar::two_of_each(const signal::TriangleModel& model,
                                                           const SampledBeats& beats,
                                                           const Pair& best, const Coarse& coarse,
                                                           std::size_t other_up,
                                                           std::size_t other_down) const {
  const Beat &up = beats.up[best.up], &up2 = beats.up[other_up];
  const Beat &down = beats.down[best.down], &down2 = beats.down[other_down];
  const bool lone = up.lone_wave && up2.lone_wave && down.lone_wave && down2.lone_wave;
  const double crossed_by = lone ? disagreement(up, down) + disagreement(up2, down2) -
                                       disagreement(up, down2) - disagreement(up2, down)
                                 : 0.0;
  const bool by_direction = std::abs(crossed_by) > kSure;
  const double crossed_fit =
      std::min(misfit(model, beats, best.up, other_down, best.coarse, coarse),
               misfit(model, beats, other_up, best.down, best.coarse, coarse));
  const double apart_Hz = std::min(std::abs(up.Hz - up2.Hz), std::abs(down.Hz - down2.Hz));
  const double unsure_bins =
      by_direction || crossed_fit - best.misfit > kSure ? 0.0 : apart_Hz * radar_.ramp_s;
  const bool crossed = by_direction && crossed_by > 0.0;
  std::vector<Found> result;
  for (const auto& [i, j] : {std::pair{best.up, crossed ? other_down : best.down},
                             std::pair{other_up, crossed ? best.down : other_down}}) {
    if (!result.empty() && !(misfit(model, beats, i, j, best.coarse, coarse) < Pair{}.misfit))
      continue;  // another coarse place's
    const signal::RangeSpeed place = solve(model, {beats.up[i].Hz, beats.down[j].Hz});
    result.push_back(found_of(beats, i, j, place, coarse));
    result.back().merged_bins = std::max(result.back().merged_bins, unsure_bins);
  }
  return result;
}

// The pair as it is, or where a beat of it is one of two tones of a peak, both targets: each with the
// beat of the other ramp from its direction that fits best in range and speed.
std::vector<SampledRadar::Found> SampledRadar::apart(const signal::TriangleModel& model,
                                                     const SampledBeats& beats,
                                                     const std::vector<Pair>& bests,
                                                     std::size_t place_of,
                                                     const Coarse& coarse) const {
  const Pair& best = bests[place_of];
  const std::vector<std::size_t> up = of_peak(beats.up, best.up);
  const std::vector<std::size_t> down = of_peak(beats.down, best.down);
  const Found as_it_is = found_of(beats, best.up, best.down, best.place, coarse);
  if (up.size() == 1 && down.size() == 1) return {as_it_is};
  if (up.size() == 2 && down.size() == 2)
    return two_of_each(model, beats, best, coarse, up[up[0] == best.up ? 1 : 0],
                       down[down[0] == best.down ? 1 : 0]);
  const bool by_up = up.size() > 1;
  const std::vector<Beat>& others = by_up ? beats.down : beats.up;
  std::vector<Found> result;
  for (const std::size_t one : by_up ? up : down) {
    const bool is_best = one == (by_up ? best.up : best.down);
    if (!is_best && has_beat(bests, by_up, one)) continue;  // measured where its target is detected
    const Beat& own = (by_up ? beats.up : beats.down)[one];
    std::size_t other = by_up ? best.down : best.up;
    double least = Pair{}.misfit;
    bool alone = false;  // no other target is in either beat
    for (std::size_t k = 0; k < others.size(); ++k) {
      const std::size_t i = by_up ? one : k, j = by_up ? k : one;
      if (is_best && k != other) continue;  // with its own partner
      if (!own.lone_wave || !others[k].lone_wave || !agree(own, others[k])) continue;
      const double fit = misfit(model, beats, i, j, best.coarse, coarse);
      if (!(fit < least)) continue;
      least = fit;
      other = k;
      alone = true;
    }
    const std::size_t i = by_up ? one : other, j = by_up ? other : one;
    // The tone of a target that is elsewhere and only shares this peak.
    if (!alone && !(misfit(model, beats, i, j, best.coarse, coarse) < Pair{}.misfit)) continue;
    const signal::RangeSpeed place = solve(model, {beats.up[i].Hz, beats.down[j].Hz});
    Found found = found_of(beats, i, j, place, coarse);
    if (!alone && own.lone_wave) {
      found.azimuth_rad = own.azimuth_rad;
      found.azimuth_sigma_rad = own.azimuth_sigma_rad;
      found.azimuth_systematic_rad = 0.0;
    }
    if (std::abs(std::sin(found.azimuth_rad) - std::sin(coarse.azimuth_rad)) <=
        kOneCell * beam_sine())
      result.push_back(found);
  }
  if (result.empty()) result.push_back(as_it_is);
  return result;
}

RadarMeasurement SampledRadar::measured(const SampledBeats& beats, const Found& one) const {
  const double sigma_Hz =
      0.5 * std::hypot(beats.up[one.up].sigma_Hz, beats.down[one.down].sigma_Hz);
  // Of a beat that is off by a bin.
  const double per_bin_m = 0.25 * core::kSpeedOfLight_mps / radar_.bandwidth_Hz;
  const double per_bin_mps = 0.25 * waveform_.wavelength_m() / radar_.ramp_s;
  const double bins =
      one.merged_bins + std::max(beats.up[one.up].settled_bins, beats.down[one.down].settled_bins);
  // A target across the line of sight bends its range, by v^2 / R, which the ramps see half a ramp from the turnaround.
  const double bend_m = std::pow(kMostAcross_mps * fine_.up_middle_s, 2) /
                        (2.0 * std::sqrt(3.0) * std::max(1.0, one.place.range_m));
  return {one.place.range_m,
          one.place.radial_speed_mps,
          one.azimuth_rad,
          2.0 * per_bin_m * radar_.ramp_s * sigma_Hz,
          2.0 * per_bin_mps * radar_.ramp_s * sigma_Hz,
          one.azimuth_sigma_rad,
          std::hypot(bins * per_bin_m, bend_m),
          bins * per_bin_mps,
          one.azimuth_systematic_rad};
}

}  // namespace fanbeam::tracking
