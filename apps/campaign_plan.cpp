#include "apps/campaign_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/stop_on_signals.h"
#include "apps/text_table.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "datasets/draw.h"
#include "datasets/run_conditions.h"
#include "datasets/worker.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using datasets::Campaign;

constexpr int kPilotRuns = 3;

// What the draws of a parameter come to.
struct Range {
  double low = 1e300, high = -1e300;
  std::map<std::string, int> words;
};

struct Refusal {
  int run = 0;
  std::string why;
  int count = 0;
};

struct Drawn {
  std::map<std::string, Range> ranges;
  std::map<std::string, Refusal> refused;  // by what is wrong
};

// All runs, without a scene: what its weather would make of them is told by the runs themselves.
Drawn draw_all(const Campaign& campaign) {
  constexpr double kFrequency_Hz = 35e9;
  Drawn drawn;
  datasets::Drawer drawer(campaign);
  const bool weather = std::any_of(
      campaign.parameters.begin(), campaign.parameters.end(),
      [](const datasets::Parameter& parameter) { return parameter.name.starts_with("weather."); });
  for (int run = 0; run < campaign.runs; ++run) {
    const datasets::Draw draw = drawer.draw(run);
    for (const auto& [name, value] : draw.values) {
      Range& range = drawn.ranges[name];
      if (const auto* number = std::get_if<double>(&value)) {
        range.low = std::min(range.low, *number);
        range.high = std::max(range.high, *number);
      } else {
        ++range.words[std::get<std::string>(value)];
      }
    }
    if (!weather) continue;
    const core::ProblemList problems =
        atmosphere::problems_in(datasets::weather_of(draw, {}), kFrequency_Hz);
    for (const core::Problem& problem : problems.all()) {
      if (!problem.is_error()) continue;
      Refusal& refusal = drawn.refused[problem.field + ": expected " + problem.expected];
      if (refusal.count++ == 0) refusal = {run, to_string(problem), 1};
    }
  }
  return drawn;
}

void print_ranges(const Campaign& campaign, const Drawn& drawn) {
  for (const datasets::Parameter& parameter : campaign.parameters) {
    const Range& range = drawn.ranges.at(parameter.name);
    std::string text;
    for (const auto& [word, count] : range.words)
      text += (text.empty() ? "" : ", ") + word + " in " + std::to_string(count);
    if (text.empty())
      text = parameter.distribution.is_constant()
                 ? core::number_text(range.low)
                 : fmt::format("{:.6g} to {:.6g}", range.low, range.high);
    fmt::print("  {:32} {}\n", parameter.name, text);
  }
}

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

// A few runs spread over all, the first of a scene twice: opening it is no part of what the rest takes.
void print_pilot(const CampaignOptions& options, const Campaign& campaign) {
  const core::ThreadLimit threads(options.threads);
  const Scratch scratch;
  datasets::Worker worker(campaign,
                          {scratch.path(), shipped_folder(), data_folders(options.data), true});
  double seconds = 0.0, bytes = 0.0;
  int made = 0;
  for (int i = 0; i < std::min(kPilotRuns, campaign.runs); ++i) {
    core::throw_if_stopped();
    const int run =
        static_cast<int>((2LL * i + 1) * campaign.runs / (2 * kPilotRuns)) % campaign.runs;
    if (worker.make(run) != datasets::RunEnd::made || worker.make(run) != datasets::RunEnd::made) {
      fmt::print("  run {} fails: fanbeam campaign run tells why\n", run);
      continue;
    }
    seconds += worker.cost().seconds;
    bytes += static_cast<double>(worker.cost().bytes);
    ++made;
  }
  if (made == 0) return;
  const int cores = threads.threads();
  const double all_s = seconds / made * campaign.runs;
  fmt::print(
      "pilot of {} runs on {} cores: {:.2f} s and {} a run; all of it {} and {:.3g} core hours "
      "({} here)\n",
      made, cores, seconds / made, bytes_text(bytes / made),
      bytes_text(bytes / made * campaign.runs), all_s * cores / 3600.0,
      all_s < 120.0 ? fmt::format("{:.0f} s", all_s) : fmt::format("{:.0f} min", all_s / 60.0));
}

}  // namespace

int plan_campaign(const CampaignOptions& options, const Campaign& campaign) {
  constexpr const char* kPlans[] = {"grid", "sobol", "random"};
  fmt::print("{}: {} runs ({}) of {} frames, {} frames in all, isa {}\n", campaign.name,
             campaign.runs, kPlans[static_cast<std::size_t>(campaign.plan)], campaign.frames.count,
             static_cast<long long>(campaign.runs) * campaign.frames.count,
             core::short_name_of(campaign.isa));
  const Drawn drawn = draw_all(campaign);
  print_ranges(campaign, drawn);
  for (const auto& [what, refusal] : drawn.refused)
    fmt::print("would be refused: {} {}, such as run {}: {}\n", refusal.count,
               refusal.count == 1 ? "run" : "runs", refusal.run, refusal.why);
  if (options.pilot) {
    const StopOnSignals stop_on_signals;
    try {
      print_pilot(options, campaign);
    } catch (const core::Stopped&) {
      return end_by_stop_signal();
    }
  }
  return drawn.refused.empty() ? kExitDone : kExitInvalidInput;
}

}  // namespace fanbeam::apps
