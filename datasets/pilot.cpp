#include "datasets/pilot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "core/stop.h"
#include "datasets/draw.h"
#include "datasets/run_conditions.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostScenes = 4, kLeastRuns = 3;

// A folder that goes with it.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / fmt::format("fanbeam-pilot-{}", ::getpid())) {}
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void add_values(const Draw& draw, Drawn& drawn) {
  for (const auto& [name, value] : draw.values) {
    Drawn::Range& range = drawn.ranges[name];
    if (const auto* number = std::get_if<double>(&value)) {
      range.low = std::min(range.low, *number);
      range.high = std::max(range.high, *number);
    } else {
      ++range.words[std::get<std::string>(value)];
    }
  }
}

// Whether nothing is.
bool add_refusals(const Draw& draw, Drawn& drawn) {
  constexpr double kFrequency_Hz = 35e9;
  const core::ProblemList problems = atmosphere::problems_in(weather_of(draw, {}), kFrequency_Hz);
  for (const core::Problem& problem : problems.all()) {
    if (!problem.is_error()) continue;
    Drawn::Refusal& refusal = drawn.refused[problem.field + ": expected " + problem.expected];
    if (refusal.count++ == 0) refusal = {draw.run, to_string(problem), 1};
  }
  return !problems.has_errors();
}

// By how many runs fly them.
std::vector<std::pair<std::string, SceneRuns>> most_frequent(const Drawn& drawn) {
  std::vector<std::pair<std::string, SceneRuns>> sorted(drawn.scenes.begin(), drawn.scenes.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second.count() > b.second.count();
  });
  sorted.resize(std::min(sorted.size(), kMostScenes));
  return sorted;
}

class Pilot {
 public:
  explicit Pilot(Worker& worker) : worker_(worker) {}

  // One run that opens the scene, then `count` that count.
  void fly(const std::string& scene, const SceneRuns& runs, std::size_t count) {
    double first_s = 0.0, seconds = 0.0, bytes = 0.0;
    std::size_t made = 0;
    // Where so many are refused, each of those kept is tried twice: a single good one then counts.
    const std::size_t most = count + 1 + 2 * runs.kept();
    for (std::size_t i = 0; i < most && made <= count; ++i) {
      const auto begin = Clock::now();
      const bool is_made = make(runs.pick(i, count + 1), scene);
      // The first try has the scene opened, even one that is refused; the first run that is made does
      // what is left of that.
      if (i == 0 || (is_made && made == 0))
        first_s += std::chrono::duration<double>(Clock::now() - begin).count();
      if (!is_made || made++ == 0) continue;
      seconds += worker_.cost().seconds;
      bytes += static_cast<double>(worker_.cost().bytes);
    }
    if (made < 2) return;
    const auto counted = static_cast<double>(made - 1);
    figures_.runs += static_cast<int>(made - 1);
    ++figures_.scenes;
    flown_ += runs.count();
    figures_.run_s += seconds / counted * runs.count();
    figures_.run_bytes += bytes / counted * runs.count();
    figures_.open_s += std::max(0.0, first_s - seconds / counted);
  }

  PilotFigures figures() const {
    PilotFigures mean = figures_;
    if (mean.scenes == 0) return mean;
    mean.run_s /= flown_;
    mean.run_bytes /= flown_;
    mean.open_s /= mean.scenes;
    return mean;
  }

 private:
  bool make(int run, const std::string& scene) {
    core::throw_if_stopped();
    const RunEnd end = worker_.make(run);
    for (core::Problem& warning : worker_.new_warnings())
      figures_.warnings.push_back(std::move(warning));
    if (end == RunEnd::made) return true;
    for (const core::Problem& problem : worker_.refused()) {
      core::Problem reason = problem;
      reason.value.clear();  // another in each run
      if (problem.is_error() && reasons_.emplace(scene, core::to_string(reason)).second)
        figures_.refused.push_back({run, scene, core::to_string(problem)});
    }
    return false;
  }

  Worker& worker_;
  std::set<std::pair<std::string, std::string>> reasons_;  // by scene
  PilotFigures figures_;                                   // sums until they are asked for
  double flown_ = 0.0;                                     // runs of the scenes that were measured
};

}  // namespace

void SceneRuns::add(int run) {
  if (count_++ % stride_ != 0) return;
  kept_.push_back(run);
  if (kept_.size() < kMostKept) return;
  for (std::size_t i = 0; i < kMostKept / 2; ++i) kept_[i] = kept_[2 * i];
  kept_.resize(kMostKept / 2);
  stride_ *= 2;
}

int SceneRuns::pick(std::size_t i, std::size_t n) const {
  return kept_[i >= n || kept_.size() < n ? i % kept_.size()
                                          : (2 * i + 1) * kept_.size() / (2 * n)];
}

Drawn drawn_of(const Campaign& campaign) {
  Drawn drawn;
  Drawer drawer(campaign);
  const bool weather =
      std::any_of(campaign.parameters.begin(), campaign.parameters.end(),
                  [](const Parameter& one) { return one.name.starts_with("weather."); });
  for (int run = 0; run < campaign.runs; ++run) {
    const Draw draw = drawer.draw(run);
    add_values(draw, drawn);
    if (weather && !add_refusals(draw, drawn)) continue;
    ++drawn.runs;
    drawn.scenes[scene_of(campaign, draw)].add(run);
  }
  return drawn;
}

PilotFigures fly_pilot(const Campaign& campaign, const Drawn& drawn, WorkerSettings settings) {
  const auto flown = most_frequent(drawn);
  if (flown.empty()) return {};
  const Scratch scratch;
  settings.output = scratch.path();
  settings.replace = true;
  Worker worker(campaign, std::move(settings));
  Pilot pilot(worker);
  const std::size_t each = (kLeastRuns + flown.size() - 1) / flown.size();
  for (const auto& [scene, runs] : flown) pilot.fly(scene, runs, each);
  return pilot.figures();
}

}  // namespace fanbeam::datasets
