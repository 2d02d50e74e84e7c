#include <fmt/core.h>

#include "benchmarks/bench_report.h"
#include "core/errors.h"

namespace fanbeam::benchmarks {
namespace {

std::string pair_of(const PictureError& error, double GreyError::*figure) {
  return benchmarks::pair_text(error.with_noise.*figure, error.noise_free.*figure);
}

// Six columns: B-scope RMS, lit, p99, C-scope RMS, lit, p99.
std::string error_columns(const FrameError& error) {
  std::string out;
  for (const PictureError* picture : {&error.bscope, &error.cscope})
    for (double GreyError::*figure : {&GreyError::rms, &GreyError::lit_rms, &GreyError::lit_p99})
      out += fmt::format(" {} |", pair_of(*picture, figure));
  return out + "\n";
}

std::string table_head(const std::string& first, const std::string& work, const std::string& rate) {
  return fmt::format(
      "| {} | ms | frames/s | {} | {} | B RMS | B lit | B p99 | C RMS | C lit | C p99 |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      first, work, rate);
}

std::string ray_head(const std::string& first) { return table_head(first, "rays", "Mray/s"); }

std::string ray_row(const std::string& first, double frame_ms, std::uint64_t rays,
                    const FrameError& error) {
  const double millions = static_cast<double>(rays) / 1e6;
  return fmt::format("| {} | {:.1f} | {:.1f} | {:.3f} M | {:.1f} |", first, frame_ms,
                     1000.0 / frame_ms, millions, millions / frame_ms * 1000.0) +
         error_columns(error);
}

std::string slice_row(const std::string& first, const LadderStep& step) {
  const auto count = static_cast<double>(step.slices);
  return fmt::format("| {} | {:.1f} | {:.1f} | {} | {:.1f} |", first, step.time.ms,
                     1000.0 / step.time.ms, step.slices,
                     count > 0.0 ? 1000.0 * step.time.ms / count : 0.0) +
         error_columns(step.error);
}

// The ladder and the two operating points below it; `row` makes a line of a name and a step.
template <class Row>
std::string ladder_rows(const CasterFigures& figures, const Row& row) {
  std::string out;
  for (const LadderStep& step : figures.ladder) out += row(core::number_text(step.fineness), step);
  const auto point = [&](const LadderStep& step, double budget_ms, const char* name) {
    out += row(fmt::format("{} ({})", core::number_text(step.fineness),
                           step.time.ms <= budget_ms ? name : "coarsest"),
               step);
  };
  point(figures.at_16Hz, kBudget16Hz_ms, "16 Hz");
  point(figures.at_45Hz, kBudget45Hz_ms, "45 Hz");
  point(figures.at_90Hz, kBudget90Hz_ms, "90 Hz");
  return out;
}

std::string threads_line(const CasterFigures& figures, const char* unit, int threads) {
  return fmt::format(
      "- {} {}, {} threads against one, in turns: {:.1f} ms against {:.1f} ms, {:.2f} times\n",
      core::number_text(figures.at_16Hz.fineness), unit, threads, figures.threads.all_ms,
      figures.threads.one_ms, figures.threads.gain());
}

std::string rays_markdown(const ViewFigures& figures, int threads) {
  const BarePass& bare = figures.bare;
  std::string out = "### Rays\n\n" + ray_head("rays per cell");
  out += ladder_rows(figures.rays, [](const std::string& name, const LadderStep& step) {
    return ray_row(name, step.time.ms, step.rays, step.error);
  });
  if (figures.reference_error)
    out += ray_row("second reference", figures.reference_s * 1000.0, figures.reference_rays,
                   *figures.reference_error);
  return out + "\n" + threads_line(figures.rays, "rays per cell", threads) +
         fmt::format(
             "- surfaces alone, bare pass over the {:.3f} M rays that fit 16 Hz: {:.1f} ms ({}, "
             "{:.1f} Mray/s)\n  beside frames of {:.1f} ms: ratio {:.2f}, {:.1f} ns a ray beside "
             "the library's own\n\n",
             static_cast<double>(bare.rays) / 1e6, bare.bare_ms, bare.shape,
             static_cast<double>(bare.rays) / bare.bare_ms / 1000.0, bare.frame_ms, bare.ratio(),
             bare.beside_ns(threads));
}

std::string slices_markdown(const ViewFigures& figures, int threads) {
  return "### Slices\n\n" + table_head("slices per column", "slices", "us per slice") +
         ladder_rows(figures.slices, slice_row) +
         slice_row("surfaces alone, 16 Hz: " + core::number_text(figures.surfaces.at_16Hz.fineness),
                   figures.surfaces.at_16Hz) +
         slice_row("surfaces alone, 90 Hz: " + core::number_text(figures.surfaces.at_90Hz.fineness),
                   figures.surfaces.at_90Hz) +
         "\n" + threads_line(figures.slices, "slices per column", threads) + "\n";
}

std::string naive_markdown(const ViewFigures& figures) {
  std::string out =
      "### Naive yardsticks\n\n"
      "Uniform elevation angles over the span of the rays above, single rays, each hit into one\n"
      "cell; one azimuth per column (plain) or one per ray (dithered).\n\n" +
      ray_head("kind");
  for (const LadderStep& step : figures.naive)
    out += ray_row(step.way == Way::naive_plain ? "plain" : "dithered", step.time.ms, step.rays,
                   step.error);
  return out + "\n";
}

std::string splits_markdown(const ViewFigures& figures) {
  if (figures.splits.empty()) return "";
  std::string out = fmt::format(
      "### How {:.0f} rays per cell and column are best split\n\n"
      "Azimuth sub-columns times rays per range cell.\n\n",
      renderer::kDefaultRaysPerCell);
  out += ray_head("sub-columns x rays");
  for (const LadderStep& step : figures.splits)
    out += ray_row(fmt::format("{} x {}", step.sampling.sub_columns,
                               core::number_text(step.sampling.rays_per_cell)),
                   step.time.ms, step.rays, step.error);
  return out + "\n";
}

}  // namespace

std::string pair_text(double with_noise, double noise_free) {
  return fmt::format("{:.2f} / {:.2f}", with_noise, noise_free);
}

std::string view_markdown(const ViewFigures& figures, int threads) {
  const View& view = figures.view;
  return fmt::format(
             "## {}, {:.0f} m before the threshold\n\nFrame {}, {:.0f} m above the threshold.\n\n",
             view.scene->name, view.distance_m, view.frame, view.height_m) +
         slices_markdown(figures, threads) + rays_markdown(figures, threads) +
         splits_markdown(figures) + naive_markdown(figures);
}

}  // namespace fanbeam::benchmarks
