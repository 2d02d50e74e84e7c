#include "apps/render_summary.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/common.h"
#include "core/errors.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

std::string frames_text(int count) {
  return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

// What was asked for and what was reached, where an accuracy or a time was asked for.
void print_accuracy(const session::RunRecord& record, double accuracy_grey) {
  const session::SamplingChoice& choice = record.choice;
  if (choice.budget_ms > 0.0)
    fmt::print(
        "{:.1f} ms of {:.1f} ms a frame, sampling error {:.2f} grey: the same again with "
        "--rays-per-cell {}{}{}\n",
        choice.slowest_ms, choice.budget_ms, choice.estimated_error_grey,
        core::number_text(choice.samples),
        accuracy_grey > 0.0 ? " --accuracy " + core::number_text(accuracy_grey) : std::string(),
        choice.fits ? "" : " (the coarsest there is, and too slow)");
  double largest_grey = 0.0;
  std::size_t estimated = 0, missed = 0;
  for (const session::FrameRecord& frame : record.frames) {
    if (!frame.error) continue;
    ++estimated;
    largest_grey = std::max(largest_grey, frame.error->largest_grey());
    if (!frame.error->reached) ++missed;
  }
  if (estimated == 0) return;
  fmt::print("sampling error at most {:.2f} grey RMS (estimated)", largest_grey);
  if (choice.sampling.target_grey > 0.0)
    fmt::print(", asked for {:.2f}{}", choice.sampling.target_grey,
               missed > 0 ? fmt::format(": {} frames missed it at the finest sampling", missed)
                          : std::string());
  fmt::print("\n");
}

}  // namespace

void print_render_summary(const session::Sequence& sequence, const scenes::Scene& scene,
                          double accuracy_grey) {
  const session::RunRecord& record = sequence.record;
  fmt::print("{} in {:.1f} s", frames_text(sequence.asked), record.wall_s);
  if (sequence.resumed > 0) fmt::print(" ({} already there)", sequence.resumed);
  fmt::print(", scene built in {:.1f} s\n", record.scene_build_s);
  if (const int beside = static_cast<int>(record.frames.size()) - sequence.asked; beside > 0)
    fmt::print("{} of the same input there before and kept\n", frames_text(beside));
  if (sequence.removed > 0)
    fmt::print("{} of another input removed\n", frames_text(sequence.removed));
  fmt::print("cast by {}: {}\n", session::caster_text(record.choice.sampling), scene.caster.reason);
  print_accuracy(record, accuracy_grey);
  for (const core::EffectDecision& decision : scene.plan.decisions)
    fmt::print("  {:14} {:3}  {}\n", name_of(decision.effect), decision.on ? "on" : "off",
               decision.reason);
  for (const session::ProductPlace& place : sequence.places)
    fmt::print("{:10} {}\n", place.name, full_path(place.path));
}

}  // namespace fanbeam::apps
