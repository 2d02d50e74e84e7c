#include "tracking/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/waveform/doppler.h"
#include "tracking/association/crossing.h"
#include "tracking/filters/chi_square.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::tracking {
namespace {

constexpr Measured kMeasured = Measured::range_rate_and_azimuth;
constexpr double kForbidden = std::numeric_limits<double>::infinity();

RadarMeasurement with_floors(RadarMeasurement one, const TrackerSettings& settings) {
  one.range_sigma_m = std::hypot(one.range_sigma_m, settings.range_floor_m);
  one.range_rate_sigma_mps = std::hypot(one.range_rate_sigma_mps, settings.range_rate_floor_mps);
  one.azimuth_sigma_rad = std::hypot(one.azimuth_sigma_rad, settings.azimuth_floor_rad);
  return one;
}

}  // namespace

Tracker::Tracker(TrackerSettings settings) : settings_(std::move(settings)) {
  gate_ = chi_square_quantile(settings_.gate_probability, dimension(kMeasured));
  if (settings_.confirm_hits < 1 || settings_.confirm_window < settings_.confirm_hits ||
      settings_.most_coasted < 0)
    core::throw_input_error(core::ErrorClass::range, "tracker.confirm_hits", settings_.confirm_hits,
                            "1 to confirm_window");
  if (!(settings_.joint.detection_probability > 0.0 &&
        settings_.joint.detection_probability < 1.0) ||
      !(settings_.joint.clutter_density > 0.0))
    core::throw_input_error(core::ErrorClass::range, "tracker.detection_probability",
                            settings_.joint.detection_probability,
                            "above 0 and below 1, with a clutter density above 0");
}

