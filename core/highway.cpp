#include "core/highway.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace fanbeam::core {
namespace {

void accelerate(const AccelerationSegment& segment, double time_s, RelativeMotion& motion) {
  const double during_s = std::clamp(time_s, segment.start_s, segment.end_s) - segment.start_s;
  const double after_s = std::max(0.0, time_s - segment.end_s);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double gained_mps = segment.acceleration_mps2[axis] * during_s;
    motion.velocity_mps[axis] += gained_mps;
    motion.position_m[axis] += 0.5 * gained_mps * during_s + gained_mps * after_s;
  }
}

void change_lane(const LaneChange& change, double time_s, RelativeMotion& motion) {
  if (time_s <= change.start_s) return;
  if (time_s >= change.end_s) {
    motion.position_m[1] += change.lateral_m;
    return;
  }
  const double rate_rad_per_s = kPi / (change.end_s - change.start_s);
  const double phase_rad = rate_rad_per_s * (time_s - change.start_s);
  motion.position_m[1] += 0.5 * change.lateral_m * (1.0 - std::cos(phase_rad));
  motion.velocity_mps[1] += 0.5 * change.lateral_m * rate_rad_per_s * std::sin(phase_rad);
}

}  // namespace

bool is_suppressed(const HighwayTarget& target, double time_s) {
  return std::any_of(target.suppressed.begin(), target.suppressed.end(), [&](const TimeSpan& span) {
    return time_s >= span.from_s && time_s < span.to_s;
  });
}

RelativeMotion relative_motion(const HighwayTarget& target, double radar_speed_mps, double time_s) {
  RelativeMotion motion;
  if (target.motion == HighwayMotion::circular) {
    const double angle_rad = target.azimuth_rad + target.angular_rate_rad_per_s * time_s;
    const double speed_mps = target.radius_m * target.angular_rate_rad_per_s;
    motion.position_m = {target.radius_m * std::cos(angle_rad),
                         target.radius_m * std::sin(angle_rad)};
    motion.velocity_mps = {-speed_mps * std::sin(angle_rad), speed_mps * std::cos(angle_rad)};
  } else {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      motion.position_m[axis] = target.position_m[axis] + target.velocity_mps[axis] * time_s;
      motion.velocity_mps[axis] = target.velocity_mps[axis];
    }
    for (const AccelerationSegment& segment : target.accelerations)
      accelerate(segment, time_s, motion);
    for (const LaneChange& change : target.lane_changes) change_lane(change, time_s, motion);
  }
  motion.position_m[0] -= radar_speed_mps * time_s;
  motion.velocity_mps[0] -= radar_speed_mps;
  return motion;
}

HighwayTruth truth_at(const HighwayTarget& target, double radar_speed_mps,
                      const HighwayRadar& radar, double time_s) {
  const RelativeMotion motion = relative_motion(target, radar_speed_mps, time_s);
  const auto [x_m, y_m] = motion.position_m;
  HighwayTruth truth;
  truth.time_s = time_s;
  truth.range_m = std::hypot(x_m, y_m);
  truth.in_view = false;
  if (!(truth.range_m > 0.0)) return truth;
  truth.range_rate_mps =
      (x_m * motion.velocity_mps[0] + y_m * motion.velocity_mps[1]) / truth.range_m;
  truth.azimuth_rad = std::atan2(y_m, x_m);
  truth.in_view =
      truth.range_m <= radar.most_range_m && std::abs(truth.azimuth_rad) <= radar.most_azimuth_rad;
  return truth;
}

}  // namespace fanbeam::core
