// Families of traffic drawn at random, from frequencies by two stages or from samples.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "session/signal/tracks/study.h"
#include "tracking/filters/chi_square.h"
#include "tracking/simulation/road_families.h"
#include "tracking/simulation/sampled_frame.h"

namespace fanbeam::session {
namespace {

// One figure of every run, from the smallest up, over the share of runs.
PlotSeries sorted_series(const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  PlotSeries series{name, {}, values, PlotSeries::Style::line};
  for (std::size_t i = 0; i < values.size(); ++i)
    series.x.push_back(100.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(values.size()));
  return series;
}

}  // namespace

StudyPart study_families(const core::HighwayRadar& radar, const TrackSettings& settings,
                         const std::function<void(const char* family)>& told) {
  if (!fits(tracking::Scheme::two_stage, radar))
    return {"Families of traffic: none, two stages take longer than a frame of this radar.\n", {}};
  const tracking::SimulationSettings simulation =
      simulation_settings(settings, tracking::Scheme::two_stage);
  // Place and velocity; on one axis for a radar without azimuth.
  const int states = radar.array_elements > 1 ? 4 : 2;
  const tracking::Interval band = tracking::mean_interval(states, settings.family_draws);
  std::optional<tracking::SampledRadar> sampled;
  if (settings.samples) sampled.emplace(radar);
  const std::string what = sampled ? "Families of traffic, from samples" : "Families of traffic";
  StudyPart part;
  part.text = fmt::format(
      "| family, {} draws{} | MOTA | worst | runs without a switch | NEES ({:.2f} to {:.2f}) |\n"
      "|---|---|---|---|---|\n",
      settings.family_draws, sampled ? " from samples" : "", band.low, band.high);
  Plot mota, nees;
  mota.title = what + ": MOTA of each draw";
  nees.title = fmt::format("{}: NEES of each draw, {} where told errors are true", what, states);
  mota.x = nees.x = {"draws (%)", false, 0.0, 100.0};
  mota.y = {"MOTA", false, {}, 1.0};
  nees.y = {fmt::format("NEES of {} states", states), true, 1.0, 20.0};
  for (const tracking::RoadFamily& family : tracking::road_families()) {
    const tracking::FamilyScore score = tracking::score_family(
        family, settings.family_draws, radar,
        [&](const core::HighwayScenario& scenario) {
          return tracker_settings(settings, simulation, radar, scenario.radar_speed_mps);
        },
        [&](const core::HighwayScenario& scenario, std::uint32_t run, int frame) {
          return sampled ? sampled->measure(scenario, settings.seed, run, frame)
                         : simulated_frame(scenario, radar, simulation, settings.seed, run, frame);
        });
    part.text += fmt::format("| {} | {:.3f} | {:.3f} | {} | {} |\n", family.name, score.mota(),
                             score.worst_mota(), score.without_switch(),
                             figure_cell(score.nees.count(), score.nees.mean(), 2));
    std::vector<double> motas, errors;
    for (const tracking::FamilyRun& run : score.runs) {
      motas.push_back(run.mota);
      if (run.nees) errors.push_back(*run.nees);
    }
    mota.series.push_back(sorted_series(family.name, motas));
    nees.series.push_back(sorted_series(family.name, errors));
    told(family.name);
  }
  nees.series.push_back({"",
                         {0.0, 100.0},
                         {static_cast<double>(states), static_cast<double>(states)},
                         PlotSeries::Style::dashed_line,
                         6});
  part.plots = {{"families-mota", mota}, {"families-nees", nees}};
  return part;
}

}  // namespace fanbeam::session
