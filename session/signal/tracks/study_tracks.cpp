// Waveforms and associations: ghosts of single frames, tracks of scenarios, swaps after crossings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/random.h"
#include "session/signal/tracks/study.h"
#include "tracking/association/crossing.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::session {
namespace {

using tracking::Scheme;

struct Named {
  Scheme scheme;
  const char* name;
};
constexpr Named kSchemes[] = {{Scheme::sorted_triangle, "triangle, pairs in order"},
                              {Scheme::triangle, "triangle, all pairs"},
                              {Scheme::two_slopes, "two slopes"},
                              {Scheme::coded, "coded stretch"},
                              {Scheme::two_stage, "two stages"}};
constexpr double kLeastMissed = 0.01, kLeastGhosts = 0.001;  // of the plots
constexpr int kGhostFrames = 200, kTrackRuns = 10, kCrossings = 20000;

struct Rates {
  double missed = 0.0, ghosts_per_frame = 0.0;
};

// Straight ahead, so that no beam tells targets apart.
core::HighwayScenario random_targets(int count, std::uint64_t seed, int frame) {
  core::HighwayScenario scenario;
  for (int i = 0; i < count; ++i) {
    const core::RandomKey key{seed, core::kStreamHighway, static_cast<std::uint32_t>(frame)};
    const auto words = core::random_words(key, static_cast<std::uint64_t>(i), 20);
    core::HighwayTarget target;
    target.cross_section_m2 = 10.0;
    target.position_m = {10.0 + 190.0 * core::uniform_from(words[0]), 0.0};
    target.velocity_mps = {120.0 * core::uniform_from(words[1]) - 60.0, 0.0};
    scenario.targets.push_back(target);
  }
  return scenario;
}

Rates rates_of(const core::HighwayRadar& radar, Scheme scheme, int count, std::uint64_t seed) {
  tracking::SimulationSettings settings;
  settings.scheme = scheme;
  Rates rates;
  for (int frame = 0; frame < kGhostFrames; ++frame) {
    const core::HighwayScenario scenario = random_targets(count, seed, frame);
    const auto seen =
        simulated_frame(scenario, radar, settings, seed, static_cast<std::uint32_t>(frame), 0);
    const auto match = [](const tracking::RadarMeasurement& one,
                          const core::HighwayTarget& target) {
      return std::abs(one.range_m - target.position_m[0]) <= 1.0 &&
             std::abs(one.range_rate_mps - target.velocity_mps[0]) <= 1.0;
    };
    for (const auto& target : scenario.targets)
      if (std::none_of(seen.begin(), seen.end(),
                       [&](const auto& one) { return match(one, target); }))
        rates.missed += 1.0 / (kGhostFrames * count);
    for (const auto& one : seen)
      if (std::none_of(scenario.targets.begin(), scenario.targets.end(),
                       [&](const auto& target) { return match(one, target); }))
        rates.ghosts_per_frame += 1.0 / kGhostFrames;
  }
  return rates;
}

struct Tracked {
  double gospa_m = 0.0, false_per_scan = 0.0, ms = 0.0;
  tracking::MeanSquare mota, range_m;  // of the runs that have one
  int switches = 0;
};

using Measure = std::function<std::vector<tracking::RadarMeasurement>(int run, int frame)>;

Tracked tracked(const StudyScenario& one, const tracking::TrackerSettings& settings, int runs,
                bool with_measuring, const Measure& measure) {
  const core::HighwayScenario& scenario = *one.scenario;
  Tracked result;
  for (int run = 0; run < runs; ++run) {
    tracking::ScenarioScore score;
    double seconds = 0.0;
    run_scenario(
        scenario, one.radar, settings, [&](int frame) { return measure(run, frame); },
        [&](const tracking::ScenarioFrame& frame) {
          score.add(scenario, frame);
          seconds += frame.tracking_s + (with_measuring ? frame.measuring_s : 0.0);
        });
    const double frames = score.gospa_m.count();
    result.gospa_m += score.gospa_m.mean() / runs;
    if (score.mot.instances() > 0) result.mota.add(score.mot.mota());
    result.false_per_scan += score.mot.false_tracks() / frames / runs;
    if (score.range_m.count() > 0) result.range_m.add(score.range_m.rms());
    result.ms += 1e3 * seconds / frames / runs;
    result.switches += score.mot.switches();
  }
  return result;
}

std::string row(const std::string& scenario, const std::string& waveform,
                const std::string& association, const Tracked& one) {
  return fmt::format("| {} | {} | {} | {:.3f} | {} | {:.3f} | {} | {} | {:.3f} |\n", scenario,
                     waveform, association, one.gospa_m,
                     figure_cell(one.mota.count(), one.mota.mean(), 4), one.false_per_scan,
                     one.switches, figure_cell(one.range_m.count(), 1e3 * one.range_m.mean(), 2),
                     one.ms);
}

// A waveform from frequencies, with both associations.
std::string rows_of(const StudyScenario& one, const Named& waveform, TrackSettings settings) {
  const core::HighwayScenario& scenario = *one.scenario;
  const tracking::SimulationSettings simulation = simulation_settings(settings, waveform.scheme);
  std::string rows;
  for (const char* association : {"nearest", "joint"}) {
    settings.association = association;
    rows += row(
        scenario.id, waveform.name, association,
        tracked(one, tracker_settings(settings, simulation, one.radar, scenario.radar_speed_mps),
                kTrackRuns, false, [&](int run, int frame) {
                  return simulated_frame(scenario, one.radar, simulation, settings.seed,
                                         static_cast<std::uint32_t>(run), frame);
                }));
  }
  return rows;
}

// Misses and false measurements are what samples make of it.
std::string sampled_row(const StudyScenario& one, TrackSettings settings) {
  const core::HighwayScenario& scenario = *one.scenario;
  settings.association = "nearest";
  settings.detection_probability = 1.0;
  settings.false_per_frame = 0.0;
  const tracking::SampledRadar sampled(one.radar);
  return row(scenario.id, "two stages, from samples", "nearest; time of all",
             tracked(one, tracker_settings(settings, {}, one.radar, scenario.radar_speed_mps), 1,
                     true, [&](int run, int frame) {
                       return sampled.measure(scenario, settings.seed,
                                              static_cast<std::uint32_t>(run), frame);
                     }));
}

}  // namespace

