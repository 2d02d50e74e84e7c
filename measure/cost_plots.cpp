#include "measure/cost_plots.h"

#include <algorithm>

#include "measure/effect_prices.h"
#include "measure/ladder_plot.h"

namespace fanbeam::measure {
namespace {

constexpr double kSmallest_dB = 1e-3;

}  // namespace

session::Plot cost_ladder_plot(const CostFigures& figures, bool cscope) {
  const std::vector<LadderStep> ladder = over_frames(figures.ladder);
  std::vector<LadderCurve> curves;
  for (std::size_t i = 0; i < kWays.size(); ++i) {
    const std::vector<LadderStep> steps = steps_of(ladder, kWays[i]);
    curves.push_back({std::string(words_of(kWays[i])), i, false, steps,
                      cscope ? cscope_with_noise : bscope_with_noise});
    curves.push_back({"", i, true, steps, cscope ? cscope_noise_free : bscope_noise_free});
  }
  return ladder_plot(figures.scene + (cscope ? ", C-scope" : ", B-scope") +
                         ": error over time (dashed: without the receiver's noise)",
                     curves);
}

session::Plot effects_plot(const CostFigures& figures) {
  session::Plot plot;
  plot.title = figures.scene + ": what effects cost and change";
  plot.x = {"cost, milliseconds per frame", false, {}, {}};
  plot.y = {"change of the B-scope, dB: largest (point), RMS (foot)", true, {}, {}};
  double low_dB = 1.0, high_ms = 0.0, low_ms = 0.0;
  session::PlotSeries planned{
      "in the plan: change if left out", {}, {}, session::PlotSeries::Style::points, 0};
  session::PlotSeries forced{
      "left out by the plan: change if forced on", {}, {}, session::PlotSeries::Style::points, 1};
  std::vector<session::PlotSeries> stems;
  for (const EffectPrice& price : over_frames(figures.effects)) {
    if (!price.possible) continue;
    const double largest_dB =
        std::max(kSmallest_dB, price.bscope.largest_grey * figures.dB_per_grey);
    const double rms_dB = std::max(kSmallest_dB, price.bscope.rms_grey * figures.dB_per_grey);
    session::PlotSeries& series = price.planned ? planned : forced;
    series.x.push_back(price.cost_ms());
    series.y.push_back(largest_dB);
    stems.push_back({"",
                     {price.cost_ms(), price.cost_ms()},
                     {largest_dB, rms_dB},
                     session::PlotSeries::Style::line,
                     series.colour});
    plot.labels.push_back({price.cost_ms(), largest_dB, price.effect});
    low_dB = std::min(low_dB, rms_dB);
    low_ms = std::min(low_ms, price.cost_ms());
    high_ms = std::max(high_ms, price.cost_ms());
  }
  for (session::PlotSeries* series : {&planned, &forced})
    if (!series->x.empty()) plot.series.push_back(std::move(*series));
  for (session::PlotSeries& stem : stems) plot.series.push_back(std::move(stem));
  plot.y.low = low_dB / 2.0;
  // Names stand right of their points.
  plot.x.low = low_ms - 0.05 * (high_ms - low_ms);
  plot.x.high = high_ms + 0.2 * std::max(high_ms - low_ms, 0.1);
  plot.key_below = true;
  return plot;
}

}  // namespace fanbeam::measure
