#include "benchmarks/bench_report.h"

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
    "What a picture costs in milliseconds and how far it is from the converged one in grey levels\n"
    "(one is 0.235 dB), with the receiver's noise in both / noise-free. Two cores; the machine, "
    "what\n"
    "the words mean and every table follow below.\n\n";

constexpr const char* kWords =
    "## How to read the tables\n\n"
    "Written by `build/release/bin/fanbeam_bench --report docs/performance.md` (`./dev bench`\n"
    "prints the same); every figure was measured in one run on the machine below. The last\n"
    "chapters are those of `docs/performance-notes.md`.\n\n"
    "**Rays** and **slices** are the two ways to see a scene: Embree rays, given as rays per "
    "range\n"
    "cell and column, and vertical cuts with exact visibility, given as azimuth slices per "
    "column.\n"
    "**Time** is the median from a pose to both display images in memory, after a warm-up.\n"
    "**Error** is the grey-level RMS over all cells against a converged picture, on unrounded "
    "grey\n"
    "clamped to 0..255: with the receiver's mean noise in both pictures / noise-free. *Lit* "
    "counts\n"
    "only cells whose noise-free reference is above grey 0, *p99* is the 99th percentile there.\n"
    "One grey level is 60/255 = 0.235 dB. The reference, for both casters, is made of rays: 256\n"
    "jittered azimuths per column and 8 rays per range cell; in one view per scene a second one\n"
    "with another seed states its own error.\n\n"
    "Errors, times and sampling steps are of the **whole picture**: every effect that the plan "
    "asks "
    "for\nis on, in the picture and in its reference. Where a row says *surfaces alone*, double "
    "bounce and\nground multipath are off in both.\n\n";

constexpr const char* kQuickHead =
    "**A quick run: few repetitions against a coarse reference. The figures mean nothing.**\n\n";

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
  const int native_packet = report.scenes.front().scene->scene->world.surfaces().native_packet();
  return fmt::format(
      "## Machine\n\n"
      "| | |\n| --- | --- |\n"
      "| processor | {}, {} cores, {:.0f} GB |\n"
      "| threads | {} |\n"
      "| other programs during the run | {:.2f} cores busy (times are good near 0) |\n"
      "| instruction level of hot functions | {}, Embree packets {} wide |\n"
      "| system | {} |\n| compiler | {} |\n| commit | {} |\n\n",
      core::processor_name(), std::thread::hardware_concurrency(), memory_bytes / 1e9,
      report.threads, report.other_cores, core::name_of(core::instruction_level()), native_packet,
      system_name(), compiler_name(), commit());
}

std::string plots_markdown(const Report& report) {
  if (report.plots.empty()) return "";
  std::string out =
      "## Error over time\n\n"
      "The ladders below, drawn: each point is a finer sampling than the one to its left.\n\n";
  for (const std::string& plot : report.plots)
    out += fmt::format("[![Error over frame time](images/{0}.png)](images/{0}.svg)\n\n", plot);
  return out;
}

std::string sequence_line(const std::string& scene, const SequenceFigures& sequence) {
  return fmt::format("| {} | {} | {} | {} | {:.1f} ms | {:.1f} frames/s |\n", scene,
                     sequence.options, sequence.chosen, sequence.frames, sequence.frame_ms,
                     sequence.frames_per_s_written);
}

std::string scenes_markdown(const Report& report) {
  std::string out =
      "## Scenes\n\n"
      "Memory is the highest while the scene was built and a frame rendered. Sequences go through\n"
      "`fanbeam render` at its default sampling with both pictures written as PNG.\n\n"
      "| scene | triangles | point targets | build | peak memory |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const SceneFigures& figures : report.scenes) {
    const BenchScene& scene = *figures.scene;
    const renderer::World& world = scene.scene->world;
    out += fmt::format("| {} | {:.2f} M | {} | {:.2f} s | {:.2f} GB |\n", scene.name,
                       static_cast<double>(world.surfaces().triangle_count()) / 1e6,
                       world.targets.size(), scene.scene->build_s, scene.peak_memory_bytes / 1e9);
  }
  out +=
      "\n| sequence | options | cast by | frames | frame | on disk |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const SceneFigures& figures : report.scenes)
    for (const SequenceFigures& sequence : figures.sequences)
      out += sequence_line(figures.scene->name, sequence);
  if (report.rain && report.rain->sequence)
    out += sequence_line(report.rain->scene, *report.rain->sequence);
  return out + "\n";
}

