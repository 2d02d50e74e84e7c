#include "measure/cost/cost_csv.h"

#include <initializer_list>

#include "core/errors.h"
#include "measure/ladder.h"

namespace fanbeam::measure {
namespace {

using core::number_text;

// Quoted where a comma or a quote stands in it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string row(std::initializer_list<std::string> fields) {
  std::string line;
  for (const std::string& text : fields) line += (line.empty() ? "" : ",") + text;
  return line + '\n';
}

std::string count(std::uint64_t value) { return std::to_string(value); }

constexpr const char* kErrorColumns =
    "bscope_with_noise_rms_grey,bscope_with_noise_lit_rms_grey,bscope_with_noise_lit_p99_grey,"
    "bscope_noise_free_rms_grey,bscope_noise_free_lit_rms_grey,bscope_noise_free_lit_p99_grey,"
    "cscope_with_noise_rms_grey,cscope_with_noise_lit_rms_grey,cscope_with_noise_lit_p99_grey,"
    "cscope_noise_free_rms_grey,cscope_noise_free_lit_rms_grey,cscope_noise_free_lit_p99_grey";

std::string error_fields(const renderer::FrameError& error) {
  std::string text;
  for (const renderer::PictureError* picture : {&error.bscope, &error.cscope})
    for (const renderer::GreyError* grey : {&picture->with_noise, &picture->noise_free})
      for (const double figure : {grey->rms, grey->lit_rms, grey->lit_p99}) {
        if (!text.empty()) text += ',';
        text += number_text(figure);
      }
  return text;
}

constexpr const char* kTimeColumns = "frame_ms,frame_standard_error_ms,repetitions";

std::string time_fields(const core::MedianTime& time) {
  return number_text(time.ms) + ',' + number_text(time.error_ms) + ',' +
         std::to_string(time.repetitions);
}

}  // namespace

std::string ladder_csv(const CostFigures& figures) {
  std::string text = std::string("frame,way,fineness,fineness_unit,") + kTimeColumns +
                     ",rays,slices," + kErrorColumns + '\n';
  for (const LadderStep& step : figures.ladder)
    text +=
        row({std::to_string(step.frame), std::string(name_of(step.way)), number_text(step.fineness),
             std::string(fineness_of(step.way)), time_fields(step.time), count(step.rays),
             count(step.slices), error_fields(step.error)});
  // A second reference against the first: how well the errors above are known.
  for (const ReferenceFigures& reference : figures.references)
    text += row({std::to_string(reference.frame), "reference", number_text(reference.rays_per_cell),
                 "rays_per_cell_and_column", number_text(1000.0 * reference.time_s), "", "1",
                 count(reference.rays), "0", error_fields(reference.own_error)});
  return text;
}

std::string effects_csv(const CostFigures& figures) {
  std::string text =
      "frame,effect,planned,possible,bound_grey,bound_dB,with_ms,without_ms,cost_ms,"
      "cost_standard_error_ms,repetitions,bscope_largest_grey,bscope_rms_grey,bscope_largest_dB,"
      "bscope_rms_dB,cscope_largest_grey,cscope_rms_grey,cscope_largest_dB,cscope_rms_dB,reason\n";
  for (const EffectPrice& price : figures.effects) {
    const auto change = [&](const Change& of) {
      return number_text(of.largest_grey) + ',' + number_text(of.rms_grey) + ',' +
             number_text(of.largest_grey * figures.dB_per_grey) + ',' +
             number_text(of.rms_grey * figures.dB_per_grey);
    };
    const std::string measured =
        price.possible ? row({number_text(price.with.ms), number_text(price.without.ms),
                              number_text(price.cost_ms()), number_text(price.cost_error_ms()),
                              std::to_string(price.with.repetitions), change(price.bscope),
                              change(price.cscope)})
                       : std::string(12, ',') + '\n';
    text +=
        row({std::to_string(price.frame), price.effect, price.planned ? "1" : "0",
             price.possible ? "1" : "0", number_text(price.bound_grey), number_text(price.bound_dB),
             measured.substr(0, measured.size() - 1), field(price.reason)});
  }
  return text;
}

std::string numerics_csv(const CostFigures& figures) {
  std::string text = std::string("frame,comparison,variant,") + kTimeColumns + ',' + kErrorColumns +
                     ",rays,other_hits,range_median_m,range_rms_m,range_largest_m\n";
  for (const Variant& variant : figures.numerics.variants)
    text += row({std::to_string(variant.frame), variant.comparison, variant.name,
                 time_fields(variant.time), error_fields(variant.error), "", "", "", "", ""});
  const std::string no_errors(11, ',');
  for (const RangeFigures& range : figures.numerics.ranges) {
    text +=
        row({std::to_string(range.frame), "range_of_rays_alone", "float", time_fields(range.cast),
             no_errors, count(range.hits), count(range.other_cell), number_text(range.median_m),
             number_text(range.rms_m), number_text(range.largest_m)});
    text +=
        row({std::to_string(range.frame), "range_of_rays_alone", "double",
             time_fields(range.cast_and_double), no_errors, count(range.hits), "0", "0", "0", "0"});
  }
  for (const RobustFigures& robust : figures.numerics.robust)
    text += row({std::to_string(robust.frame), "robust_flag_hits", "off", "", "", "", no_errors,
                 count(robust.rays), count(robust.lost + robust.moved), "", "", ""});
  return text;
}

std::string equal_error_csv(const CostFigures& figures) {
  std::string text = "frame,noise,bscope_rms_grey";
  for (const Way way : kWays) text += ',' + std::string(name_of(way)) + "_ms";
  text += '\n';
  for (const int frame : figures.frames) {
    std::vector<LadderStep> steps;
    for (const LadderStep& step : figures.ladder)
      if (step.frame == frame) steps.push_back(step);
    for (const EqualError& equal : kEqualErrors) {
      text += std::to_string(frame) + (equal.with_noise ? ",with," : ",without,") +
              number_text(equal.rms_grey);
      for (const Way way : kWays) {
        const auto ms = ms_at_error(steps, way, equal.rms_grey,
                                    equal.with_noise ? bscope_with_noise : bscope_noise_free);
        text += ',' + (ms ? number_text(*ms) : std::string());
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace fanbeam::measure
