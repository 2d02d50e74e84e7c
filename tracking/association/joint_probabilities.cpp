#include "tracking/association/joint_probabilities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kMostOpen = 16;

struct Group {
  std::vector<int> tracks, measurements;
};

void check(const CostMatrix& likelihood, const std::vector<double>& existence,
           const JointSettings& settings) {
  if (existence.size() != static_cast<std::size_t>(likelihood.rows))
    core::throw_input_error(core::ErrorClass::range, "joint.existence",
                            static_cast<double>(existence.size()), "one for each track");
  for (const double value : likelihood.cost)
    core::require_range("joint.likelihood", value, {.low = 0.0});
  std::vector<double> probabilities = existence;
  probabilities.push_back(settings.detection_probability);
  probabilities.push_back(settings.gate_probability);
  for (const double value : probabilities)
    core::require_range("joint.probability", value, {0.0, 1.0});
  core::require_range("joint.clutter_density", settings.clutter_density,
                      {.low = 0.0, .above_low = true});
}

// Tracks that share measurements, directly or through others.
std::vector<Group> groups_of(const CostMatrix& likelihood) {
  std::vector<int> group_of_track(static_cast<std::size_t>(likelihood.rows), -1);
  std::vector<bool> seen(static_cast<std::size_t>(likelihood.columns), false);
  std::vector<Group> groups;
  for (int first = 0; first < likelihood.rows; ++first) {
    if (group_of_track[static_cast<std::size_t>(first)] >= 0) continue;
    Group group;
    group.tracks.push_back(first);
    group_of_track[static_cast<std::size_t>(first)] = static_cast<int>(groups.size());
    for (std::size_t next = 0; next < group.tracks.size(); ++next)
      for (int j = 0; j < likelihood.columns; ++j) {
        if (likelihood.at(group.tracks[next], j) <= 0.0 || seen[static_cast<std::size_t>(j)])
          continue;
        seen[static_cast<std::size_t>(j)] = true;
        group.measurements.push_back(j);
        for (int other = 0; other < likelihood.rows; ++other) {
          int& belongs = group_of_track[static_cast<std::size_t>(other)];
          if (belongs >= 0 || likelihood.at(other, j) <= 0.0) continue;
          belongs = static_cast<int>(groups.size());
          group.tracks.push_back(other);
        }
      }
    groups.push_back(std::move(group));
  }
  return groups;
}

// A set of measurements that tracks so far have used, of those alone that tracks to come may want:
// before each track, and behind the last.
class Frontiers {
 public:
  // weight[t][j + 1] is above 0 where track t may have measurement j.
  Frontiers(const std::vector<std::vector<double>>& weight, std::size_t measurements)
      : open_(weight.size() + 1), carries_(weight.size()) {
    for (std::size_t j = 0; j < measurements; ++j) {
      std::size_t first = weight.size(), last = 0;
      for (std::size_t t = 0; t < weight.size(); ++t) {
        if (!(weight[t][j + 1] > 0.0)) continue;
        first = std::min(first, t);
        last = t;
      }
      for (std::size_t t = first + 1; t <= last; ++t) open_[t].push_back(j);
    }
    if (widest() > kMostOpen) return;  // sets are not asked for, and have no bits for so many
    for (std::size_t t = 0; t < weight.size(); ++t)
      for (const std::size_t j : open_[t]) carries_[t].push_back(bit(t + 1, j));
  }

  std::size_t widest() const {
    std::size_t most = 0;
    for (const std::vector<std::size_t>& open : open_) most = std::max(most, open.size());
    return most;
  }
  std::size_t sets(std::size_t track) const { return std::size_t{1} << open_[track].size(); }
  // The bit of a measurement before a track; 0 where nobody asks for it any more, or yet.
  std::size_t bit(std::size_t track, std::size_t measurement) const {
    const std::vector<std::size_t>& open = open_[track];
    const auto found = std::find(open.begin(), open.end(), measurement);
    return found == open.end() ? 0 : std::size_t{1} << (found - open.begin());
  }
  // A set before the track as it is seen behind it.
  std::size_t carried(std::size_t track, std::size_t set) const {
    std::size_t result = 0;
    for (std::size_t i = 0; set >> i != 0; ++i)
      if ((set >> i & 1U) != 0) result |= carries_[track][i];
    return result;
  }

 private:
  std::vector<std::vector<std::size_t>> open_;     // measurements, in the order of their bits
  std::vector<std::vector<std::size_t>> carries_;  // their bits behind the track, or 0
};

// What a track may do with a set of used measurements before it: every measurement that it may have,
// or none, with its weight and the set behind it.
struct Choice {
  std::size_t share = 0;   // 0: none; else measurement + 1
  std::size_t taken = 0;   // its bit before the track
  std::size_t leaves = 0;  // and behind
  double weight = 0.0;
};

std::vector<Choice> choices_of(const Frontiers& frontiers, std::size_t track,
                               const std::vector<double>& weight) {
  std::vector<Choice> choices;
  for (std::size_t share = 0; share < weight.size(); ++share)
    if (share == 0)
      choices.push_back({0, 0, 0, weight[0]});
    else if (weight[share] > 0.0)
      choices.push_back({share, frontiers.bit(track, share - 1),
                         frontiers.bit(track + 1, share - 1), weight[share]});
  return choices;
}

