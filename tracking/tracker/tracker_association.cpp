// Which measurement belongs to which track.
#include <cmath>
#include <limits>

#include "tracking/tracker/tracker_frame_private.h"

namespace fanbeam::tracking {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();
// A measurement this likely to belong to a track starts no other.
constexpr double kTaken = 0.01;

}  // namespace

void Tracker::associate(Frame& frame) {
  for (const bool confirmed : {true, false}) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const Track& track = tracks_[i];
      if (track.confirmed == confirmed && !track.unresolved_with && track.coasted > 0)
        which.push_back(i);
    }
    if (confirmed && settings_.association == Association::joint)
      update_joint(which, frame);
    else
      update_nearest(which, frame);
  }
}

// Calls `found(row, column, log likelihood)` for all inside the gates.
template <typename Found>
void Tracker::inside_gates(const std::vector<std::size_t>& which, const Frame& frame,
                           const Found& found) const {
  for (std::size_t row = 0; row < which.size(); ++row) {
    const ImmState& state = tracks_[which[row]].state;
    const QuickGate gate(state, measured_, gate_);
    for (std::size_t column = 0; column < frame.measurements.size(); ++column) {
      const RadarMeasurement& one = frame.measurements[column];
      if (frame.used[column] || !gate.may_hold(one)) continue;
      const Update told = innovation(state, measured_, one);
      if (told.applied && told.normalised_innovation_squared <= gate_)
        found(static_cast<int>(row), static_cast<int>(column), told.log_likelihood);
    }
  }
}

void Tracker::update_nearest(const std::vector<std::size_t>& which, Frame& frame) {
  const JointSettings& model = settings_.detection;
  const double miss = -std::log1p(-model.detection_probability);
  const double gain = std::log(model.detection_probability / model.clutter_density);
  CostMatrix costs(static_cast<int>(which.size()), static_cast<int>(frame.measurements.size()),
                   kForbidden);
  inside_gates(which, frame, [&](int row, int column, double log_likelihood) {
    costs.at(row, column) = -log_likelihood - gain;
  });
  const Assignment best = assign(costs, std::vector<double>(which.size(), miss));
  for (std::size_t row = 0; row < which.size(); ++row) {
    Track& track = tracks_[which[row]];
    if (best.column_of[row] < 0) {
      track.existence.missed(model.detection_probability * model.gate_probability);
      continue;
    }
    const auto column = static_cast<std::size_t>(best.column_of[row]);
    frame.used[column] = true;
    hit(track, frame.measurements[column]);
  }
}

void Tracker::update_joint(const std::vector<std::size_t>& which, Frame& frame) {
  CostMatrix likelihood(static_cast<int>(which.size()), static_cast<int>(frame.measurements.size()),
                        0.0);
  inside_gates(which, frame, [&](int row, int column, double log_likelihood) {
    likelihood.at(row, column) = std::exp(log_likelihood);
  });
  std::vector<double> seen;
  for (const std::size_t i : which) seen.push_back(tracks_[i].existence.seen);
  const JointSettings& model = settings_.detection;
  const JointProbabilities joint = joint_probabilities(likelihood, seen, model);
  left_out_ += joint.left_out;
  for (std::size_t row = 0; row < which.size(); ++row) {
    Track& track = tracks_[which[row]];
    track.existence.associated(joint.existence[row], joint.missed[row],
                               model.detection_probability * model.gate_probability);
    std::vector<WeightedImm> parts = {{joint.missed[row], track.state}};
    for (std::size_t j = 0; j < frame.measurements.size(); ++j) {
      const double weight = joint.belongs.at(static_cast<int>(row), static_cast<int>(j));
      if (!(weight > 0.0)) continue;
      parts.push_back({weight, track.state});
      if (!tracking::update(parts.back().state, measured_, frame.measurements[j]).applied)
        ++skipped_;
      frame.used[j] = frame.used[j] || weight > kTaken;
    }
    if (joint.missed[row] < 0.5) {
      ++track.hits;
      track.coasted = 0;
      track.unseen_s = 0.0;
    }
    track.state = moments(parts);
  }
}

}  // namespace fanbeam::tracking
