#include "benchmarks/report.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "core/errors.h"
#include "core/machine.h"
#include "core/text.h"

namespace fanbeam::benchmarks {
namespace {

constexpr const char* kHead =
    "# Performance\n\n"
    "Written by `build/release/bin/fanbeam_bench --report docs/performance.md` (`./dev bench`\n"
    "prints the same); every figure was measured in one run on the machine below.\n\n"
    "**Time** is the median from a pose to both display images in memory, after a warm-up.\n"
    "**Error** is the grey-level RMS over all cells against a converged picture, on unrounded "
    "grey\n"
    "clamped to 0..255: with the receiver's mean noise in both pictures / noise-free. *Lit* "
    "counts\n"
    "only cells whose noise-free reference is above grey 0, *p99* is the 99th percentile there.\n"
    "One grey level is 60/255 = 0.235 dB. The reference has 256 jittered azimuths per column and "
    "8\n"
    "rays per range cell; in one view per scene a second one with another seed states its own "
    "error.\n\n"
    "Errors, sampling steps and bare-pass ratios are of surfaces and point targets alone: double "
    "bounce and\nground multipath are off there. Frames written to disk run every effect that the "
    "plan asks for.\n\n";

std::string first_line_of(const char* command) {
  std::FILE* pipe = popen(command, "r");
  if (pipe == nullptr) return "";
  char line[256] = "";
  const bool got = std::fgets(line, sizeof line, pipe) != nullptr;
  pclose(pipe);
  return got ? std::string(core::trimmed(line)) : "";
}

std::string commit() {
  const std::string text = first_line_of("git -C '" FANBEAM_SOURCE_DIR
                                         "' describe --always --dirty --abbrev=12 2>/dev/null");
  return text.empty() ? "unknown" : text;
}

std::string system_name() {
  std::ifstream stream("/etc/os-release");
  const std::string key = "PRETTY_NAME=\"";
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(key)) return line.substr(key.size(), line.size() - key.size() - 1);
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

std::string machine_markdown(const Report& report) {
  const double memory_bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  const int native_packet = report.scenes.front().scene->scene->world.surfaces->native_packet();
  return fmt::format(
      "## Machine\n\n"
      "| | |\n| --- | --- |\n"
      "| processor | {}, {} cores, {:.0f} GB |\n"
      "| threads | {} |\n"
      "| load before the run | {:.2f} programs (mean over the minute before) |\n"
      "| instruction level of hot functions | {}, Embree packets {} wide |\n"
      "| system | {} |\n| compiler | {} |\n| commit | {} |\n\n",
      core::processor_name(), std::thread::hardware_concurrency(), memory_bytes / 1e9,
      report.threads, report.load_before, core::instruction_level(), native_packet, system_name(),
      compiler_name(), commit());
}

std::string scenes_markdown(const Report& report) {
  std::string out =
      "## Scenes\n\n"
      "Memory is the highest while the scene was built and a frame rendered. Sequences go through\n"
      "`fanbeam render` at its default sampling with both pictures written as PNG.\n\n"
      "| scene | triangles | point targets | build | peak memory | sequence: frame | on disk |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const SceneFigures& figures : report.scenes) {
    const BenchScene& scene = *figures.scene;
    const renderer::World& world = scene.scene->world;
    out += fmt::format("| {} | {:.2f} M | {} | {:.2f} s | {:.2f} GB |", scene.name,
                       static_cast<double>(world.surfaces->triangle_count()) / 1e6,
                       world.targets.size(), scene.scene->build_s, scene.peak_memory_bytes / 1e9);
    out += figures.sequence
               ? fmt::format(" {:.1f} ms | {:.1f} frames/s |\n", figures.sequence->frame_ms,
                             figures.sequence->frames_per_s_written)
               : std::string(" - | - |\n");
  }
  return out + "\n";
}

std::string pair_text(const PictureError& error, double GreyError::*figure) {
  return fmt::format("{:.2f} / {:.2f}", error.with_noise.*figure, error.noise_free.*figure);
}

// Six columns: B-scope RMS, lit, p99, C-scope RMS, lit, p99.
std::string error_columns(const FrameError& error) {
  std::string out;
  for (const PictureError* picture : {&error.bscope, &error.cscope})
    for (double GreyError::*figure : {&GreyError::rms, &GreyError::lit_rms, &GreyError::lit_p99})
      out += fmt::format(" {} |", pair_text(*picture, figure));
  return out + "\n";
}

std::string table_head(const std::string& first) {
  return "| " + first +
         " | ms | frames/s | rays | Mray/s | B RMS | B lit | B p99 | C RMS | C lit | C p99 |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
}

std::string table_row(const std::string& first, double frame_ms, std::uint64_t rays,
                      const FrameError& error) {
  const double millions = static_cast<double>(rays) / 1e6;
  return fmt::format("| {} | {:.1f} | {:.1f} | {:.3f} M | {:.1f} |", first, frame_ms,
                     1000.0 / frame_ms, millions, millions / frame_ms * 1000.0) +
         error_columns(error);
}

std::string ladder_markdown(const ViewFigures& figures) {
  std::string out = table_head("rays per cell");
  const auto line = [&](const SamplingFigures& step, const char* note) {
    out += table_row(core::number_text(step.rays_per_cell) + note, step.frame_ms, step.rays,
                     step.error);
  };
  for (const SamplingFigures& step : figures.ladder) line(step, "");
  line(figures.at_16Hz, figures.at_16Hz.frame_ms <= kBudget16Hz_ms ? " (16 Hz)" : " (coarsest)");
  line(figures.at_90Hz, figures.at_90Hz.frame_ms <= kBudget90Hz_ms ? " (90 Hz)" : " (coarsest)");
  if (figures.reference_error)
    out += table_row("second reference", figures.reference_s * 1000.0, figures.reference_rays,
                     *figures.reference_error);
  return out + "\n";
}

std::string naive_markdown(const ViewFigures& figures) {
  std::string out =
      "Naive yardsticks: uniform elevation angles over the span of the rays above, single rays,\n"
      "each hit into one cell; one azimuth per column (plain) or one per ray (dithered).\n\n" +
      table_head("kind");
  for (const NaiveFigures& step : figures.naive)
    out += table_row(step.kind == NaiveKind::plain ? "plain" : "dithered", step.frame_ms, step.rays,
                     step.error);
  return out + "\n";
}

std::string splits_markdown(const ViewFigures& figures) {
  if (figures.splits.empty()) return "";
  std::string out = fmt::format(
      "How {:.0f} rays per cell and column are best split: azimuth sub-columns times rays per\n"
      "range cell.\n\n",
      renderer::kDefaultRaysPerCell);
  out += table_head("sub-columns x rays");
  for (const SamplingFigures& step : figures.splits)
    out += table_row(fmt::format("{} x {}", step.sampling.sub_columns,
                                 core::number_text(step.sampling.rays_per_cell)),
                     step.frame_ms, step.rays, step.error);
  return out + "\n";
}

std::string view_markdown(const ViewFigures& figures, int threads) {
  const View& view = figures.view;
  const BarePass& bare = figures.bare;
  std::string out = fmt::format(
      "## {}, {:.0f} m before the threshold\n\nFrame {}, {:.0f} m above the threshold.\n\n",
      view.scene->name, view.distance_m, view.frame, view.height_m);
  out += ladder_markdown(figures);
  out += fmt::format(
      "- {} rays per cell, {} threads against one: {:.1f} ms against {:.1f} ms, {:.2f} times\n"
      "- bare pass over the same {:.3f} M rays: {:.1f} ms ({}, {:.1f} Mray/s) beside frames of\n"
      "  {:.1f} ms: ratio {:.2f}\n\n",
      core::number_text(figures.at_16Hz.rays_per_cell), threads, figures.at_16Hz.frame_ms,
      figures.one_thread_ms, figures.one_thread_ms / figures.at_16Hz.frame_ms,
      static_cast<double>(bare.rays) / 1e6, bare.bare_ms, bare.shape,
      static_cast<double>(bare.rays) / bare.bare_ms / 1000.0, bare.frame_ms, bare.ratio());
  return out + splits_markdown(figures) + naive_markdown(figures);
}

}  // namespace

std::string markdown(const Report& report) {
  std::string out =
      kHead + machine_markdown(report) + targets_markdown(report) + scenes_markdown(report);
  for (const SceneFigures& scene : report.scenes)
    for (const ViewFigures& figures : scene.views) out += view_markdown(figures, report.threads);
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

}  // namespace fanbeam::benchmarks
