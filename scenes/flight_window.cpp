#include "scenes/flight_window.h"

#include <cmath>
#include <optional>
#include <string>

#include "scenes/placed_problems.h"
#include "scenes/scene_pose.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::number_text;

// How many, and what is told of the first.
struct BadFrames {
  int count = 0;
  std::string first;

  void add(const std::string& what) {
    if (count++ == 0) first = what;
  }
};

// The longest run of frames that can be rendered.
class UsableFrames {
 public:
  void add(int frame) {
    if (count_ == 0 || frame != begin_ + count_) {
      begin_ = frame;
      count_ = 0;
    }
    if (++count_ <= longest_count_) return;
    longest_begin_ = begin_;
    longest_count_ = count_;
  }

  std::string text(const Trajectory& trajectory, double rate_Hz, bool by_file) const {
    if (longest_count_ < 2) return "no two frames in a row can be used";
    // Milliseconds inward: a window that is typed in as told holds good frames alone.
    const double first_s = trajectory.frame_time_s(longest_begin_, rate_Hz);
    const double last_s = trajectory.frame_time_s(longest_begin_ + longest_count_ - 1, rate_Hz);
    const std::string from = number_text(std::ceil(first_s * 1000.0) / 1000.0);
    const std::string to = number_text(std::floor(last_s * 1000.0) / 1000.0);
    const std::string frames = " (" + std::to_string(longest_count_) + " frames)";
    if (by_file) return "usable is from_time_s = " + from + " to to_time_s = " + to + frames;
    return "usable is " + from + " s to " + to + " s" + frames;
  }

 private:
  int begin_ = 0, count_ = 0;
  int longest_begin_ = 0, longest_count_ = 0;
};

// Never "0 m": centimetres below ten metres, and what is less is said so.
std::string depth_text(double depth_m) {
  if (depth_m < 0.01) return "less than 0.01";
  const double parts = depth_m < 10.0 ? 100.0 : 10.0;
  return number_text(std::round(depth_m * parts) / parts);
}

std::string place_text(const glm::dvec3& at_m) {
  return number_text(std::round(at_m.x) + 0.0) + " m east, " +
         number_text(std::round(at_m.y) + 0.0) + " m north of the origin";
}

}  // namespace

void check_flight(const SceneDescription& scene, const terrain::LocalFrame& frame,
                  const Trajectory& trajectory, const terrain::HeightField& ground,
                  core::ProblemList& problems) {
  const double rate_Hz = scene.sensor.scan.frame_rate_Hz;
  const core::Place& place = scene.trajectory.place;
  int frames = 0;
  try {
    frames = trajectory.frame_count(rate_Hz);
  } catch (const core::InputError& error) {
    append_placed(problems, error, place, "trajectory");
    return;
  }
  if (frames == 0)
    problems.error(ErrorClass::range, place, "trajectory",
                   number_text(trajectory.end_s() - trajectory.begin_s()) + " s long",
                   "at least one frame of " + number_text(1.0 / rate_Hz) + " s");
  BadFrames outside, below;
  UsableFrames usable;
  for (int k = 0; k < frames; ++k) {
    const renderer::FramePose pose = frame_pose(frame, trajectory, scene.sensor, k);
    const glm::dvec3 at_m = renderer::antenna_of(scene.sensor, pose).position_m;
    const auto ground_m = ground.height_at(at_m.x, at_m.y);
    const std::string when =
        "frame " + std::to_string(k) + " at " + number_text(pose.time_s) + " s: ";
    if (!ground_m)
      outside.add(when + place_text(at_m));
    else if (at_m.z <= *ground_m)
      below.add(when + depth_text(*ground_m - at_m.z) + " m inside the ground");
    else
      usable.add(k);
  }
  if (outside.count == 0 && below.count == 0) return;
  const bool by_file = scene.trajectory.kind == TrajectoryDescription::Kind::file;
  const std::string window = scene.trajectory.kind == TrajectoryDescription::Kind::fixed
                                 ? std::string()
                                 : "; " + usable.text(trajectory, rate_Hz, by_file);
  if (outside.count > 0)
    problems.error(ErrorClass::range, place, "trajectory", outside.first,
                   "positions over the scene's terrain (this is the first frame outside it of " +
                       std::to_string(outside.count) + ")" + window);
  if (below.count > 0)
    problems.error(ErrorClass::range, place, "trajectory", below.first,
                   "an antenna above the ground; check vertical_datum and the sensor's mounting "
                   "(this is the first such frame of " +
                       std::to_string(below.count) + ")" + window);
}

void tell_standing_targets(const SceneDescription& scene, const Trajectory& trajectory,
                           core::ProblemList& problems) {
  if (trajectory.poses().size() < 2) return;
  const auto span_text = [](double begin_s, double end_s) {
    const auto text = [](double time_s) {
      return number_text(std::round(time_s * 1e3) / 1e3 + 0.0);
    };
    return text(begin_s) + " s to " + text(end_s) + " s";
  };
  for (const TargetDescription& target : scene.targets) {
    if (target.path.size() < 2) continue;
    const double begin_s = target.path.front().time_s, end_s = target.path.back().time_s;
    if (end_s > trajectory.begin_s() && begin_s < trajectory.end_s()) continue;
    problems.warning("STANDS", target.place, "target",
                     "\"" + target.name + "\" on its way from " + span_text(begin_s, end_s),
                     "kept where it stands all the time: the flight, on the same clock, is from " +
                         span_text(trajectory.begin_s(), trajectory.end_s()));
  }
}

}  // namespace fanbeam::scenes
