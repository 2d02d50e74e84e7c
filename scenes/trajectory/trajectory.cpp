#include "scenes/trajectory/trajectory.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "core/constants.h"
#include "core/errors.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::ProblemList;

constexpr double kLongestStep_m = 1e6;
constexpr double kSlowestRate_Hz = 1e-3;
constexpr double kFastestRate_Hz = 1e6;
// A frame that ends this part of a frame after the trajectory still counts: times in Unix seconds
// are rounded to 2.4e-7 s.
constexpr double kFrameSlack = 1e-5;

double length(const glm::dquat& q) {
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}

void check_pose(ProblemList& problems, const core::Pose& pose, std::size_t index) {
  const core::Geodetic& p = pose.position;
  // A sum is finite only when all its terms are.
  const double sum = pose.time_s + p.latitude_rad + p.longitude_rad + p.height_m + pose.v_N_mps.x +
                     pose.v_N_mps.y + pose.v_N_mps.z + length(pose.q_NB);
  if (!std::isfinite(sum)) {
    problems.error(ErrorClass::nonfinite, {}, "pose " + std::to_string(index),
                   core::number_text(sum), "finite time, position, attitude and velocity");
    return;
  }
  const bool ordinary = std::abs(p.latitude_rad) < core::kPi / 2.0 &&
                        std::abs(p.longitude_rad) <= core::kPi && std::abs(p.height_m) < 20e3;
  if (!ordinary) {
    try {
      terrain::check_geodetic(p, ("pose " + std::to_string(index)).c_str());
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  }
  if (std::abs(length(pose.q_NB) - 1.0) > 1e-3)
    problems.error(ErrorClass::range, {}, "pose " + std::to_string(index) + " attitude length",
                   core::number_text(length(pose.q_NB)), "0.999 to 1.001");
}

void check_step(ProblemList& problems, const core::Pose& from, const core::Pose& to,
                std::size_t index) {
  const std::string name = "pose " + std::to_string(index);
  if (to.time_s <= from.time_s)
    problems.error(ErrorClass::time, {}, name + " time", core::number_text(to.time_s) + " s",
                   "later than " + core::number_text(from.time_s) + " s");
  const double step_m = glm::distance(terrain::ecef_from_geodetic(foot_point(from.position)),
                                      terrain::ecef_from_geodetic(foot_point(to.position)));
  if (step_m > kLongestStep_m)
    problems.error(ErrorClass::range, {}, name + " distance from the one before",
                   core::number_text(step_m) + " m", "at most 1000 km");
}

void check_rate(double frame_rate_Hz) {
  if (!std::isfinite(frame_rate_Hz))
    core::throw_input_error(ErrorClass::nonfinite, "frame rate", frame_rate_Hz, "a finite rate");
  if (frame_rate_Hz < kSlowestRate_Hz || frame_rate_Hz > kFastestRate_Hz)
    core::throw_input_error(ErrorClass::range, "frame rate", frame_rate_Hz, "0.001 to 1e6 Hz");
}

core::Pose between(const core::Pose& from, const core::Pose& to, double time_s) {
  const double s = (time_s - from.time_s) / (to.time_s - from.time_s);
  const terrain::LocalFrame frame(foot_point(from.position));
  core::Pose pose;
  pose.time_s = time_s;
  pose.position = frame.to_geodetic(s * frame.to_local_m(foot_point(to.position)));
  pose.position.height_m = std::lerp(from.position.height_m, to.position.height_m, s);

  const glm::dmat3 local_from_first = frame.north_east_down_at(from.position);
  const glm::dmat3 local_from_second = frame.north_east_down_at(to.position);
  const glm::dmat3 here_from_local = glm::transpose(frame.north_east_down_at(pose.position));
  const glm::dquat q_LB = core::interpolate(glm::quat_cast(local_from_first) * from.q_NB,
                                            glm::quat_cast(local_from_second) * to.q_NB, s);
  pose.q_NB = glm::normalize(glm::quat_cast(here_from_local) * q_LB);
  pose.v_N_mps = here_from_local *
                 glm::mix(local_from_first * from.v_N_mps, local_from_second * to.v_N_mps, s);
  return pose;
}

}  // namespace

Trajectory::Trajectory(std::vector<core::Pose> poses) : poses_(std::move(poses)) {
  if (poses_.empty())
    core::throw_input_error(ErrorClass::range, "trajectory", "no pose", "at least one pose");
  ProblemList problems;
  for (std::size_t i = 0; i < poses_.size() && !problems.is_full(); ++i)
    check_pose(problems, poses_[i], i);
  problems.throw_if_errors();
  for (std::size_t i = 1; i < poses_.size() && !problems.is_full(); ++i)
    check_step(problems, poses_[i - 1], poses_[i], i);
  problems.throw_if_errors();
}

core::Pose Trajectory::at(double time_s) const {
  if (!std::isfinite(time_s))
    core::throw_input_error(ErrorClass::nonfinite, "time", time_s, "a finite time");
  if (poses_.size() == 1) {
    core::Pose pose = poses_.front();
    pose.time_s = time_s;
    return pose;
  }
  if (time_s < begin_s() || time_s > end_s())
    core::throw_input_error(
        ErrorClass::time, "time", core::number_text(time_s) + " s",
        core::number_text(begin_s()) + " to " + core::number_text(end_s()) + " s");
  const auto next = std::lower_bound(
      poses_.begin(), poses_.end(), time_s,
      [](const core::Pose& pose, double asked_s) { return pose.time_s < asked_s; });
  if (next->time_s == time_s) return *next;
  return between(*(next - 1), *next, time_s);
}

int Trajectory::frame_count(double frame_rate_Hz) const {
  check_rate(frame_rate_Hz);
  if (poses_.size() == 1) return 1;
  const double frames = std::floor((end_s() - begin_s()) * frame_rate_Hz + kFrameSlack);
  if (frames > kMostFrames)
    core::throw_input_error(
        ErrorClass::limit, "number of frames", frames,
        "at most " + std::to_string(kMostFrames) + ": choose a part of the flight");
  return static_cast<int>(frames);
}

double Trajectory::frame_time_s(int frame, double frame_rate_Hz) const {
  check_rate(frame_rate_Hz);
  if (frame < 0) core::throw_input_error(ErrorClass::range, "frame", frame, "0 or more");
  return begin_s() + (frame + 0.5) / frame_rate_Hz;
}

}  // namespace fanbeam::scenes