void Tracker::update(double time_s, const std::vector<RadarMeasurement>& measurements) {
  if (!std::isfinite(time_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "time_s", time_s, "a finite time");
  if (time_s_ && time_s < *time_s_)
    core::throw_input_error(core::ErrorClass::time, "time_s", time_s, "not before the last one");
  std::vector<RadarMeasurement> seen;
  for (const RadarMeasurement& one : measurements) {
    start_state(one, 1.0);  // refuses what is not a measurement before anything changes
    seen.push_back(with_floors(one, settings_));
  }
  const double step_s = time_s_ ? time_s - *time_s_ : 0.0;
  for (Track& track : tracks_) {
    predict(settings_.motion, step_s, track.state);
    ++track.frames;
    ++track.coasted;
  }
  time_s_ = time_s;
  std::vector<bool> used(seen.size(), false);
  find_unresolved(step_s);
  part(seen, used);
  associate(seen, used);
  end_and_confirm();
  start(seen, used);
}

// Pairs stay together until `part` or time separates them.
void Tracker::find_unresolved(double step_s) {
  for (Track& track : tracks_) {
    if (!track.unresolved_with) continue;
    track.unresolved_s += step_s;
    if (track.unresolved_s > settings_.most_unresolved_s) {
      track.unresolved_with.reset();
      track.coasted = 1;
    }
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    for (std::size_t j = i + 1; j < tracks_.size(); ++j) {
      Track &a = tracks_[i], &b = tracks_[j];
      if (!a.confirmed || !b.confirmed || a.unresolved_with || b.unresolved_with ||
          std::max(a.unresolved_s, b.unresolved_s) > settings_.most_unresolved_s)
        continue;
      const bool close = unresolved(polar(a.state), polar(b.state), settings_);
      if (!close) continue;
      a.unresolved_with = b.id;
      b.unresolved_with = a.id;
      a.unresolved_s = b.unresolved_s = 0.0;
    }
}

// Lets pairs go that are predicted apart and have a measurement each.
void Tracker::part(const std::vector<RadarMeasurement>& measurements, std::vector<bool>& used) {
  for (Track& a : tracks_) {
    if (!a.unresolved_with) continue;
    const auto other = std::find_if(tracks_.begin(), tracks_.end(),
                                    [&](const Track& one) { return one.id == *a.unresolved_with; });
    if (other == tracks_.end() || other->unresolved_with != a.id) {
      a.unresolved_with.reset();
      continue;
    }
    Track& b = *other;
    if (b.id < a.id || unresolved(polar(a.state), polar(b.state), settings_)) continue;
    double best = -kForbidden;
    std::size_t first = 0, second = 0;
    const auto fit = [&](const Track& track, std::size_t j) {
      const Update told = innovation(track.state, kMeasured, measurements[j]);
      return told.applied && told.normalised_innovation_squared <= gate_ ? told.log_likelihood
                                                                         : -kForbidden;
    };
    std::vector<double> fits_b;
    for (std::size_t j = 0; j < measurements.size(); ++j) fits_b.push_back(fit(b, j));
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const double fit_a = used[i] ? -kForbidden : fit(a, i);
      if (fit_a == -kForbidden) continue;
      for (std::size_t j = 0; j < measurements.size(); ++j) {
        if (i == j || used[j] || fit_a + fits_b[j] <= best ||
            unresolved(polar(measurements[i]), polar(measurements[j]), settings_))
          continue;
        best = fit_a + fits_b[j];
        first = i;
        second = j;
      }
    }
    if (best == -kForbidden) continue;
    const double kept =
        kept_probability(a.state, b.state, kMeasured, measurements[first], measurements[second]);
    hit(a, measurements[first]);
    hit(b, measurements[second]);
    used[first] = used[second] = true;
    a.identity_probability *= kept;
    b.identity_probability *= kept;
    a.unresolved_with.reset();
    b.unresolved_with.reset();
    a.unresolved_s = b.unresolved_s = 0.0;
  }
}

void Tracker::hit(Track& track, const RadarMeasurement& measurement) {
  if (!tracking::update(track.state, kMeasured, measurement).applied) {
    ++skipped_;
    return;
  }
  ++track.hits;
  track.coasted = 0;
}

void Tracker::associate(const std::vector<RadarMeasurement>& measurements,
                        std::vector<bool>& used) {
  for (const bool confirmed : {true, false}) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const Track& track = tracks_[i];
      if (track.confirmed == confirmed && !track.unresolved_with && track.coasted > 0)
        which.push_back(i);
    }
    if (confirmed && settings_.association == Association::joint)
      update_joint(which, measurements, used);
    else
      update_nearest(which, measurements, used);
  }
}

void Tracker::update_nearest(const std::vector<std::size_t>& which,
                             const std::vector<RadarMeasurement>& measurements,
                             std::vector<bool>& used) {
  const JointSettings& model = settings_.joint;
  const double miss = -std::log(1.0 - model.detection_probability);
  const double gain = std::log(model.detection_probability / model.clutter_density);
  CostMatrix costs(static_cast<int>(which.size()), static_cast<int>(measurements.size()),
                   kForbidden);
  for (int row = 0; row < costs.rows; ++row)
    for (int column = 0; column < costs.columns; ++column) {
      if (used[static_cast<std::size_t>(column)]) continue;
      const Update told = innovation(tracks_[which[static_cast<std::size_t>(row)]].state, kMeasured,
                                     measurements[static_cast<std::size_t>(column)]);
      if (told.applied && told.normalised_innovation_squared <= gate_)
        costs.at(row, column) = -told.log_likelihood - gain;
    }
  const Assignment best = assign(costs, std::vector<double>(which.size(), miss));
  for (std::size_t row = 0; row < which.size(); ++row) {
    if (best.column_of[row] < 0) continue;
    const auto column = static_cast<std::size_t>(best.column_of[row]);
    used[column] = true;
    hit(tracks_[which[row]], measurements[column]);
  }
}

