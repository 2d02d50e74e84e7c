#include "measure/regress/tolerance.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::measure {
namespace {

double percent_of(std::size_t part, std::size_t cells) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(cells, 1));
}

}  // namespace

LayerJudgement judge(const core::LayerDifference& difference, session::DifferenceUnit unit,
                     const std::optional<Tolerance>& tolerance) {
  const bool in_dB = unit == session::DifferenceUnit::dB;
  const std::string of = session::unit_text(unit, difference.layer);
  const Tolerance limits = tolerance.value_or(Tolerance{});
  LayerJudgement judged{difference.layer,
                        {},
                        in_dB ? difference.largest_dB_column : difference.largest_column,
                        in_dB ? difference.largest_dB_row : difference.largest_row};
  const auto add = [&](const char* name, const std::string& in, double value,
                       std::optional<double> allowed) {
    // A value that is no number is not within anything.
    const bool within = !allowed || std::abs(value) <= *allowed;
    judged.figures.push_back({name, in, value, allowed, within});
    judged.within = judged.within && within;
  };
  add("mean", of, in_dB ? difference.mean_dB : difference.mean, limits.mean);
  add("rms", of, in_dB ? difference.rms_dB : difference.rms, limits.rms);
  add("largest", of, in_dB ? difference.largest_dB : difference.largest, limits.largest);
  add("percent", "%", percent_of(difference.different, difference.cells),
      tolerance ? limits.percent : 0.0);
  // A share allows cells whatever they hold, and power without decibels has no largest.
  if (difference.not_finite > 0)
    add("not_finite", "cells", static_cast<double>(difference.not_finite), 0.0);
  if (unit == session::DifferenceUnit::own)
    add("changed_percent", "%", percent_of(difference.changed, difference.cells),
        limits.changed_percent);
  if (in_dB)
    add("lit_in_one_percent", "%", percent_of(difference.only_one_positive, difference.cells),
        limits.lit_in_one_percent.value_or(0.0));
  return judged;
}

}  // namespace fanbeam::measure
