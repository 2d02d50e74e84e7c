#include "measure/cost/levels_report.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/errors.h"

namespace fanbeam::measure {
namespace {

using core::number_text;

constexpr const char* kPicture = "picture";

const char* words_of_level(const std::string& level) {
  return level == kPicture ? "picture level: powers, rays" : "signal level: beat signals";
}

// "4 rays per cell", "1 look".
std::string fineness_text(const LevelStep& step) {
  const std::string number = number_text(step.fineness);
  if (step.level == kPicture) return number + " rays per cell";
  return number + (step.fineness == 1.0 ? " look" : " looks");
}

// What the first and the last step of the signal level reach, and how long the first picture of
// powers takes that is no worse.
std::string comparison(const std::vector<LevelStep>& steps) {
  const LevelStep& finest = steps.back();
  const LevelStep *one = nullptr, *enough = nullptr;
  for (const LevelStep& step : steps) {
    if (step.level != kPicture && one == nullptr) one = &step;
    if (step.level == kPicture && enough == nullptr && step.rms_grey <= finest.rms_grey)
      enough = &step;
  }
  std::string text;
  if (one != nullptr)
    text += fmt::format(
        "One look at signal level is a picture with its speckle: {:.1f} grey levels in {:.0f} ms. ",
        one->rms_grey, one->time.ms);
  text += fmt::format("The mean of {} looks comes to {:.1f} grey levels in {:.1f} s",
                      number_text(finest.fineness), finest.rms_grey, finest.time.ms / 1000.0);
  if (enough != nullptr)
    text += fmt::format("; powers take {:.1f} ms for {:.1f}, {:.0f} times less", enough->time.ms,
                        enough->rms_grey, finest.time.ms / enough->time.ms);
  return text + ".\n\n";
}

}  // namespace

std::string levels_csv(const CostFigures& figures) {
  std::string text =
      "frame,level,fineness,fineness_unit,frame_ms,frame_standard_error_ms,repetitions,"
      "bscope_with_noise_rms_grey\n";
  for (const LevelStep& step : figures.levels)
    text += fmt::format(
        "{},{},{},{},{},{},{},{}\n", step.frame, step.level, number_text(step.fineness),
        step.level == kPicture ? "rays_per_cell_and_column" : "looks", number_text(step.time.ms),
        number_text(step.time.error_ms), step.time.repetitions, number_text(step.rms_grey));
  return text;
}

session::Plot levels_plot(const CostFigures& figures) {
  session::Plot plot;
  plot.title = figures.scene + ", B-scope behind its sweep: error over time";
  plot.x = {"milliseconds per frame", true, {}, {}};
  plot.y = {"error with noise, grey levels RMS", true, {}, {}};
  for (const LevelStep& step : figures.levels) {
    if (plot.series.empty() || plot.series.back().title != words_of_level(step.level)) {
      plot.series.emplace_back();
      plot.series.back().title = words_of_level(step.level);
      plot.series.back().style = session::PlotSeries::Style::line_points;
    }
    plot.series.back().x.push_back(step.time.ms);
    plot.series.back().y.push_back(step.rms_grey);
    if (step.level != kPicture)
      plot.labels.push_back({step.time.ms, step.rms_grey, fineness_text(step)});
  }
  // The names of both rates stay inside the plot.
  double low_ms = kTime90Hz_ms;
  for (const LevelStep& step : figures.levels) low_ms = std::min(low_ms, step.time.ms);
  plot.x.low = 0.8 * low_ms;
  plot.marks = {{kTime90Hz_ms, "90 Hz"}, {kTime16Hz_ms, "16 Hz"}};
  // The last name stands right of its point.
  if (!figures.levels.empty()) plot.x.high = 3.0 * figures.levels.back().time.ms;
  plot.key_below = true;
  return plot;
}

std::string levels_section(const CostFigures& figures) {
  if (!figures.why_no_levels.empty())
    return "## Picture level and signal level\n\nNo signal level with this sensor: " +
           figures.why_no_levels + ".\n\n";
  if (figures.levels.empty()) return "";
  std::string text =
      "## Picture level and signal level\n\n"
      "![Error of the B-scope over time at both levels](levels.svg)\n\n" +
      comparison(figures.levels) + fmt::format("Frame {}", figures.levels.front().frame) +
      ": the picture level with every effect of the plan, the signal level of surfaces and point "
      "targets\nalone (it has no double bounce and no echo of rain; multipath is off), each "
      "against "
      "the converged powers\nof the same, with the sweep's exact range response and mean noise. "
      "Speckle of n looks leaves 5.6 dB at\none and 4.34/sqrt(n) dB at many; the picture level "
      "ends at what its range response, worked out from\nwhole cells, leaves at edges. Times of n "
      "looks are n times that of one.\n\n"
      "| level | fineness | ms | B-scope, grey |\n| --- | ---: | ---: | ---: |\n";
  for (const LevelStep& step : figures.levels)
    text += fmt::format("| {} | {} | {:.1f} | {:.2f} |\n", words_of_level(step.level),
                        fineness_text(step), step.time.ms, step.rms_grey);
  return text + '\n';
}

}  // namespace fanbeam::measure