StudyPart study_ghosts(const core::HighwayRadar& radar, std::uint64_t seed) {
  StudyPart part;
  part.text = "| targets |";
  std::string line = "|---|";
  Plot missed, ghosts;
  missed.title = "Missed targets of one frame";
  ghosts.title = "Ghosts of one frame";
  missed.x = ghosts.x = {"targets", false, 0.0, 16.0};
  missed.y = {"missed (%; none: lower edge)", true, kLeastMissed, 100.0};
  ghosts.y = {"ghosts (none: lower edge)", true, kLeastGhosts, 200.0};
  for (const Named& one : kSchemes) {
    part.text += fmt::format(" {}: missed %, ghosts |", one.name);
    line += "---|";
    for (Plot* plot : {&missed, &ghosts})
      plot->series.push_back({one.name, {}, {}, PlotSeries::Style::line_points});
  }
  part.text += "\n" + line + "\n";
  for (const int count : {2, 4, 6, 8, 10, 15}) {
    part.text += fmt::format("| {} |", count);
    for (std::size_t i = 0; i < std::size(kSchemes); ++i) {
      const Rates rates = rates_of(radar, kSchemes[i].scheme, count, seed);
      part.text += fmt::format(" {:.2f}, {:.3g} |", 100.0 * rates.missed, rates.ghosts_per_frame);
      // None at all is drawn at the lower edge of the logarithmic axis.
      const double values[] = {std::max(kLeastMissed, 100.0 * rates.missed),
                               std::max(kLeastGhosts, rates.ghosts_per_frame)};
      for (std::size_t k = 0; k < 2; ++k) {
        PlotSeries& series = (k == 0 ? missed : ghosts).series[i];
        series.x.push_back(count);
        series.y.push_back(values[k]);
      }
    }
    part.text += "\n";
  }
  part.plots = {{"missed", missed}, {"ghosts", ghosts}};
  return part;
}

StudyPart study_tracks(const std::vector<StudyScenario>& scenarios, const TrackSettings& settings) {
  StudyPart part;
  part.text =
      "| scenario | waveform | association | GOSPA, m | MOTA | false tracks in a scan | switches | "
      "range, mm rms | tracker, ms a scan |\n|---|---|---|---|---|---|---|---|---|\n";
  std::string sampled_rows, left_out;
  for (const StudyScenario& one : scenarios) {
    for (const Named& waveform : kSchemes)
      if (fits(waveform.scheme, one.radar))
        part.text += rows_of(one, waveform, settings);
      else
        left_out +=
            fmt::format("{}{}: {}", left_out.empty() ? "" : "; ", one.scenario->id, waveform.name);
    if (fits(Scheme::two_stage, one.radar)) sampled_rows += sampled_row(one, settings);
  }
  part.text += sampled_rows;
  if (!left_out.empty()) part.text += "\nLonger than a frame, left out: " + left_out + ".\n";
  return part;
}

StudyPart study_crossing(std::uint64_t seed) {
  constexpr double kDifference_mps = 3.0 / 3.6;
  StudyPart part;
  part.text =
      "| speeds known to, m/s | 2 p (1 - p) | told, mean | swaps that happen "
      "|\n|---|---|---|---|\n";
  Plot plot;
  plot.title = "Two cars 3 km/h apart meet: are they exchanged afterwards?";
  plot.x = {"standard deviation of each speed (m/s)", false, 0.0, 0.65};
  plot.y = {"probability of a swap", false, 0.0, 0.3};
  plot.series = {{"2 p (1 - p)", {}, {}, PlotSeries::Style::line},
                 {"told, mean", {}, {}, PlotSeries::Style::line_points},
                 {"happens", {}, {}, PlotSeries::Style::points}};
  for (const double sigma : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6}) {
    const double p = 0.5 * std::erfc(kDifference_mps / (2.0 * sigma));
    const double variance = 2.0 * sigma * sigma;
    double told = 0.0;
    int swaps = 0;
    for (int run = 0; run < kCrossings; ++run) {
      const core::RandomKey key{seed, core::kStreamHighway, static_cast<std::uint32_t>(run)};
      const auto before = core::normal_pair(key, 0, 30), after = core::normal_pair(key, 0, 31);
      const double kept =
          tracking::kept_by_difference(kDifference_mps + sigma * (before[0] - before[1]), variance,
                                       kDifference_mps + sigma * (after[0] - after[1]), variance);
      swaps += kept < 0.5;
      told += std::min(kept, 1.0 - kept) / kCrossings;
    }
    const double values[] = {2.0 * p * (1.0 - p), told, static_cast<double>(swaps) / kCrossings};
    part.text += fmt::format("| {:.2f} | {:.4f} | {:.4f} | {:.4f} |\n", sigma, values[0], values[1],
                             values[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      plot.series[i].x.push_back(sigma);
      plot.series[i].y.push_back(values[i]);
    }
  }
  part.plots.emplace_back("crossing", plot);
  return part;
}

}  // namespace fanbeam::session
