#include "measure/ladder_plot.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "core/errors.h"

namespace fanbeam::measure {
namespace {

using Style = session::PlotSeries::Style;

bool is_default(const LadderStep& step) {
  return step.fineness == (step.way == Way::slices ? renderer::kDefaultSlicesPerColumn
                                                   : renderer::kDefaultRaysPerCell);
}

// A logarithmic axis has no zero.
double shown(double grey) { return grey > 0.0 ? grey : std::numeric_limits<double>::quiet_NaN(); }

session::PlotSeries series_of(const LadderCurve& curve) {
  session::PlotSeries series;
  series.title = curve.title;
  series.colour = curve.colour;
  series.style = curve.dashed ? Style::dashed_line : Style::line_points;
  for (const LadderStep& step : curve.steps) {
    series.x.push_back(step.time.ms);
    series.y.push_back(shown(curve.error(step.error)));
  }
  return series;
}

void label(const LadderCurve& curve, session::Plot& plot) {
  for (const LadderStep& step : curve.steps) {
    const bool end = &step == &curve.steps.front() || &step == &curve.steps.back();
    const double grey = curve.error(step.error);
    if ((!end && !is_default(step)) || !(grey > 0.0)) continue;
    plot.labels.push_back(
        {step.time.ms, grey,
         core::number_text(step.fineness) + (is_default(step) ? " (default)" : "")});
  }
}

}  // namespace

std::vector<LadderStep> steps_of(const std::vector<LadderStep>& ladder, Way way) {
  std::vector<LadderStep> steps;
  std::copy_if(ladder.begin(), ladder.end(), std::back_inserter(steps),
               [&](const LadderStep& step) { return step.way == way; });
  return steps;
}

session::Plot ladder_plot(std::string title, const std::vector<LadderCurve>& curves) {
  session::Plot plot;
  plot.title = std::move(title);
  plot.x = {"milliseconds per frame", true, {}, {}};
  plot.y = {"error, grey levels RMS", true, {}, {}};
  // Both rates stay inside the plot.
  double low_ms = kTime90Hz_ms;
  for (const LadderCurve& curve : curves) {
    if (curve.steps.empty()) continue;
    plot.series.push_back(series_of(curve));
    if (curve.labelled) label(curve, plot);
    for (const LadderStep& step : curve.steps) low_ms = std::min(low_ms, step.time.ms);
  }
  plot.x.low = 0.8 * low_ms;
  plot.marks = {{kTime90Hz_ms, "90 Hz"}, {kTime16Hz_ms, "16 Hz"}};
  plot.key_below = true;
  return plot;
}

}  // namespace fanbeam::measure
