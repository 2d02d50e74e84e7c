#include "apps/campaign_plan.h"

#include <fmt/format.h>

#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "datasets/pilot.h"

namespace fanbeam::apps {
namespace {

using datasets::Campaign;

void print_ranges(const Campaign& campaign, const datasets::Drawn& drawn) {
  for (const datasets::Parameter& parameter : campaign.parameters) {
    const datasets::Drawn::Range& range = drawn.ranges.at(parameter.name);
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

// Scenes that were not flown count as those that were.
void print_pilot(const datasets::PilotFigures& pilot, const datasets::Drawn& drawn, int cores) {
  for (const auto& refusal : pilot.refused)
    fmt::print("would be refused: run {} of {}: {}\n", refusal.run, refusal.scene, refusal.why);
  if (pilot.runs == 0) return;
  const double all_s =
      pilot.run_s * drawn.runs + pilot.open_s * static_cast<double>(drawn.scenes.size());
  fmt::print(
      "pilot of {} runs of {} {} on {} cores: {:.2f} s and {} a run, {:.2f} s to open a scene; all "
      "of it {} and {:.3g} core hours ({} here)\n",
      pilot.runs, pilot.scenes, pilot.scenes == 1 ? "scene" : "scenes", cores, pilot.run_s,
      bytes_text(pilot.run_bytes), pilot.open_s, bytes_text(pilot.run_bytes * drawn.runs),
      all_s * cores / 3600.0,
      all_s < 120.0 ? fmt::format("{:.0f} s", all_s) : fmt::format("{:.0f} min", all_s / 60.0));
}

}  // namespace

int plan_campaign(const CampaignOptions& options, const CommonOptions& common,
                  const Campaign& campaign) {
  constexpr const char* kPlans[] = {"grid", "sobol", "random"};
  fmt::print("{}: {} runs ({}) of at most {} frames, {} in all, isa {}\n", campaign.name,
             campaign.runs, kPlans[static_cast<std::size_t>(campaign.plan)], campaign.frames.count,
             static_cast<long long>(campaign.runs) * campaign.frames.count,
             core::short_name_of(campaign.isa));
  const datasets::Drawn drawn = datasets::drawn_of(campaign);
  print_ranges(campaign, drawn);
  for (const auto& [what, refusal] : drawn.refused)
    fmt::print("would be refused: {} {}, such as run {}: {}\n", refusal.count,
               refusal.count == 1 ? "run" : "runs", refusal.run, refusal.why);
  bool all_fly = drawn.refused.empty();
  if (options.pilot) {
    const StopOnSignals stop_on_signals;
    const core::ThreadLimit threads(options.threads);
    const datasets::PilotFigures pilot =
        datasets::fly_pilot(campaign, drawn, {{}, shipped_folder(), data_folders(options.data)});
    if (!common.quiet) print_problems(pilot.warnings);
    print_pilot(pilot, drawn, core::ThreadLimit::threads());
    all_fly = pilot.refused.empty() && all_fly;
  }
  return all_fly ? kExitDone : kExitInvalidInput;
}

}  // namespace fanbeam::apps
