#include "scenes/trajectory/track_oddities.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/median.h"
#include "core/units.h"
#include "scenes/trajectory/track_check.h"
#include "scenes/trajectory/track_order.h"

namespace fanbeam::scenes {
namespace {

constexpr double kWindow_s = 2.0;
constexpr double kTurnSpeed_mps = 15.0;  // below, a track has no direction
constexpr double kOddPitch_deg = 45.0;
constexpr double kOddStray_percent = 50.0;  // of what an aircraft could do

constexpr double kLongestSilence_s = 60.0;
constexpr double kShortestGap_s = 5.0;
constexpr double kOddMedians = 10.0;

// Rows beyond one limit, the worst of them remembered.
class Oddity {
 public:
  Oddity(double limit, std::string unit) : limit_(limit), unit_(" " + std::move(unit)) {}

  void see(std::size_t row, double value) {
    if (!(value > limit_)) return;
    if (count_++ == 0 || value > worst_) {
      worst_ = value;
      row_ = row;
    }
  }

  bool seen() const { return count_ > 0; }

  void tell(const RawTrack& track, const char* name, const std::string& what,
            core::ProblemList& problems) const {
    if (count_ == 0) return;
    problems.warning(name, place(track), field(track, what), rounded_text(worst_) + unit_,
                     "flown as it is; usual is " + most());
  }

  void refuse(const RawTrack& track, const std::string& what, core::ProblemList& problems) const {
    if (count_ == 0) return;
    problems.error(core::ErrorClass::range, place(track), field(track, what),
                   rounded_text(worst_) + unit_, most());
  }

 private:
  core::Place place(const RawTrack& track) const { return place_of(track, track.rows[row_]); }

  std::string field(const RawTrack& track, const std::string& what) const {
    return rows_text(track.rows[row_].row, track.rows[row_].row) + ", " + what;
  }

  std::string most() const {
    const std::string text = "at most " + rounded_text(limit_) + unit_;
    if (count_ == 1) return text;
    return text + "; of " + std::to_string(count_) + " rows beyond that this is the worst";
  }

  double limit_;
  std::string unit_;
  std::size_t count_ = 0;
  std::size_t row_ = 0;
  double worst_ = 0.0;
};

// Between two rows at least the window apart.
struct Chord {
  glm::dvec3 foot_mps{0.0};
  double climb_mps = 0.0;
  double duration_s = 0.0;
};

Chord chord(const TrackMotion& motion, std::size_t from, std::size_t to) {
  const double duration_s = motion.time_s(to) - motion.time_s(from);
  return {(motion.foot_m(to) - motion.foot_m(from)) / duration_s,
          (motion.height_m(to) - motion.height_m(from)) / duration_s, duration_s};
}

double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(a, b) / (glm::length(a) * glm::length(b)), -1.0, 1.0));
}

struct Oddities {
  Oddity speed{350.0, "m/s"};
  Oddity climb{50.0, "m/s"};
  Oddity acceleration{20.0, "m/s2"};
  Oddity impossible{kHardestAcceleration_mps2, "m/s2"};
  Oddity turn{30.0, "deg/s"};
  Oddity path{kOddPitch_deg, "deg"};
};