// Probabilities of one group. weight(t, 0) is that of a miss, weight(t, j + 1) of measurement j.
void solve(const Group& group, const std::vector<std::vector<double>>& weight,
           const Frontiers& frontiers, JointProbabilities& result) {
  const std::size_t tracks = group.tracks.size(), count = group.measurements.size();
  std::vector<std::vector<Choice>> choices;
  // before[t][set]: sum over events of the tracks before t that use exactly `set` of what is open.
  std::vector<std::vector<double>> before = {{1.0}};
  for (std::size_t t = 0; t < tracks; ++t) {
    choices.push_back(choices_of(frontiers, t, weight[t]));
    before.emplace_back(frontiers.sets(t + 1), 0.0);
    for (std::size_t set = 0; set < frontiers.sets(t); ++set) {
      if (before[t][set] == 0.0) continue;
      const std::size_t carried = frontiers.carried(t, set);
      for (const Choice& choice : choices[t])
        if ((set & choice.taken) == 0)
          before[t + 1][carried | choice.leaves] += before[t][set] * choice.weight;
    }
  }
  // after[set]: sum over events of the tracks behind that find `set` used.
  std::vector<double> after = {1.0};
  for (std::size_t t = tracks; t-- > 0;) {
    std::vector<double> share(count + 1, 0.0), next(frontiers.sets(t), 0.0);
    for (std::size_t set = 0; set < next.size(); ++set) {
      const std::size_t carried = frontiers.carried(t, set);
      for (const Choice& choice : choices[t]) {
        if ((set & choice.taken) != 0) continue;
        const double value = choice.weight * after[carried | choice.leaves];
        next[set] += value;
        share[choice.share] += before[t][set] * value;
      }
    }
    after = std::move(next);
    const double total = std::accumulate(share.begin(), share.end(), 0.0);
    const int track = group.tracks[t];
    if (!(total > 0.0)) {
      result.missed[static_cast<std::size_t>(track)] = 1.0;
      continue;
    }
    result.missed[static_cast<std::size_t>(track)] = share[0] / total;
    for (std::size_t j = 0; j < count; ++j)
      result.belongs.at(track, group.measurements[j]) = share[j + 1] / total;
  }
}

// A group by itself, with the likeliest measurements of each track alone.
CostMatrix likeliest(const CostMatrix& likelihood, const Group& group, std::size_t of_each,
                     int& left_out) {
  CostMatrix kept(static_cast<int>(group.tracks.size()),
                  static_cast<int>(group.measurements.size()), 0.0);
  for (int row = 0; row < kept.rows; ++row) {
    const int track = group.tracks[static_cast<std::size_t>(row)];
    std::vector<std::pair<double, int>> shared;  // likelihood and column
    for (int column = 0; column < kept.columns; ++column) {
      const double value =
          likelihood.at(track, group.measurements[static_cast<std::size_t>(column)]);
      if (value > 0.0) shared.emplace_back(value, column);
    }
    std::sort(shared.rbegin(), shared.rend());
    for (std::size_t i = 0; i < shared.size(); ++i)
      if (i < of_each)
        kept.at(row, shared[i].second) = shared[i].first;
      else
        ++left_out;
  }
  return kept;
}

// `existence` of the result is left as it is.
JointProbabilities added_up(const CostMatrix& likelihood, const std::vector<double>& existence,
                            const JointSettings& settings, std::size_t of_each) {
  JointProbabilities result{CostMatrix(likelihood.rows, likelihood.columns, 0.0),
                            std::vector<double>(existence.size(), 1.0), existence, 0};
  const double seen = settings.detection_probability * settings.gate_probability;
  for (const Group& group : groups_of(likelihood)) {
    std::vector<std::vector<double>> weight;
    for (const int track : group.tracks) {
      const double there = existence[static_cast<std::size_t>(track)];
      std::vector<double> row = {1.0 - seen * there};
      for (const int j : group.measurements)
        row.push_back(settings.detection_probability * there * likelihood.at(track, j) /
                      settings.clutter_density);
      // Only ratios inside a row matter; without this, products of many large ones overflow.
      const double largest = *std::max_element(row.begin(), row.end());
      if (largest > 0.0)
        for (double& value : row) value /= largest;
      weight.push_back(std::move(row));
    }
    const Frontiers frontiers(weight, group.measurements.size());
    if (frontiers.widest() <= kMostOpen) {
      solve(group, weight, frontiers, result);
      continue;
    }
    // Tracks with one measurement each share no other, so that this comes to an end.
    const CostMatrix kept = likeliest(likelihood, group, of_each, result.left_out);
    std::vector<double> there;
    for (const int track : group.tracks)
      there.push_back(existence[static_cast<std::size_t>(track)]);
    const JointProbabilities part = added_up(kept, there, settings, of_each / 2);
    result.left_out += part.left_out;
    for (int row = 0; row < kept.rows; ++row) {
      const int track = group.tracks[static_cast<std::size_t>(row)];
      result.missed[static_cast<std::size_t>(track)] = part.missed[static_cast<std::size_t>(row)];
      for (int column = 0; column < kept.columns; ++column)
        result.belongs.at(track, group.measurements[static_cast<std::size_t>(column)]) =
            part.belongs.at(row, column);
    }
  }
  return result;
}

}  // namespace

JointProbabilities joint_probabilities(const CostMatrix& likelihood,
                                       const std::vector<double>& existence,
                                       const JointSettings& settings) {
  check(likelihood, existence, settings);
  JointProbabilities result = added_up(likelihood, existence, settings, kMostOpen);
  const double seen = settings.detection_probability * settings.gate_probability;
  for (std::size_t t = 0; t < existence.size(); ++t) {
    const double none = 1.0 - seen * existence[t];
    const double silent = none > 0.0 ? (1.0 - seen) * existence[t] / none : 0.0;
    result.existence[t] = 1.0 - result.missed[t] * (1.0 - silent);
  }
  return result;
}

}  // namespace fanbeam::tracking
