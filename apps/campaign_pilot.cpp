#include "apps/campaign_pilot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "core/parallel.h"
#include "core/stop.h"
#include "datasets/worker.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostScenes = 4, kLeastRuns = 3;

std::string bytes_text(double bytes) {
  return bytes >= 1e12  ? fmt::format("{:.2f} TB", bytes / 1e12)
         : bytes >= 1e9 ? fmt::format("{:.2f} GB", bytes / 1e9)
                        : fmt::format("{:.1f} MB", bytes / 1e6);
}

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

// By how many runs fly them.
std::vector<std::pair<std::string, SceneRuns>> most_frequent(const RunsByScene& scenes) {
  std::vector<std::pair<std::string, SceneRuns>> sorted(scenes.begin(), scenes.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second.count() > b.second.count();
  });
  sorted.resize(std::min(sorted.size(), kMostScenes));
  return sorted;
}

class Pilot {
 public:
  explicit Pilot(datasets::Worker& worker) : worker_(worker) {}

  // One run that opens the scene, then `count` that count: each under other conditions than the one
  // before, as in the campaign.
  void fly(const std::string& scene, const SceneRuns& runs, std::size_t count) {
    const bool opened = make(runs.pick(0, count + 1), scene);
    const double first_s = worker_.cost().seconds;
    double seconds = 0.0, bytes = 0.0;
    int made = 0;
    for (std::size_t i = 1; i <= count; ++i) {
      if (!make(runs.pick(i, count + 1), scene)) continue;
      seconds += worker_.cost().seconds;
      bytes += static_cast<double>(worker_.cost().bytes);
      ++made;
    }
    if (made == 0) return;
    made_ += made;
    ++scenes_;
    flown_ += runs.count();
    seconds_ += seconds / made * runs.count();
    bytes_ += bytes / made * runs.count();
    if (opened) opening_s_ += std::max(0.0, first_s - seconds / made);
  }

  bool any_refused() const { return !told_.empty(); }

  // Scenes that were not flown count as those that were.
  void print(int runs, std::size_t scenes, int cores) const {
    if (made_ == 0) return;
    const double run_s = seconds_ / flown_, run_bytes = bytes_ / flown_;
    const double open_s = opening_s_ / scenes_;
    const double all_s = run_s * runs + open_s * static_cast<double>(scenes);
    fmt::print(
        "pilot of {} runs of {} {} on {} cores: {:.2f} s and {} a run, {:.2f} s to open a scene; "
        "all "
        "of it {} and {:.3g} core hours ({} here)\n",
        made_, scenes_, scenes_ == 1 ? "scene" : "scenes", cores, run_s, bytes_text(run_bytes),
        open_s, bytes_text(run_bytes * runs), all_s * cores / 3600.0,
        all_s < 120.0 ? fmt::format("{:.0f} s", all_s) : fmt::format("{:.0f} min", all_s / 60.0));
  }

 private:
  bool make(int run, const std::string& scene) {
    core::throw_if_stopped();
    if (worker_.make(run) == datasets::RunEnd::made) return true;
    for (const core::Problem& problem : worker_.refused())
      if (problem.is_error() && told_.insert(core::to_string(problem)).second)
        fmt::print("would be refused: run {} of {}: {}\n", run, scene, core::to_string(problem));
    return false;
  }

  datasets::Worker& worker_;
  std::set<std::string> told_;
  int made_ = 0, scenes_ = 0, flown_ = 0;  // flown_: runs of the scenes that were measured
  double seconds_ = 0.0, bytes_ = 0.0, opening_s_ = 0.0;  // of all these runs; of all these scenes
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
  return kept_[kept_.size() < n ? i % kept_.size() : (2 * i + 1) * kept_.size() / (2 * n)];
}

bool print_pilot(const CampaignOptions& options, const datasets::Campaign& campaign,
                 const RunsByScene& scenes) {
  const core::ThreadLimit threads(options.threads);
  const Scratch scratch;
  datasets::Worker worker(campaign,
                          {scratch.path(), shipped_folder(), data_folders(options.data), true});
  const auto flown = most_frequent(scenes);
  const std::size_t each = (kLeastRuns + flown.size() - 1) / flown.size();
  Pilot pilot(worker);
  for (const auto& [scene, runs] : flown) pilot.fly(scene, runs, each);
  pilot.print(campaign.runs, scenes.size(), threads.threads());
  return !pilot.any_refused();
}

}  // namespace fanbeam::apps