std::string agreement_line(const AgreementFigures& line) {
  std::string out = fmt::format("| {}, {:.0f} m | {} |", line.scene, line.distance_m, line.what);
  for (const PictureAgreement* picture : {&line.agreement.bscope, &line.agreement.cscope})
    out += fmt::format(" {} | {:+.3f} dB | {} / {} of {} |",
                       pair_text(picture->error.with_noise.rms, picture->error.noise_free.rms),
                       picture->mean_dB, picture->off_with_noise, picture->off_noise_free,
                       picture->cells);
  return out + "\n";
}

std::string agreement_markdown(const Report& report) {
  std::string out = fmt::format(
      "## Slices against rays\n\n"
      "Two independent methods, both converged: no error of sampling should be left between them.\n"
      "The mean is that of the noise-free power of lit cells over the ray reference's; the last\n"
      "figure of each picture counts cells more than {:.0f} grey levels apart, with noise /\n"
      "noise-free. Where it was made, a second reference shows how far two pictures of rays are\n"
      "apart.\n\n"
      "| view | what | B RMS | B mean | B cells | C RMS | C mean | C cells |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n",
      kClearlyOff_grey);
  std::vector<AgreementFigures> slices;
  for (const SceneFigures& scene : report.scenes) {
    for (const ViewFigures& view : scene.views) {
      out += agreement_line(view.slices_agreement);
      slices.push_back(view.slices_agreement);
      if (view.reference_agreement) out += agreement_line(*view.reference_agreement);
    }
  }
  for (const AgreementFigures& line : report.agreement) {
    out += agreement_line(line);
    slices.push_back(line);
  }
  return out + "\n" + off_cells_markdown(slices);
}

std::string scaling_markdown(const SceneFigures& scene) {
  if (scene.scaling.empty()) return "";
  std::string out = fmt::format(
      "## Time over the number of triangles\n\n"
      "The ground of {}, 12 km x 12 km, its heights interpolated to posts at other distances, "
      "with\n"
      "its land cover, paint, sensor and weather but without buildings and targets: the same\n"
      "picture from the same pose, {:.0f} m before the threshold, frames in turns at default\n"
      "sampling.\n\n"
      "| posts | triangles | rays ({:.0f} per cell) | slices ({:.0f} per column) |\n"
      "| --- | --- | --- | --- |\n",
      scene.scene->name, scene.views.front().view.distance_m, renderer::kDefaultRaysPerCell,
      renderer::kDefaultSlicesPerColumn);
  for (const ScalingStep& step : scene.scaling)
    out += fmt::format("| {:.1f} m | {:.2f} M | {:.1f} ms | {:.1f} ms |\n", step.spacing_m,
                       static_cast<double>(step.triangles) / 1e6, step.rays_ms, step.slices_ms);
  const ScalingStep& few = scene.scaling.front();
  const ScalingStep& many = scene.scaling.back();
  return out + fmt::format("| last over first | {:.0f} | {:.2f} | {:.2f} |\n\n",
                           static_cast<double>(many.triangles) / static_cast<double>(few.triangles),
                           many.rays_ms / few.rays_ms, many.slices_ms / few.slices_ms);
}

}  // namespace

std::string markdown(const Report& report) {
  const TargetRows targets = target_rows(report);
  std::string out = kHead;
  if (report.quick) out += kQuickHead;
  out += summary_markdown(report, targets) + plots_markdown(report) + kWords +
         machine_markdown(report) + targets_markdown(targets, report.skipped) +
         scenes_markdown(report) + agreement_markdown(report);
  for (const SceneFigures& scene : report.scenes) out += scaling_markdown(scene);
  for (const SceneFigures& scene : report.scenes)
    for (const ViewFigures& figures : scene.views) out += view_markdown(figures, report.threads);
  if (report.campaigns) out += campaigns_markdown(*report.campaigns);
  out += bounds_markdown(report.bounds) + estimates_markdown(report.estimates);
  out += report.notes;
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

}  // namespace fanbeam::benchmarks