void Tracker::update_joint(const std::vector<std::size_t>& which,
                           const std::vector<RadarMeasurement>& measurements,
                           std::vector<bool>& used) {
  CostMatrix likelihood(static_cast<int>(which.size()), static_cast<int>(measurements.size()), 0.0);
  std::vector<double> existence;
  for (int row = 0; row < likelihood.rows; ++row) {
    const Track& track = tracks_[which[static_cast<std::size_t>(row)]];
    existence.push_back(track.existence);
    for (int column = 0; column < likelihood.columns; ++column) {
      if (used[static_cast<std::size_t>(column)]) continue;
      const Update told =
          innovation(track.state, kMeasured, measurements[static_cast<std::size_t>(column)]);
      if (told.applied && told.normalised_innovation_squared <= gate_)
        likelihood.at(row, column) = std::exp(told.log_likelihood);
    }
  }
  const JointProbabilities joint = joint_probabilities(likelihood, existence, settings_.joint);
  for (std::size_t row = 0; row < which.size(); ++row) {
    Track& track = tracks_[which[row]];
    track.existence = joint.existence[row];
    std::vector<WeightedImm> parts = {{joint.missed[row], track.state}};
    for (std::size_t j = 0; j < measurements.size(); ++j) {
      const double weight = joint.belongs.at(static_cast<int>(row), static_cast<int>(j));
      if (!(weight > 0.0)) continue;
      parts.push_back({weight, track.state});
      tracking::update(parts.back().state, kMeasured, measurements[j]);
      used[j] = used[j] || weight > 0.01;
    }
    if (joint.missed[row] < 0.5) {
      ++track.hits;
      track.coasted = 0;
    }
    track.state = moments(parts);
  }
}

void Tracker::end_and_confirm() {
  for (Track& track : tracks_)
    track.confirmed = track.confirmed || track.hits >= settings_.confirm_hits;
  const auto ended = [&](const Track& track) {
    if (!track.confirmed)
      return settings_.confirm_window - track.frames < settings_.confirm_hits - track.hits;
    const PolarPlace place = polar(track.state);
    return (track.coasted > settings_.most_coasted && !track.unresolved_with) ||
           place.range_m > settings_.most_range_m ||
           std::abs(place.azimuth_rad) > settings_.most_azimuth_rad;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), ended), tracks_.end());
}

bool Tracker::near_confirmed(const RadarMeasurement& measurement) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
    return track.confirmed && unresolved(polar(track.state), polar(measurement), settings_);
  });
}

void Tracker::start(const std::vector<RadarMeasurement>& measurements,
                    const std::vector<bool>& used) {
  const std::size_t before = tracks_.size();
  for (std::size_t j = 0; j < measurements.size(); ++j) {
    if (used[j] || near_confirmed(measurements[j])) continue;
    Track track;
    track.id = next_id_++;
    track.hits = track.frames = 1;
    track.confirmed = settings_.confirm_hits == 1;
    track.state = start_imm(settings_.motion,
                            start_state(measurements[j], settings_.start_tangential_sigma_mps));
    tracks_.push_back(std::move(track));
  }
  // In the order of range, so that numbers do not depend on the order of measurements.
  std::sort(tracks_.begin() + static_cast<std::ptrdiff_t>(before), tracks_.end(),
            [](const Track& a, const Track& b) {
              return polar(a.state).range_m < polar(b.state).range_m;
            });
  for (std::size_t i = before; i < tracks_.size(); ++i)
    tracks_[i].id = next_id_ - static_cast<int>(tracks_.size() - i);
}

bool is_moving(const Track& track, const std::array<double, 2>& radar_velocity_mps,
               double least_mps) {
  const Gaussian state = combined(track.state);
  const double vx = state.mean[2] + radar_velocity_mps[0];
  const double vy = state.mean[3] + radar_velocity_mps[1];
  const double speed = std::hypot(vx, vy);
  if (!(speed > least_mps)) return false;
  const double variance = (vx * vx * state.variance(2, 2) + 2.0 * vx * vy * state.variance(2, 3) +
                           vy * vy * state.variance(3, 3)) /
                          (speed * speed);
  return speed - 2.0 * std::sqrt(std::max(variance, 0.0)) > least_mps;
}

}  // namespace fanbeam::tracking
