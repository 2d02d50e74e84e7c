#include "tracking/simulation/ramp_tones.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "signal/detection/two_tones.h"

namespace fanbeam::tracking {
namespace {

constexpr double kOneLobe = 2.4;  // bins between peaks within which taking turns may not end
constexpr double kOneTone = 0.3;  // nearer, two that are not told apart are one
constexpr double kBeside = 6.0;   // bins from two tones that were one, within which that mattered
constexpr double kSideLobes = 12.0;  // bins
constexpr double kFaint = 1e-3;      // of the power of the tone whose side lobe it may be
constexpr int kMoreTurns = 6;

enum class Kind { seen, unseen, doubtful };

struct Peak : BentPeak {
  Kind kind = Kind::unseen;
  std::size_t partner = 0;  // itself: none
};

std::vector<Peak> peaks_at(const std::vector<double>& bins, const std::vector<BentPeak>& seen,
                           double count) {
  std::vector<Peak> peaks;
  for (const double bin : bins) {
    Peak peak{{bin, 0.0}, Kind::unseen, peaks.size()};
    double apart = kSeenReach_bins;
    for (const BentPeak& place : seen) {
      if (bins_apart(place.bin, bin, count) >= apart) continue;
      apart = bins_apart(place.bin, bin, count);
      peak.curvature_bins = place.curvature_bins;
      peak.kind = Kind::seen;
    }
    peaks.push_back(peak);
  }
  return peaks;
}

// Once it is known how strong they are.
void find_doubtful(const std::vector<BentTone>& tones, double count, std::vector<Peak>& peaks) {
  for (std::size_t i = 0; i < tones.size(); ++i)
    for (std::size_t j = 0; j < tones.size(); ++j)
      if (peaks[i].kind == Kind::unseen && peaks[j].kind == Kind::seen && !tones[j].lost &&
          bins_apart(peaks[i].bin, peaks[j].bin, count) < kSideLobes &&
          tones[i].tone.power < kFaint * tones[j].tone.power)
        peaks[i].kind = Kind::doubtful;
}

bool is_sure(const BentTone& tone, const Peak& peak) {
  return !tone.lost && peak.kind != Kind::doubtful;
}

// The nearest first.
void find_partners(const std::vector<BentTone>& tones, double count, std::vector<Peak>& peaks) {
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> near;
  for (std::size_t i = 0; i < tones.size(); ++i)
    for (std::size_t j = i + 1; j < tones.size(); ++j) {
      const double apart = bins_apart(tones[i].tone.bin, tones[j].tone.bin, count);
      if (is_sure(tones[i], peaks[i]) && is_sure(tones[j], peaks[j]) && apart < kOneLobe)
        near.push_back({apart, {i, j}});
    }
  std::sort(near.begin(), near.end());
  for (const auto& [apart, pair] : near) {
    const auto [i, j] = pair;
    if (peaks[i].partner != i || peaks[j].partner != j) continue;
    peaks[i].partner = j;
    peaks[j].partner = i;
  }
}

// How much beats near a place differ in their bends.
double spread_of_bends(const std::vector<BentPeak>& seen, double bin, double count) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (const BentPeak& place : seen) {
    if (bins_apart(place.bin, bin, count) >= kSeenReach_bins) continue;
    low = any ? std::min(low, place.curvature_bins) : place.curvature_bins;
    high = any ? std::max(high, place.curvature_bins) : place.curvature_bins;
    any = true;
  }
  return high - low;
}

class Ramp {
 public:
  Ramp(const signal::ToneRecords& records, const std::vector<BentPeak>& seen,
       const std::vector<double>& weights, double noise_W)
      : records_(records), seen_(seen), weights_(weights), noise_W_(noise_W) {}

  // Tones that make one peak apart, and those whose peaks are so near that taking turns does not end.
  void split(const std::vector<Peak>& peaks, const std::vector<BentTone>& tones) {
    rest_ = records_;
    for (std::size_t i = 0; i < tones.size(); ++i)
      if (is_sure(tones[i], peaks[i])) add(tones[i], -1.0, rest_);
    for (std::size_t i = 0; i < tones.size(); ++i)
      if (is_sure(tones[i], peaks[i]) && peaks[i].partner >= i) split_one(peaks, tones, i);
  }

  // What stands beside two tones was sought beside one.
  void settle() {
    std::vector<double> moved(found_.size(), 0.0);
    for (int turn = 0; turn < kMoreTurns; ++turn) {
      double furthest = 0.0;
      for (std::size_t i = 0; i < found_.size(); i = end_of(i)) {
        if (!is_beside_two(i, turn == 0)) continue;
        moved[i] = seek_again(i);
        furthest = std::max(furthest, moved[i]);
      }
      if (furthest < kStill_bins) break;
    }
    for (std::size_t i = 0; i < found_.size(); i = end_of(i))
      for (std::size_t own = i; own < end_of(i) && moved[i] >= kStill_bins; ++own)
        found_[own].bent.unsettled_bins =
            std::max(found_[own].bent.unsettled_bins, 10.0 * moved[i]);
  }

