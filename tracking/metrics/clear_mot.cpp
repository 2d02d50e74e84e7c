#include "tracking/metrics/clear_mot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/errors.h"
#include "core/number_range.h"
#include "tracking/association/assignment.h"

namespace fanbeam::tracking {
namespace {

void check(const std::vector<NamedPlace>& places) {
  std::set<int> names;
  for (const NamedPlace& one : places) {
    if (!std::isfinite(one.place.x_m) || !std::isfinite(one.place.y_m))
      core::throw_input_error(core::ErrorClass::nonfinite, "place", one.place.x_m, "finite");
    if (!names.insert(one.id).second)
      core::throw_input_error(core::ErrorClass::range, "place.id", one.id, "once in a frame");
  }
}

const NamedPlace* find(const std::vector<NamedPlace>& places, int id) {
  for (const NamedPlace& one : places)
    if (one.id == id) return &one;
  return nullptr;
}

// Pairs of the frame before that still hold.
std::map<int, int> kept(const std::map<int, int>& before, const std::vector<NamedPlace>& targets,
                        const std::vector<NamedPlace>& tracks, double gate_m) {
  std::map<int, int> pairs;
  for (const auto& [target, track] : before) {
    const NamedPlace* a = find(targets, target);
    const NamedPlace* b = find(tracks, track);
    if (a != nullptr && b != nullptr && distance_m(a->place, b->place) <= gate_m)
      pairs[target] = track;
  }
  return pairs;
}

void assign_rest(const std::vector<NamedPlace>& targets, const std::vector<NamedPlace>& tracks,
                 double gate_m, std::map<int, int>& pairs) {
  std::set<int> taken;
  for (const auto& pair : pairs) taken.insert(pair.second);
  std::vector<NamedPlace> free_targets, free_tracks;
  for (const NamedPlace& one : targets)
    if (!pairs.contains(one.id)) free_targets.push_back(one);
  for (const NamedPlace& one : tracks)
    if (!taken.contains(one.id)) free_tracks.push_back(one);
  CostMatrix costs(static_cast<int>(free_targets.size()), static_cast<int>(free_tracks.size()),
                   std::numeric_limits<double>::infinity());
  for (int row = 0; row < costs.rows; ++row)
    for (int column = 0; column < costs.columns; ++column) {
      const double apart_m = distance_m(free_targets[static_cast<std::size_t>(row)].place,
                                        free_tracks[static_cast<std::size_t>(column)].place);
      if (apart_m <= gate_m) costs.at(row, column) = apart_m;
    }
  // A miss costs more than all distances together: first as many matches as there can be.
  const std::vector<double> miss(free_targets.size(), gate_m * (costs.rows + 1.0));
  const Assignment found = assign(costs, miss);
  for (std::size_t row = 0; row < free_targets.size(); ++row)
    if (found.column_of[row] >= 0)
      pairs[free_targets[row].id] = free_tracks[static_cast<std::size_t>(found.column_of[row])].id;
}

}  // namespace

ClearMot::ClearMot(double gate_m) : gate_m_(gate_m) {
  core::require_range("gate_m", gate_m, {.low = 0.0, .above_low = true});
}

void ClearMot::add_frame(const std::vector<NamedPlace>& targets,
                         const std::vector<NamedPlace>& tracks, const std::set<int>& excused) {
  check(targets);
  check(tracks);
  current_ = kept(current_, targets, tracks, gate_m_);
  assign_rest(targets, tracks, gate_m_, current_);
  std::set<int> matched_tracks;
  for (const auto& [target, track] : current_) {
    matched_tracks.insert(track);
    const auto before = last_.find(target);
    if (before != last_.end() && before->second != track) ++switches_;
    last_[target] = track;
    distance_sum_m_ += distance_m(find(targets, target)->place, find(tracks, track)->place);
  }
  const int matched = static_cast<int>(current_.size());
  matches_ += matched;
  instances_ += static_cast<int>(targets.size());
  missed_ += static_cast<int>(targets.size()) - matched;
  for (const NamedPlace& one : tracks)
    if (!matched_tracks.contains(one.id) && !excused.contains(one.id)) ++false_;
}

double ClearMot::mota() const {
  return 1.0 - static_cast<double>(missed_ + false_ + switches_) / std::max(instances_, 1);
}

std::optional<double> ClearMot::motp_m() const {
  if (matches_ == 0) return std::nullopt;
  return distance_sum_m_ / matches_;
}

}  // namespace fanbeam::tracking