void look_at(const TrackMotion& motion, std::size_t i, const Chord& before, const Chord& after,
             bool pitch_derived, Oddities& odd) {
  const TrackTolerance& noise = motion.tolerance();
  const std::size_t row = motion.row(i);
  const double speed_mps = glm::length(after.foot_mps);
  const double climb_mps =
      std::max(0.0, std::abs(after.climb_mps) - noise.height_m / after.duration_s);
  odd.speed.see(row, speed_mps - noise.position_m / after.duration_s);
  odd.climb.see(row, climb_mps);
  if (pitch_derived && speed_mps >= AttitudeAssumptions{}.slowest_mps)
    odd.path.see(row, core::degrees(std::atan2(climb_mps, speed_mps)));

  const double between_s = 0.5 * (before.duration_s + after.duration_s);
  const auto beyond_noise = [&](double change_mps, double noise_m) {
    return std::max(
        0.0, change_mps / between_s - 2.0 * noise_m / (before.duration_s * after.duration_s));
  };
  const double acceleration_mps2 =
      std::hypot(beyond_noise(glm::distance(after.foot_mps, before.foot_mps), noise.position_m),
                 beyond_noise(std::abs(after.climb_mps - before.climb_mps), noise.height_m));
  odd.acceleration.see(row, acceleration_mps2);
  odd.impossible.see(row, acceleration_mps2);

  const double slower_mps = std::min(speed_mps, glm::length(before.foot_mps));
  if (slower_mps < kTurnSpeed_mps) return;
  const double uncertain_rad = noise.position_m / (slower_mps * after.duration_s) +
                               noise.position_m / (slower_mps * before.duration_s);
  const double turn_rad = angle_between_rad(after.foot_mps, before.foot_mps) - uncertain_rad;
  odd.turn.see(row, core::degrees(turn_rad / between_s));
}

Oddities oddities_of(const TrackMotion& motion, bool pitch_derived) {
  Oddities odd;
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double time_s = motion.time_s(i);
    while (from + 1 < i && motion.time_s(from + 1) <= time_s - kWindow_s) ++from;
    while (to + 1 < motion.size() && motion.time_s(to) < time_s + kWindow_s) ++to;
    if (motion.time_s(from) > time_s - kWindow_s || motion.time_s(to) < time_s + kWindow_s)
      continue;
    look_at(motion, i, chord(motion, from, i), chord(motion, i, to), pitch_derived, odd);
  }
  return odd;
}

void warn_of_pitch(const RawTrack& track, core::ProblemList& problems) {
  if (!track.has_pitch) return;
  Oddity pitch(kOddPitch_deg, "deg");
  for (std::size_t i = 0; i < track.rows.size(); ++i)
    pitch.see(i, std::abs(core::degrees(track.rows[i].pitch_rad)));
  pitch.tell(track, "PITCH", "pitch up or down", problems);
}

void warn_of_strays(const RawTrack& track, const TrackMotion& motion, core::ProblemList& problems) {
  Oddity position(kOddStray_percent, "%");
  Oddity height(kOddStray_percent, "%");
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) {
    const StepMisfit step = motion.misfit(i, i + 1);
    if (step.kind == Misfit::position) position.see(motion.row(i + 1), 100.0 * step.ratio);
    if (step.kind == Misfit::height) height.see(motion.row(i + 1), 100.0 * step.ratio);
  }
  position.tell(track, "STRAY", "stray from the flight around it, of what is possible", problems);
  height.tell(track, "STRAY", "stray from the heights around it, of what is possible", problems);
}

}  // namespace

void tell_oddities(const RawTrack& track, const TrackMotion& motion, core::ProblemList& problems) {
  warn_of_strays(track, motion, problems);
  warn_of_pitch(track, problems);
  const Oddities odd = oddities_of(motion, !track.has_pitch);
  odd.speed.tell(track, "SPEED", "ground speed", problems);
  odd.climb.tell(track, "CLIMB", "climb or descent", problems);
  odd.turn.tell(track, "TURN", "turn rate", problems);
  odd.path.tell(track, "PITCH", "angle of the path, which the pitch follows", problems);
  if (odd.impossible.seen())
    odd.impossible.refuse(track, "acceleration", problems);
  else
    odd.acceleration.tell(track, "ACCELERATION", "acceleration", problems);
}

void warn_of_gaps(const RawTrack& track, core::ProblemList& problems) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < track.rows.size(); ++i)
    steps_s.push_back(track.rows[i].time_s - track.rows[i - 1].time_s);
  if (steps_s.empty()) return;
  const double limit_s =
      std::clamp(kOddMedians * core::median(steps_s), kShortestGap_s, kLongestSilence_s);
  Oddity gap(limit_s, "s");
  for (std::size_t i = 0; i < steps_s.size(); ++i) gap.see(i + 1, steps_s[i]);
  gap.tell(track, "GAP", "time since the row before", problems);
}

}  // namespace fanbeam::scenes
