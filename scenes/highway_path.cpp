#include "scenes/highway_path.h"

#include <algorithm>
#include <cmath>

#include "core/spelling.h"

namespace fanbeam::scenes {
namespace {

constexpr double kLeg_s = 1e-3;
constexpr double kBeyond_s = 1.0;
constexpr std::size_t kMostWaypoints = 200'000;

struct Span {
  double start_s, end_s;
};

std::vector<Span> accelerating(const core::HighwayTarget& target, double begin_s, double end_s) {
  if (target.motion == core::HighwayMotion::circular) return {{begin_s, end_s}};
  std::vector<Span> spans;
  for (const core::AccelerationSegment& segment : target.accelerations)
    spans.push_back({segment.start_s, segment.end_s});
  for (const core::LaneChange& change : target.lane_changes)
    spans.push_back({change.start_s, change.end_s});
  return spans;
}

template <class Named>
std::string ids_there_text(const std::string& wanted, const std::vector<Named>& there) {
  std::vector<std::string> ids;
  for (const Named& one : there) ids.push_back(one.id);
  return core::names_there_text(wanted, ids);
}

}  // namespace

std::vector<double> highway_times_s(const core::HighwayTarget& target, double duration_s) {
  const double begin_s = -kBeyond_s, end_s = duration_s + kBeyond_s;
  std::vector<double> times_s = {begin_s, end_s};
  for (const Span& span : accelerating(target, begin_s, end_s)) {
    const double first = std::floor(std::max(span.start_s, begin_s) / kLeg_s) - 0.5;
    const double last = std::ceil(std::min(span.end_s, end_s) / kLeg_s) + 0.5;
    if (static_cast<double>(times_s.size()) + last - first >= static_cast<double>(kMostWaypoints))
      core::throw_input_error(core::ErrorClass::limit, "highway", duration_s,
                              "accelerations of 200 s at most");
    for (double leg = first; leg <= last; leg += 1.0) times_s.push_back(leg * kLeg_s);
  }
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  std::erase_if(times_s, [&](double time_s) { return time_s < begin_s || time_s > end_s; });
  return times_s;
}

const HighwayFile* HighwayPaths::file_of(core::ConfigTable& table) {
  const std::filesystem::path file = search_->find(table, "file");
  if (file.empty()) return nullptr;
  if (const auto known = files_.find(file); known != files_.end()) return &known->second;
  try {
    return &files_.emplace(file, read_highway_file(file)).first->second;
  } catch (const core::InputError& error) {
    table.problems().append(error.problems());
    return nullptr;
  }
}

std::vector<TargetDescription::Waypoint> HighwayPaths::path(core::ConfigTable& target,
                                                            const Spot& origin,
                                                            double above_ground_m,
                                                            WaypointBudget& budget) {
  core::ConfigTable table = target.table("highway");
  const std::string scenario_id = table.required_text("scenario");
  const std::string target_id = table.required_text("target");
  const HighwayFile* file = file_of(table);
  if (!origin.on_runway && !origin.field.empty())
    target.error(core::ErrorClass::ref, "at", "no runway", "the origin as a place on a runway");
  if (file == nullptr) return {};
  const auto scenario = std::find_if(file->scenarios.begin(), file->scenarios.end(),
                                     [&](const auto& one) { return one.id == scenario_id; });
  if (scenario == file->scenarios.end()) {
    table.error(core::ErrorClass::ref, "scenario", scenario_id,
                "a scenario of the file" + ids_there_text(scenario_id, file->scenarios));
    return {};
  }
  const auto law = std::find_if(scenario->targets.begin(), scenario->targets.end(),
                                [&](const auto& one) { return one.id == target_id; });
  if (law == scenario->targets.end()) {
    table.error(core::ErrorClass::ref, "target", target_id,
                "a target of the scenario" + ids_there_text(target_id, scenario->targets));
    return {};
  }
  if (budget.is_spent()) return {};
  std::vector<TargetDescription::Waypoint> result;
  try {
    const std::vector<double> times_s = highway_times_s(*law, scenario->duration_s);
    if (!budget.take(target, "highway", static_cast<double>(times_s.size()))) return {};
    result.reserve(times_s.size());
    for (const double time_s : times_s) {
      // Of a radar that stands still: over ground.
      const core::RelativeMotion motion = relative_motion(*law, 0.0, time_s);
      Spot spot = origin;
      spot.behind_threshold_m += motion.position_m[0];
      spot.left_m -= motion.position_m[1];
      result.push_back({time_s, spot, above_ground_m});
    }
  } catch (const core::InputError& error) {
    target.problems().append(error.problems());
  }
  return result;
}

std::vector<std::filesystem::path> HighwayPaths::files() const {
  std::vector<std::filesystem::path> result;
  for (const auto& [file, content] : files_) result.push_back(file);
  return result;
}

}  // namespace fanbeam::scenes
