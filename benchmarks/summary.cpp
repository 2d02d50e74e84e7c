#include <fmt/core.h>

#include "benchmarks/bench_report.h"

namespace fanbeam::benchmarks {
namespace {

std::string rate_cell(const LadderStep& figures, const std::string& unit) {
  const FrameError& error = figures.error;
  return fmt::format("{}, {} grey, {:.3g} {}{} in {:.1f} ms",
                     pair_text(error.bscope.with_noise.rms, error.bscope.noise_free.rms),
                     pair_text(error.cscope.with_noise.rms, error.cscope.noise_free.rms),
                     figures.fineness, unit, figures.fineness == 1.0 ? "" : "s", figures.time.ms);
}

std::string rates(const Report& report) {
  std::string out =
      "| whole picture, B-scope and C-scope error | 16 Hz, slices | 16 Hz, rays | 90 Hz, slices |\n"
      "| --- | --- | --- | --- |\n";
  for (const SceneFigures& scene : report.scenes)
    for (const ViewFigures& view : scene.views)
      out +=
          fmt::format("| {}, {:.0f} m before the threshold | {} | {} | {} |\n", scene.scene->name,
                      view.view.distance_m, rate_cell(view.slices.at_16Hz, "slice"),
                      rate_cell(view.rays.at_16Hz, "ray"), rate_cell(view.slices.at_90Hz, "slice"));
  return out;
}

std::string sequences(const Report& report) {
  std::string out =
      "| every effect, default sampling, with files | frame | on disk |\n| --- | --- | --- |\n";
  const auto add = [&](const std::string& scene, const SequenceFigures& sequence) {
    out += fmt::format("| {}, {} | {:.1f} ms | {:.1f} frames/s |\n", scene, sequence.options,
                       sequence.frame_ms, sequence.frames_per_s_written);
  };
  for (const SceneFigures& scene : report.scenes)
    for (const SequenceFigures& sequence : scene.sequences) add(scene.scene->name, sequence);
  if (report.rain && report.rain->sequence) add(report.rain->scene, *report.rain->sequence);
  return out;
}

std::string missed(const TargetRows& targets) {
  std::string rows;
  for (const TargetRow& row : targets)
    if (row.missed()) rows += row.missed_markdown();
  if (rows.empty()) return "Every target is met.\n";
  return "Missed, of all targets below:\n\n| what | must | aim | measured | why |\n"
         "| --- | --- | --- | --- | --- |\n" +
         rows;
}

}  // namespace

std::string summary_markdown(const Report& report, const TargetRows& targets) {
  return "## In short\n\n" + rates(report) + "\n" + sequences(report) + "\n" + missed(targets) +
         "\n";
}

}  // namespace fanbeam::benchmarks
