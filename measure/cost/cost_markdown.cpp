#include "measure/cost/cost_markdown.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "measure/cost/cost_csv.h"
#include "measure/cost/levels_report.h"
#include "measure/ladder.h"

namespace fanbeam::measure {
namespace {

using core::number_text;

std::string head_section(const CostFigures& figures) {
  std::string frames;
  for (const int frame : figures.frames)
    frames += (frames.empty() ? "" : ", ") + std::to_string(frame);
  std::string text =
      fmt::format("# What accuracy costs: {}\n\n{}.\n\n", figures.scene, figures.title);
  if (figures.quick)
    text +=
        "**A quick look: few steps, few repetitions and a coarse reference. Its figures are no "
        "measurement.**\n\n";
  return text +
         fmt::format(
             "{}, {} threads, {}. {:.2f} million triangles; {} {}; medians of {} repetitions after "
             "a warm-up.\n\n",
             figures.machine.processor, figures.machine.threads, figures.machine.level,
             static_cast<double>(figures.triangles) / 1e6,
             figures.frames.size() == 1 ? "frame" : "frames", frames, figures.repetitions);
}

// The coarsest and the finest step of a way; null where it has none.
std::pair<const LadderStep*, const LadderStep*> ends_of(const std::vector<LadderStep>& steps,
                                                        Way way) {
  const LadderStep* first = nullptr;
  const LadderStep* last = nullptr;
  for (const LadderStep& step : steps) {
    if (step.way != way) continue;
    if (first == nullptr) first = &step;
    last = &step;
  }
  return {first, last};
}

// "0.53", "below 0.10" where the ladder ends sooner, nothing where not even its first step fits.
std::optional<std::string> error_text(const std::vector<LadderStep>& steps, Way way, double ms,
                                      PickError error) {
  const auto [first, last] = ends_of(steps, way);
  if (first == nullptr || first->time.ms > ms) return std::nullopt;
  if (const auto at = error_at_ms(steps, way, ms, error)) return fmt::format("{:.2f}", *at);
  return fmt::format("below {:.2f}", error(last->error));
}

std::string rate_sentence(const std::vector<LadderStep>& steps, double ms, const char* rate) {
  std::string text = fmt::format(
      "In {:.3g} ms, the time of a frame at {}, pictures come this close to the "
      "converged one:",
      ms, rate);
  std::string parts, without;
  for (const Way way : kWays) {
    if (std::none_of(steps.begin(), steps.end(), [&](const auto& s) { return s.way == way; }))
      continue;
    const auto noisy = error_text(steps, way, ms, bscope_with_noise);
    const auto clean = error_text(steps, way, ms, bscope_noise_free);
    if (noisy && clean)
      parts += fmt::format("{} {}: {} grey levels ({} without noise)", parts.empty() ? "" : ";",
                           words_of(way), *noisy, *clean);
    else
      without += (without.empty() ? "" : "; ") + std::string(words_of(way));
  }
  if (parts.empty()) return text + " none does.\n";
  text += parts + ".";
  if (!without.empty()) text += " Not fast enough at all: " + without + ".";
  return text + '\n';
}

std::string ladder_table(const std::vector<LadderStep>& steps) {
  std::string text =
      "| way | fineness | ms | million rays | B-scope | lit cells | lit 99 % | C-scope |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  const auto pair = [](const renderer::PictureError& error, double renderer::GreyError::*figure) {
    return fmt::format("{:.2f} / {:.2f}", error.with_noise.*figure, error.noise_free.*figure);
  };
  using renderer::GreyError;
  for (const Way way : kWays)
    for (const LadderStep& step : steps)
      if (step.way == way)
        text += fmt::format(
            "| {} | {} | {:.1f} | {} | {} | {} | {} | {} |\n", words_of(way),
            number_text(step.fineness), step.time.ms,
            step.rays > 0 ? fmt::format("{:.2f}", static_cast<double>(step.rays) / 1e6) : "-",
            pair(step.error.bscope, &GreyError::rms), pair(step.error.bscope, &GreyError::lit_rms),
            pair(step.error.bscope, &GreyError::lit_p99), pair(step.error.cscope, &GreyError::rms));
  return text + '\n';
}

// "12.3 ms", or on which side of the ladder the error lies.
std::string equal_error_text(const std::vector<LadderStep>& steps, Way way, double rms_grey,
                             PickError error) {
  if (const auto ms = ms_at_error(steps, way, rms_grey, error))
    return fmt::format("{:.1f} ms", *ms);
  const auto [first, last] = ends_of(steps, way);
  if (first == nullptr) return "-";
  return error(first->error) < rms_grey ? fmt::format("under {:.1f} ms", first->time.ms)
                                        : fmt::format("over {:.1f} ms", last->time.ms);
}

std::string equal_error_table(const std::vector<LadderStep>& steps) {
  std::string text = "| B-scope error |", rule = "| --- |";
  for (const Way way : kWays) {
    text += fmt::format(" {} |", words_of(way));
    rule += " ---: |";
  }
  text += '\n' + rule + '\n';
  for (const EqualError& equal : kEqualErrors) {
    text += fmt::format("| {} {} |", number_text(equal.rms_grey),
                        equal.with_noise ? "with noise" : "noise-free");
    const PickError error = equal.with_noise ? bscope_with_noise : bscope_noise_free;
    for (const Way way : kWays)
      text += ' ' + equal_error_text(steps, way, equal.rms_grey, error) + " |";
    text += '\n';
  }
  return text + '\n';
}

// "At an error of 2.6 ... rays need 4 times the time of slices".
std::string ratio_sentence(const std::vector<LadderStep>& steps) {
  for (const EqualError& equal : kEqualErrors) {
    if (equal.with_noise) continue;
    const auto at = [&](Way way) {
      return ms_at_error(steps, way, equal.rms_grey, bscope_noise_free);
    };
    const auto slices = at(Way::slices), rays = at(Way::rays), naive = at(Way::naive_dithered);
    if (!slices || !rays) continue;
    std::string text = fmt::format(
        "At an equal error of {} grey levels without noise, rays need {:.1f} times the time of "
        "slices",
        number_text(equal.rms_grey), *rays / *slices);
    if (naive) text += fmt::format(", uniform angles {:.0f} times", *naive / *slices);
    return text + ".\n";
  }
  return "";
}

std::string reference_table(const CostFigures& figures) {
  std::string text =
      "How well the converged picture itself is known: a second one with other random places "
      "against\nthe first.\n\n"
      "| frame | seconds | million rays | B-scope | C-scope |\n"
      "| ---: | ---: | ---: | ---: | ---: |\n";
  for (const ReferenceFigures& r : figures.references)
    text += fmt::format("| {} | {:.1f} | {:.0f} | {:.2f} / {:.2f} | {:.2f} / {:.2f} |\n", r.frame,
                        r.time_s, static_cast<double>(r.rays) / 1e6,
                        r.own_error.bscope.with_noise.rms, r.own_error.bscope.noise_free.rms,
                        r.own_error.cscope.with_noise.rms, r.own_error.cscope.noise_free.rms);
  return text + '\n';
}

std::string ladder_section(const CostFigures& figures) {
  if (figures.ladder.empty()) return "";
  const std::vector<LadderStep> steps = over_frames(figures.ladder);
  std::string text = "## Error against time\n\n![Error of the B-scope over time](ladder.svg)\n\n";
  text += "Lower is better, and further left is faster. " +
          rate_sentence(steps, kTime16Hz_ms, "16 Hz") +
          rate_sentence(steps, kTime90Hz_ms, "90 Hz") + ratio_sentence(steps);
  if (!figures.why_no_slices.empty())
    text += "No slices in this scene: " + figures.why_no_slices + ".\n";
  text += "\n![Error of the C-scope over time](ladder-cscope.svg)\n\n";
  text +=
      "Errors are grey levels RMS over all cells, with noise / noise-free; where there are "
      "several frames, RMS\nand mean time over them (each by itself in ladder.csv).\n\n";
  return text + ladder_table(steps) + "### Rays and slices at equal error\n\n" +
         equal_error_table(steps) + reference_table(figures);
}

std::string method_section() {
  return "## Method\n\n"
         "* Time: from the pose to both display images in memory. Things that are compared run in "
         "turns of a\n  warm-up and some repetitions each; every figure is the median, its "
         "uncertainty the standard error of\n  the median.\n"
         "* Error: on unrounded grey clamped to 0..255, expected power of the whole picture with "
         "every effect of\n  the plan, against rays at 256 jittered azimuths per column and 8 per "
         "range cell; with the receiver's\n  mean noise in both pictures, and without it. Lit "
         "cells are those that the noise-free reference\n  shows above black.\n"
         "* Uniform angles: equal steps of elevation over the span that fanbeam's own rays cover, "
         "one ray at a\n  time, each hit into the one cell it falls in; four sub-columns and every "
         "ray at its own azimuth\n  (dithered), or one azimuth per column. Radar equation, "
         "bounces, beam and display are the same.\n"
         "* Effects: the scene's plan with one effect left out or forced on, same sampling, same "
         "random numbers,\n  displayed grey of the whole picture; dB are of the display's scale. "
         "With rays, the change of side\n  lobes includes that of other rays in a wider fan.\n"
         "* Interpolation between steps is linear in both logarithms.\n";
}

}  // namespace

std::string cost_markdown(const CostFigures& figures) {
  return head_section(figures) + ladder_section(figures) + effects_section(figures) +
         numerics_section(figures) + levels_section(figures) + method_section();
}

}  // namespace fanbeam::measure
