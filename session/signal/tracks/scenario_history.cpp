#include "session/signal/tracks/scenario_history.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {
namespace {

constexpr std::size_t kBlack = 6, kMeasurementColour = 4;  // of the plot's eight colours

// Standard deviation along the line of sight.
double range_sigma_m(const tracking::Track& track) {
  const tracking::Gaussian state = combined(track.state);
  if (track.state.axes == 1) return std::sqrt(std::max(0.0, state.variance(0, 0)));
  const double x = state.mean[0], y = state.mean[1], square = x * x + y * y;
  return std::sqrt(std::max(0.0, (x * x * state.variance(0, 0) + y * y * state.variance(1, 1) +
                                  2.0 * x * y * state.variance(0, 1)) /
                                     square));
}

std::size_t colour_of(int target) {
  constexpr std::size_t kOthers[] = {0, 1, 2, 3, 5, 7};
  return target < 0 ? kBlack : kOthers[static_cast<std::size_t>(target) % std::size(kOthers)];
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string name(const core::HighwayScenario& scenario, int target) {
  return scenario.targets[static_cast<std::size_t>(target)].id;
}

}  // namespace

void ScenarioHistory::add(const core::HighwayScenario& scenario,
                          const tracking::ScenarioFrame& frame,
                          const tracking::ScenarioScore& score) {
  const double t_s = frame.time_s;
  for (std::size_t i = 0; i < frame.truth.size(); ++i)
    truth_[static_cast<int>(i)].add(t_s,
                                    frame.truth[i].in_view ? frame.truth[i].range_m : std::nan(""));
  for (const auto& one : frame.measurements) measurements_.add(t_s, one.range_m);
  for (const tracking::Track& track : frame.tracker->tracks()) {
    if (!track.confirmed) continue;
    const double range_m = polar(track.state).range_m;
    int target = -1;
    for (const auto& [index, id] : score.mot.current_match())
      if (id == track.id) target = index;
    tracks_[{target, track.id}].add(t_s, range_m);
    if (target < 0 || scenario.targets[static_cast<std::size_t>(target)].clutter) continue;
    const double truth_m = frame.truth[static_cast<std::size_t>(target)].range_m;
    errors_[target].add(t_s, 1e3 * (range_m - truth_m));
    sigmas_[target].add(t_s, 2e3 * range_sigma_m(track));
  }
}

Plot ScenarioHistory::ranges(const core::HighwayScenario& scenario) const {
  Plot plot;
  plot.title = scenario.id + ": tracks and truth";
  plot.x.label = "time (s)";
  plot.y.label = "range (m)";
  plot.series.push_back({"measurements", measurements_.x, measurements_.y,
                         PlotSeries::Style::points, kMeasurementColour});
  for (const auto& [target, line] : truth_)
    plot.series.push_back({name(scenario, target) + ", truth", line.x, line.y,
                           PlotSeries::Style::dashed_line, colour_of(target)});
  for (const auto& [key, line] : tracks_) {
    const auto [target, id] = key;
    plot.series.push_back(
        {"track " + std::to_string(id) +
             (target < 0 ? std::string(", no target") : ", " + name(scenario, target)),
         line.x, line.y, PlotSeries::Style::line, colour_of(target)});
  }
  return plot;
}

Plot ScenarioHistory::errors(const core::HighwayScenario& scenario) const {
  Plot plot;
  plot.title = scenario.id + ": errors of range, and twice the standard deviation told";
  plot.x.label = "time (s)";
  plot.y.label = "range of the track less that of its target (mm)";
  std::vector<double> sizes, amounts;  // of bounds, of errors
  for (const auto& [target, line] : errors_) {
    plot.series.push_back({name(scenario, target) + ", error", line.x, line.y,
                           PlotSeries::Style::line, colour_of(target)});
    const Line& sigma = sigmas_.at(target);
    std::vector<double> below = sigma.y;
    for (double& value : below) value = -value;
    for (const auto* side : {&sigma.y, &std::as_const(below)})
      plot.series.push_back({side == &sigma.y ? name(scenario, target) + ", bounds" : std::string(),
                             sigma.x, *side, PlotSeries::Style::dashed_line, colour_of(target)});
    sizes.insert(sizes.end(), sigma.y.begin(), sigma.y.end());
    for (const double value : line.y) amounts.push_back(std::abs(value));
  }
  if (sizes.empty()) return plot;
  // Bounds of the first frames and of coasting would press the rest flat.
  plot.y.high = std::max(3.0 * quantile(sizes, 0.5), 1.5 * quantile(amounts, 0.98));
  plot.y.low = -*plot.y.high;
  return plot;
}

}  // namespace fanbeam::session
