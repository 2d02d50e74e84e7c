#include "signal/waveform/folding.h"

#include <cmath>

#include "core/units.h"
#include "signal/waveform/doppler.h"
#include "signal/waveform/figures.h"

namespace fanbeam::signal {
namespace {

void count(const StageFigures& figures, const ScatterPath& path, StageFolding& stage) {
  if (figures.unambiguous_range_m && path.range_m >= *figures.unambiguous_range_m) {
    ++stage.folded_ranges;
    if (path.range_m > stage.farthest_m) {
      stage.farthest_m = path.range_m;
      stage.farthest_reads_m = fold_positive(path.range_m, *figures.unambiguous_range_m);
    }
  }
  if (!figures.unambiguous_speed_mps) return;
  const double half_mps = *figures.unambiguous_speed_mps;
  const double speed_mps = path.radial_speed_mps;
  if (speed_mps >= half_mps || speed_mps < -half_mps) {
    ++stage.folded_speeds;
    if (std::abs(speed_mps) > std::abs(stage.fastest_mps)) {
      stage.fastest_mps = speed_mps;
      stage.fastest_reads_mps = fold(speed_mps, half_mps);
    }
  }
}

bool has_wrong_sign(const Segment& segment, const ScatterPath& path) {
  const double sign = segment.slope_Hz_per_s < 0.0 ? -1.0 : 1.0;
  return sign * beat_Hz(segment, path.range_m, path.radial_speed_mps) < 0.0;
}

void warn(int number, const std::string& where, double value, const std::string& unit, double reads,
          double span, core::ProblemList& warnings) {
  if (number == 0) return;
  warnings.warning("FOLDED", {}, where, core::number_text(value) + " " + unit,
                   std::to_string(number) + " beyond " + core::number_text(span) + " " + unit +
                       "; the farthest reads " + core::number_text(reads) + " " + unit);
}

void refuse_all(const std::vector<core::Problem>& warnings) {
  core::ProblemList problems;
  for (const core::Problem& one : warnings)
    problems.error(core::ErrorClass::range, {}, one.field, one.value,
                   "inside the unambiguous span: " + one.expected);
  problems.throw_if_errors();
}

}  // namespace

std::vector<StageFolding> count_folding(const Waveform& waveform,
                                        const std::vector<ScatterPath>& paths,
                                        FoldingPolicy policy) {
  const std::vector<StageFigures> of_waveform = figures(waveform);
  std::vector<StageFolding> stages(of_waveform.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    stages[i].unambiguous_range_m = of_waveform[i].unambiguous_range_m.value_or(0.0);
    stages[i].unambiguous_speed_mps = of_waveform[i].unambiguous_speed_mps.value_or(0.0);
    for (const ScatterPath& path : paths) count(of_waveform[i], path, stages[i]);
    if (!waveform.complex_baseband)
      for (const Segment& segment : stage_segments(waveform, static_cast<int>(i)))
        if (segment.slot == 0 && segment.slope_Hz_per_s != 0.0)
          for (const ScatterPath& path : paths)
            stages[i].negative_beats += has_wrong_sign(segment, path) ? 1 : 0;
  }
  if (policy == FoldingPolicy::refuse) refuse_all(folding_warnings(stages));
  return stages;
}

std::vector<core::Problem> folded_azimuths(const Array& array, double wavelength_m,
                                           const std::vector<ScatterPath>& paths,
                                           FoldingPolicy policy) {
  const double most = unambiguous_sine(virtual_elements_m(array), wavelength_m);
  if (most == 1.0) return {};
  int number = 0;
  double widest = 0.0, widest_rad = 0.0;
  for (const ScatterPath& path : paths) {
    const double sine = std::cos(path.elevation_rad) * std::sin(path.azimuth_rad);
    if (sine < most && sine >= -most) continue;
    ++number;
    if (std::abs(sine) <= std::abs(widest)) continue;
    widest = sine;
    widest_rad = path.azimuth_rad;
  }
  core::ProblemList warnings;
  warn(number, "azimuth", core::degrees(widest_rad), "deg",
       core::degrees(std::asin(fold(widest, most))), core::degrees(std::asin(most)), warnings);
  if (policy == FoldingPolicy::refuse) refuse_all(warnings.all());
  return warnings.all();
}

std::vector<core::Problem> folding_warnings(const std::vector<StageFolding>& stages) {
  core::ProblemList warnings;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageFolding& stage = stages[i];
    const std::string where = "stage " + std::to_string(i);
    warn(stage.folded_ranges, where + " range", stage.farthest_m, "m", stage.farthest_reads_m,
         stage.unambiguous_range_m, warnings);
    warn(stage.folded_speeds, where + " radial speed", stage.fastest_mps, "m/s",
         stage.fastest_reads_mps, stage.unambiguous_speed_mps, warnings);
    if (stage.negative_beats > 0)
      warnings.warning("FOLDED", {}, where + " beat sign",
                       std::to_string(stage.negative_beats) + " beats",
                       "real samples read a negative beat as its amount");
  }
  return warnings.all();
}

}  // namespace fanbeam::signal
