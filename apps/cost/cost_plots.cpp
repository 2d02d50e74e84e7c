#include "apps/cost/cost_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/cost/effect_prices.h"
#include "apps/cost/ladder.h"

namespace fanbeam::apps {
namespace {

constexpr double kSmallest_dB = 1e-3;

PlotSeries ladder_series(const std::vector<LadderStep>& steps, Way way, std::size_t colour,
                         PickError error) {
  PlotSeries series;
  series.colour = colour;
  for (const LadderStep& step : steps) {
    if (step.way != way) continue;
    series.x.push_back(step.time.ms);
    // A logarithmic axis has no zero.
    const double grey = error(step.error);
    series.y.push_back(grey > 0.0 ? grey : std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

}  // namespace

Plot ladder_plot(const CostFigures& figures, bool cscope) {
  Plot plot;
  plot.title = figures.scene + (cscope ? ", C-scope" : ", B-scope") +
               ": error over time (dashed: without the receiver's noise)";
  plot.x = {"milliseconds per frame", true, {}, {}};
  plot.y = {"error, grey levels RMS", true, {}, {}};
  const std::vector<LadderStep> steps = over_frames(figures.ladder);
  std::size_t colour = 0;
  for (const Way way : kWays) {
    PlotSeries noisy =
        ladder_series(steps, way, colour, cscope ? cscope_with_noise : bscope_with_noise);
    PlotSeries clean =
        ladder_series(steps, way, colour, cscope ? cscope_noise_free : bscope_noise_free);
    ++colour;
    if (noisy.x.empty()) continue;
    noisy.title = words_of(way);
    noisy.style = PlotSeries::Style::line_points;
    clean.style = PlotSeries::Style::dashed_line;
    plot.series.push_back(std::move(noisy));
    plot.series.push_back(std::move(clean));
  }
  // Both rates stay inside the plot.
  double low_ms = kTime90Hz_ms;
  for (const LadderStep& step : steps) low_ms = std::min(low_ms, step.time.ms);
  plot.x.low = 0.8 * low_ms;
  plot.marks = {{kTime90Hz_ms, "90 Hz"}, {kTime16Hz_ms, "16 Hz"}};
  plot.key_below = true;
  return plot;
}

Plot effects_plot(const CostFigures& figures) {
  Plot plot;
  plot.title = figures.scene + ": what effects cost and change";
  plot.x = {"cost, milliseconds per frame", false, {}, {}};
  plot.y = {"change of the B-scope, dB: largest (point), RMS (foot)", true, {}, {}};
  double low_dB = 1.0, high_ms = 0.0, low_ms = 0.0;
  PlotSeries planned{"in the plan: change if left out", {}, {}, PlotSeries::Style::points, 0};
  PlotSeries forced{
      "left out by the plan: change if forced on", {}, {}, PlotSeries::Style::points, 1};
  std::vector<PlotSeries> stems;
  for (const EffectPrice& price : over_frames(figures.effects)) {
    if (!price.possible) continue;
    const double largest_dB =
        std::max(kSmallest_dB, price.bscope.largest_grey * figures.dB_per_grey);
    const double rms_dB = std::max(kSmallest_dB, price.bscope.rms_grey * figures.dB_per_grey);
    PlotSeries& series = price.planned ? planned : forced;
    series.x.push_back(price.cost_ms());
    series.y.push_back(largest_dB);
    stems.push_back({"",
                     {price.cost_ms(), price.cost_ms()},
                     {largest_dB, rms_dB},
                     PlotSeries::Style::line,
                     series.colour});
    plot.labels.push_back({price.cost_ms(), largest_dB, price.effect});
    low_dB = std::min(low_dB, rms_dB);
    low_ms = std::min(low_ms, price.cost_ms());
    high_ms = std::max(high_ms, price.cost_ms());
  }
  for (PlotSeries* series : {&planned, &forced})
    if (!series->x.empty()) plot.series.push_back(std::move(*series));
  for (PlotSeries& stem : stems) plot.series.push_back(std::move(stem));
  plot.y.low = low_dB / 2.0;
  // Names stand right of their points.
  plot.x.low = low_ms - 0.05 * (high_ms - low_ms);
  plot.x.high = high_ms + 0.2 * std::max(high_ms - low_ms, 0.1);
  plot.key_below = true;
  return plot;
}

}  // namespace fanbeam::apps
