#include "apps/campaign_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/campaign_pilot.h"
#include "apps/stop_on_signals.h"
#include "core/stop.h"
#include "datasets/draw.h"
#include "datasets/run_conditions.h"

namespace fanbeam::apps {
namespace {

using datasets::Campaign;

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
  RunsByScene scenes;
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
    drawn.scenes[draw.word("scene").value_or(campaign.scenes.front())].add(run);
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
  bool all_fly = drawn.refused.empty();
  if (options.pilot) {
    const StopOnSignals stop_on_signals;
    try {
      all_fly = print_pilot(options, campaign, drawn.scenes) && all_fly;
    } catch (const core::Stopped&) {
      return end_by_stop_signal();
    }
  }
  return all_fly ? kExitDone : kExitInvalidInput;
}

}  // namespace fanbeam::apps
