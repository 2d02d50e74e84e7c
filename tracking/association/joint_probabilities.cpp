#include "tracking/association/joint_probabilities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

constexpr std::size_t kMostMeasurements = 16;

struct Group {
  std::vector<int> tracks, measurements;
};

void check(const CostMatrix& likelihood, const std::vector<double>& existence,
           const JointSettings& settings) {
  if (existence.size() != static_cast<std::size_t>(likelihood.rows))
    core::throw_input_error(core::ErrorClass::range, "joint.existence",
                            static_cast<double>(existence.size()), "one for each track");
  for (const double value : likelihood.cost) {
    if (!std::isfinite(value))
      core::throw_input_error(core::ErrorClass::nonfinite, "joint.likelihood", value, "finite");
    if (value < 0.0)
      core::throw_input_error(core::ErrorClass::range, "joint.likelihood", value, "0 or more");
  }
  std::vector<double> probabilities = existence;
  probabilities.push_back(settings.detection_probability);
  probabilities.push_back(settings.gate_probability);
  for (const double value : probabilities)
    if (!(value >= 0.0 && value <= 1.0))
      core::throw_input_error(core::ErrorClass::range, "joint.probability", value, "0 to 1");
  if (!(settings.clutter_density > 0.0) || !std::isfinite(settings.clutter_density))
    core::throw_input_error(core::ErrorClass::range, "joint.clutter_density",
                            settings.clutter_density, "finite, above 0");
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

// Probabilities of one group. weight(t, 0) is that of a miss, weight(t, j + 1) of measurement j.
void solve(const Group& group, const std::vector<std::vector<double>>& weight,
           JointProbabilities& result) {
  const std::size_t tracks = group.tracks.size(), count = group.measurements.size();
  const std::size_t sets = std::size_t{1} << count;
  // before[t][set]: sum over events of the tracks before t that use exactly `set`.
  std::vector<std::vector<double>> before(tracks + 1, std::vector<double>(sets, 0.0));
  // after[set]: sum over events of the tracks behind that find `set` used.
  std::vector<double> after(sets, 1.0), next(sets);
  before[0][0] = 1.0;
  for (std::size_t t = 0; t < tracks; ++t)
    for (std::size_t set = 0; set < sets; ++set) {
      if (before[t][set] == 0.0) continue;
      before[t + 1][set] += before[t][set] * weight[t][0];
      for (std::size_t j = 0; j < count; ++j)
        if ((set >> j & 1U) == 0)
          before[t + 1][set | std::size_t{1} << j] += before[t][set] * weight[t][j + 1];
    }
  for (std::size_t t = tracks; t-- > 0;) {
    std::vector<double> share(count + 1, 0.0);
    double total = 0.0;
    for (std::size_t set = 0; set < sets; ++set) {
      next[set] = weight[t][0] * after[set];
      share[0] += before[t][set] * next[set];
      for (std::size_t j = 0; j < count; ++j) {
        if ((set >> j & 1U) != 0) continue;
        const double value = weight[t][j + 1] * after[set | std::size_t{1} << j];
        next[set] += value;
        share[j + 1] += before[t][set] * value;
      }
    }
    std::swap(after, next);
    for (const double value : share) total += value;
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

}  // namespace

JointProbabilities joint_probabilities(const CostMatrix& likelihood,
                                       const std::vector<double>& existence,
                                       const JointSettings& settings) {
  check(likelihood, existence, settings);
  JointProbabilities result{CostMatrix(likelihood.rows, likelihood.columns, 0.0),
                            std::vector<double>(existence.size(), 1.0), existence};
  const double seen = settings.detection_probability * settings.gate_probability;
  for (const Group& group : groups_of(likelihood)) {
    if (group.measurements.size() > kMostMeasurements)
      core::throw_input_error(core::ErrorClass::limit, "joint.measurements",
                              static_cast<double>(group.measurements.size()),
                              "at most 16 in tracks that share them: the best assignment takes more");
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
    solve(group, weight, result);
  }
  for (std::size_t t = 0; t < existence.size(); ++t) {
    const double none = 1.0 - seen * existence[t];
    const double silent = none > 0.0 ? (1.0 - seen) * existence[t] / none : 0.0;
    result.existence[t] = 1.0 - result.missed[t] * (1.0 - silent);
  }
  return result;
}

}  // namespace fanbeam::tracking
