#include "scenes/trajectory/track_turning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/median.h"
#include "core/pose.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

constexpr double kFree_deg = 10.0;  // whatever the time
constexpr double kRoll_deg_per_s = 400.0;
constexpr double kYaw_deg_per_s = 60.0;
constexpr double kHoverYaw_deg_per_s = 120.0;
constexpr double kHover_mps = 40.0;
constexpr double kLargestFastTurn_deg = 100.0;
constexpr double kMedianTurns = 15.0;
constexpr double kSteep_rad = core::radians(60.0);

TurnMisfit worse(const TurnMisfit& a, const TurnMisfit& b) { return b.ratio > a.ratio ? b : a; }

}  // namespace

TrackTurning::TrackTurning(const RawTrack& track, std::vector<std::size_t> rows,
                           std::vector<double> speeds_mps)
    : track_(track), rows_(std::move(rows)), speeds_mps_(std::move(speeds_mps)) {
  std::vector<double> rotations_deg, headings_deg, pitches_deg;
  for (std::size_t i = 0; i + 1 < size(); ++i) {
    const Turn step = turn(i, i + 1);
    rotations_deg.push_back(core::degrees(step.rotation_rad));
    pitches_deg.push_back(core::degrees(step.pitch_rad));
    if (!step.steep) headings_deg.push_back(core::degrees(step.heading_rad));
  }
  median_rotation_deg_ = core::median(rotations_deg);
  median_heading_deg_ = core::median(headings_deg);
  median_pitch_deg_ = core::median(pitches_deg);
}

TrackTurning::Turn TrackTurning::turn(std::size_t from, std::size_t to) const {
  const TrackRow& a = at(from);
  const TrackRow& b = at(to);
  const glm::dquat q_a = core::quaternion_from({a.roll_rad, a.pitch_rad, a.heading_rad});
  const glm::dquat q_b = core::quaternion_from({b.roll_rad, b.pitch_rad, b.heading_rad});
  Turn turn;
  turn.rotation_rad = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(q_a, q_b))));
  turn.heading_rad = std::abs(core::wrap_pi_rad(b.heading_rad - a.heading_rad));
  turn.pitch_rad = std::abs(b.pitch_rad - a.pitch_rad);
  turn.roll_rad = std::abs(core::wrap_pi_rad(b.roll_rad - a.roll_rad));
  turn.steep = std::max(std::abs(a.pitch_rad), std::abs(b.pitch_rad)) > kSteep_rad;
  return turn;
}

TurnMisfit TrackTurning::misfit(std::size_t from, std::size_t to) const {
  const Turn step = turn(from, to);
  const double step_s = at(to).time_s - at(from).time_s;
  const bool hovers = std::min(speeds_mps_[from], speeds_mps_[to]) < kHover_mps;
  const auto allowed_deg = [&](double rate_deg_per_s, double median_deg) {
    const double free_deg = kFree_deg + rate_deg_per_s * step_s;
    return std::max(hovers ? free_deg : std::min(free_deg, kLargestFastTurn_deg),
                    kMedianTurns * median_deg);
  };
  const auto against = [](const char* angle, double found_rad, double allowed) -> TurnMisfit {
    const double found_deg = core::degrees(found_rad);
    return {angle, found_deg / allowed, found_deg, allowed};
  };
  const bool rolls = step.roll_rad >= std::max(step.heading_rad, step.pitch_rad);
  const TurnMisfit rotation =
      against(rolls                               ? "roll"
              : step.pitch_rad > step.heading_rad ? "pitch"
                                                  : "heading",
              step.rotation_rad, allowed_deg(kRoll_deg_per_s, median_rotation_deg_));
  const TurnMisfit pitch =
      against("pitch", step.pitch_rad, allowed_deg(kYaw_deg_per_s, median_pitch_deg_));
  if (step.steep) return worse(rotation, pitch);
  const TurnMisfit heading =
      against("heading", step.heading_rad,
              allowed_deg(hovers ? kHoverYaw_deg_per_s : kYaw_deg_per_s, median_heading_deg_));
  return worse(worse(pitch, heading), rotation);
}

}  // namespace fanbeam::scenes
