#include "tracking/tracker/tracker.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/number_range.h"
#include "tracking/filters/chi_square.h"
#include "tracking/tracker/tracker_frame_private.h"

namespace fanbeam::tracking {
namespace {

// A car seen for a third of a second outlives a gap of 0.6 s, a ghost seen three times six frames.
constexpr int kCoastedPerHit = 2;

RadarMeasurement with_floors(RadarMeasurement one, const TrackerSettings& settings) {
  one.range_sigma_m = std::hypot(one.range_sigma_m, one.range_systematic_m, settings.range_floor_m);
  one.range_rate_sigma_mps = std::hypot(one.range_rate_sigma_mps, one.range_rate_systematic_mps,
                                        settings.range_rate_floor_mps);
  one.azimuth_sigma_rad =
      std::hypot(one.azimuth_sigma_rad, one.azimuth_systematic_rad, settings.azimuth_floor_rad);
  return one;
}

void check(const TrackerSettings& settings) {
  core::ProblemList problems;
  if (settings.motion.motions.empty())
    problems.error(core::ErrorClass::range, {}, "tracker.motion", "none", "at least one model");
  const auto within = [&](const char* field, double value, const core::NumberRange& range) {
    core::check_range(problems, std::string("tracker.") + field, value, range);
  };
  const core::NumberRange above_0{.low = 0.0, .above_low = true};
  within("confirm_ratio", settings.confirm_ratio, {.low = 1.0, .above_low = true});
  within("confirm_window", settings.confirm_window, {.low = 2.0});
  within("most_coasted", settings.most_coasted, {.low = 0.0});
  const double seen = settings.detection.detection_probability;
  if (!(seen > 0.0 && seen < 1.0))
    problems.error(core::ErrorClass::range, {}, "tracker.detection_probability",
                   core::number_text(seen), "above 0 and below 1");
  within("clutter_density", settings.detection.clutter_density, above_0);
  within("believed_s", settings.believed_s, above_0);
  problems.throw_if_errors();
}

}  // namespace

Tracker::Tracker(TrackerSettings settings) : settings_(std::move(settings)) {
  check(settings_);
  measured_ =
      settings_.motion.axes() == 1 ? Measured::range_and_rate : Measured::range_rate_and_azimuth;
  gate_ = chi_square_quantile(settings_.detection.gate_probability, dimension(measured_));
}

void Tracker::update(double time_s, const std::vector<RadarMeasurement>& measurements) {
  if (!std::isfinite(time_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "time_s", time_s, "a finite time");
  if (time_s_ && time_s < *time_s_)
    core::throw_input_error(core::ErrorClass::time, "time_s", time_s, "not before the last one");
  if (measurements.size() > kMostMeasurements)
    core::throw_input_error(
        core::ErrorClass::limit, "measurements of the frame at " + core::number_text(time_s) + " s",
        std::to_string(measurements.size()), "at most " + std::to_string(kMostMeasurements));
  Frame frame;
  frame.time_s = time_s;
  for (const RadarMeasurement& one : measurements) {
    // Refuses what is not a measurement before anything changes.
    start_state(one, settings_.motion.axes(), 1.0);
    frame.measurements.push_back(with_floors(one, settings_));
    // Where no azimuth is told, whatever stands there must not keep anything apart.
    if (settings_.motion.axes() == 1) frame.measurements.back().azimuth_rad = 0.0;
  }
  frame.used.assign(measurements.size(), false);
  const double step_s = time_s_ ? time_s - *time_s_ : 0.0;
  for (Track& track : tracks_) {
    predict(settings_.motion, step_s, track.state);
    ++track.frames;
    ++track.coasted;
    track.unseen_s += step_s;
    if (track.confirmed && !track.unresolved_with)
      track.existence.pass(step_s, settings_.believed_s);
  }
  std::erase_if(tracks_, [&](const Track& track) {
    return (track.unresolved_with ? step_s : track.unseen_s) > settings_.longest_gap_s;
  });
  time_s_ = time_s;
  find_unresolved(step_s, frame);
  part(frame);
  associate(frame);
  end_and_confirm();
  start(frame);
}

void Tracker::hit(Track& track, const RadarMeasurement& measurement) {
  const Update told = tracking::update(track.state, measured_, measurement);
  if (!told.applied) {
    ++skipped_;
    return;
  }
  const JointSettings& model = settings_.detection;
  const double log_ratio =
      told.log_likelihood + std::log(model.detection_probability / model.clutter_density);
  track.log_ratio += log_ratio;
  if (track.confirmed) track.existence.measured(log_ratio);
  ++track.hits;
  track.coasted = 0;
  track.unseen_s = 0.0;
}

void Tracker::end_and_confirm() {
  const double enough = std::log(settings_.confirm_ratio);
  for (Track& track : tracks_) {
    if (track.confirmed) continue;
    if (track.coasted > 0)
      track.log_ratio += std::log1p(-settings_.detection.detection_probability);
    if (track.log_ratio < enough) continue;
    track.confirmed = true;
    track.existence = {1.0 / (1.0 + std::exp(-track.log_ratio)), 0.0};
  }
  const auto ended = [&](const Track& track) {
    if (!track.confirmed) return track.frames >= settings_.confirm_window;
    const PolarPlace place = polar(track.state);
    const int coasted = track.unresolved_with ? track.unresolved_unseen : track.coasted;
    return coasted > std::min(settings_.most_coasted, kCoastedPerHit * track.hits) ||
           place.range_m > settings_.most_range_m ||
           std::abs(place.azimuth_rad) > settings_.most_azimuth_rad;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), ended), tracks_.end());
}

bool Tracker::second_of_confirmed(const RadarMeasurement& one,
                                  const std::vector<PolarPlace>& places) const {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    if (!track.confirmed || !unresolved(places[i], polar(one), settings_.resolution)) continue;
    if (!has_azimuth() || track.coasted > 0) return true;
    const Update told = innovation(track.state, measured_, one);
    if (!told.applied || told.normalised_innovation_squared <= gate_) return true;
  }
  return false;
}

void Tracker::start(const Frame& frame) {
  std::vector<PolarPlace> places;
  for (const Track& track : tracks_) places.push_back(polar(track.state));
  std::vector<RadarMeasurement> fresh;
  for (std::size_t j = 0; j < frame.measurements.size(); ++j)
    if (!frame.used[j] && !second_of_confirmed(frame.measurements[j], places))
      fresh.push_back(frame.measurements[j]);
  // In the order of range, so that numbers do not depend on the order of measurements.
  std::stable_sort(fresh.begin(), fresh.end(),
                   [](const auto& a, const auto& b) { return a.range_m < b.range_m; });
  const std::vector<PairPlaces> pairs = pairs_aside();
  for (const RadarMeasurement& one : fresh) {
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const PairPlaces& aside) {
      return between(polar(one), aside.here, aside.there, settings_.resolution);
    });
    Track track;
    track.id = next_id_++;
    track.hits = track.frames = 1;
    if (pair != pairs.end()) track.began_on = pair->id;
    track.state = start_imm(settings_.motion, start_state(one, settings_.motion.axes(),
                                                          settings_.start_tangential_sigma_mps));
    tracks_.push_back(std::move(track));
  }
}

}  // namespace fanbeam::tracking