  void add_doubtful(const std::vector<Peak>& peaks, double least_power) {
    std::vector<BentPeak> doubtful;
    std::vector<int> numbers;
    for (std::size_t i = 0; i < peaks.size(); ++i)
      if (peaks[i].kind == Kind::doubtful) {
        doubtful.push_back(peaks[i]);
        numbers.push_back(static_cast<int>(i));
      }
    if (doubtful.empty()) return;
    const std::vector<BentTone> tones = tones_in_turn(rest_, doubtful, weights_);
    for (std::size_t i = 0; i < tones.size(); ++i)
      if (!tones[i].lost && tones[i].tone.power > least_power) {
        add(tones[i], -1.0, rest_);
        found_.push_back({tones[i], numbers[i]});
      }
    settle();
  }

  std::vector<RampTone> take() { return std::move(found_); }

 private:
  double count() const { return static_cast<double>(records_.front().size()); }
  // Two that are sought jointly follow each other.
  std::size_t end_of(std::size_t i) const { return i + (found_[i].jointly ? 2 : 1); }
  double middle_of(const signal::Tone& one, const signal::Tone& other) const {
    return one.bin + 0.5 * std::remainder(other.bin - one.bin, count());
  }

  void split_one(const std::vector<Peak>& peaks, const std::vector<BentTone>& tones,
                 std::size_t i) {
    const std::size_t partner = peaks[i].partner;
    const double middle = middle_of(tones[i].tone, tones[partner].tone);
    const double curvature_bins = 0.5 * (peaks[i].curvature_bins + peaks[partner].curvature_bins);
    add(tones[i], 1.0, rest_);
    if (partner != i) add(tones[partner], 1.0, rest_);
    std::optional<std::pair<signal::Tone, signal::Tone>> two;
    if (partner != i || peaks[i].kind == Kind::seen)
      two = signal::two_tones(rest_, middle, curvature_bins, noise_W_);
    const auto put = [this](const BentTone& bent, std::size_t peak, bool jointly, double spread) {
      add(bent, -1.0, rest_);
      found_.push_back({bent, static_cast<int>(peak), jointly, spread});
    };
    if (two) {
      const double spread = spread_of_bends(seen_, middle, count());
      put({two->first, curvature_bins}, i, true, spread);
      put({two->second, curvature_bins}, partner, true, spread);
    } else if (partner != i &&
               bins_apart(tones[i].tone.bin, tones[partner].tone.bin, count()) < kOneTone) {
      const BentTone one = tones_in_turn(rest_, {{middle, curvature_bins}}, weights_).front();
      put(one.lost ? tones[i] : one, i, false, 0.0);
    } else {
      put(tones[i], i, false, 0.0);
      if (partner != i) put(tones[partner], partner, false, 0.0);
    }
  }

  // Within six bins, or `once` at any distance: side lobes are done with then.
  bool is_beside_two(std::size_t i, bool once) const {
    const std::size_t end = end_of(i);
    for (std::size_t j = 0; j < found_.size(); ++j) {
      if (j >= i && j < end) continue;
      if (once && found_[j].jointly) return true;
      if (!found_[i].jointly && !found_[j].jointly) continue;
      for (std::size_t own = i; own < end; ++own)
        if (bins_apart(found_[own].bent.tone.bin, found_[j].bent.tone.bin, count()) < kBeside)
          return true;
    }
    return false;
  }

  // The pair or the one that begins there. How far that moves.
  double seek_again(std::size_t i) {
    RampTone& one = found_[i];
    const double before_bin = one.bent.tone.bin;
    double other_move = 0.0;
    add(one.bent, 1.0, rest_);
    if (one.jointly) {
      RampTone& other = found_[i + 1];
      add(other.bent, 1.0, rest_);
      const double middle = middle_of(one.bent.tone, other.bent.tone);
      if (auto two = signal::two_tones(rest_, middle, one.bent.curvature_bins, noise_W_)) {
        other_move = bins_apart(two->second.bin, other.bent.tone.bin, count());
        one.bent.tone = std::move(two->first);
        other.bent.tone = std::move(two->second);
      }
      add(other.bent, -1.0, rest_);
    } else {
      const BentPeak place{one.bent.tone.bin, one.bent.curvature_bins};
      const BentTone again = tones_in_turn(rest_, {place}, weights_).front();
      if (!again.lost) one.bent.tone = again.tone;
    }
    add(one.bent, -1.0, rest_);
    return std::max(other_move, bins_apart(one.bent.tone.bin, before_bin, count()));
  }

  const signal::ToneRecords& records_;
  const std::vector<BentPeak>& seen_;
  const std::vector<double>& weights_;
  double noise_W_;
  signal::ToneRecords rest_;  // without what is found
  std::vector<RampTone> found_;
};

}  // namespace

std::vector<RampTone> ramp_tones(const signal::ToneRecords& records,
                                 const std::vector<double>& bins, const std::vector<BentPeak>& seen,
                                 const std::vector<double>& weights, double noise_W,
                                 double least_power) {
  const auto count = static_cast<double>(records.front().size());
  std::vector<Peak> peaks = peaks_at(bins, seen, count);
  const std::vector<BentTone> tones = tones_in_turn(records, {peaks.begin(), peaks.end()}, weights);
  find_doubtful(tones, count, peaks);
  find_partners(tones, count, peaks);
  Ramp ramp(records, seen, weights, noise_W);
  ramp.split(peaks, tones);
  ramp.settle();
  ramp.add_doubtful(peaks, least_power);
  return ramp.take();
}

}  // namespace fanbeam::tracking
