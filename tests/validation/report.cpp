#include "tests/validation/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace fanbeam::validation {
namespace {

constexpr double kRounding = 1e-9;

std::string printed(double deviation) {
  return deviation < kRounding ? "< 1e-9" : fmt::format("{:.1e}", deviation);
}

double worst(const Section& section) {
  double most = 0.0;
  for (const Comparison& row : section.rows) {
    const double value = deviation(section, row);
    if (!(value <= most)) most = value;
  }
  return most;
}

std::string tolerance_text(const Section& section) {
  const std::string number = fmt::format("{:g}", section.tolerance);
  return section.measure == Section::Measure::relative ? number + " relative"
                                                       : number + " " + section.unit;
}

std::string summary(const std::vector<Section>& sections) {
  std::string text =
      "| comparison | values | largest deviation | tolerance |\n|---|---:|---:|---:|\n";
  for (const Section& section : sections)
    text += fmt::format("| {} | {} | {} | {} |\n", section.title, section.rows.size(),
                        printed(worst(section)), tolerance_text(section));
  return text;
}

}  // namespace

double deviation(const Section& section, const Comparison& row) {
  const double difference = std::abs(row.ours - row.published);
  if (section.measure == Section::Measure::difference || difference == 0.0) return difference;
  return difference / std::abs(row.published);
}

std::vector<std::string> failures(const std::vector<Section>& sections) {
  std::vector<std::string> lines;
  for (const Section& section : sections) {
    if (section.rows.empty()) lines.push_back(section.title + ": nothing was compared");
    for (const Comparison& row : section.rows)
      if (!(deviation(section, row) <= section.tolerance))
        lines.push_back(
            fmt::format("{}: {}: ours {:.10g}, published {:.10g} {}, off by {:.3g}, allowed {}",
                        section.title, row.what, row.ours, row.published, section.unit,
                        deviation(section, row), tolerance_text(section)));
  }
  return lines;
}

std::string markdown(const std::vector<Section>& sections) {
  std::size_t count = 0;
  for (const Section& section : sections) count += section.rows.size();
  std::string text = fmt::format(
      "# Validation\n\n"
      "Every figure of fanbeam that can be held against one from elsewhere: {} comparisons, made "
      "by\n"
      "`fanbeam_validation`, which `./dev test` runs and which fails when a value leaves its "
      "tolerance.\n"
      "This file is its output. The published rows lie in `tests/data` with their source; where a "
      "row\n"
      "was computed for this project by another program, the source says so.\n\n{}",
      count, summary(sections));
  for (const Section& section : sections) {
    text += fmt::format("\n## {}\n\nSource: {}. Tolerance {}: {}.\n\n", section.title,
                        section.source, tolerance_text(section), section.reason);
    text += fmt::format("| | ours | published | deviation |\n|---|---:|---:|---:|\n");
    for (const Comparison& row : section.rows)
      text += fmt::format("| {} | {:.7g} | {:.7g} | {} |\n", row.what, row.ours, row.published,
                          printed(deviation(section, row)));
    text += section.unit.empty() ? "" : fmt::format("\nValues in {}.\n", section.unit);
  }
  return text;
}

}  // namespace fanbeam::validation
