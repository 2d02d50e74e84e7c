#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "benchmarks/bench_report.h"
#include "benchmarks/reasons.h"
#include "benchmarks/view_targets.h"
#include "core/median.h"

namespace fanbeam::benchmarks {
namespace {

constexpr double kMostBuild_s = 15.0;
constexpr double kMostMemory_bytes = 1e9;
constexpr Target kWritten_Hz{16.0, 16.0, true}, kWrittenV3_Hz{12.0, 12.0, true};
constexpr Target kAgreement_grey{0.5, 0.5}, kAgreementNoiseFree_grey{0.8, 0.8};
constexpr Target kAgreement_dB{0.02, 0.02};
constexpr Target kScaling{3.0, 3.0};
constexpr Target kPlanTime_ms{20.0, 20.0};
constexpr Target kConditions_ms{20.0, 20.0};
constexpr Target kLayers{1.25, 1.25};
constexpr Target kUnaskedLayers{1.01, 1.01};
constexpr Target kPlanSaving{0.3, 0.3, true};
constexpr Target kOffOverAbsent{1.01, 1.01};
constexpr Target kEstimatesWithin{0.95, 0.95, true};

TargetRow build_row(const SceneFigures& scene) {
  const double build_s = scene.scene->scene->build_s;
  const double memory_bytes = scene.scene->peak_memory_bytes;
  TargetRow row(scene.scene->name + ", scene build and peak memory", kNotKnown,
                fmt::format("{:.0f} s, {:.0f} GB", kMostBuild_s, kMostMemory_bytes / 1e9));
  row.add(fmt::format("{:.1f} s, {:.2f} GB", build_s, memory_bytes / 1e9));
  row.judge(build_s, {kMostBuild_s, kMostBuild_s});
  row.judge(memory_bytes, {kMostMemory_bytes, kMostMemory_bytes});
  return row;
}

TargetRow sequence_row(const std::string& scene, const SequenceFigures& sequence) {
  const bool v3 = sequence.isa == "v3";
  const Target& target = v3 ? kWrittenV3_Hz : kWritten_Hz;
  const Reason why = scene != kCityScene ? kNotKnown : v3 ? kCityFrameV3 : kCityFrame;
  TargetRow row(fmt::format("{}, {}, default sampling, frames/s on disk", scene, sequence.options),
                why, fmt::format("at least {:.0f}", target.must));
  row.add(fmt::format("{:.1f}", sequence.frames_per_s_written));
  row.judge(sequence.frames_per_s_written, target);
  return row;
}

TargetRows city_defaults_rows(const SceneFigures& scene) {
  std::vector<DefaultError> views;
  for (const ViewFigures& view : scene.views)
    views.push_back({view.view.distance_m, view.at_default});
  return default_rows(scene.scene->name, views);
}

TargetRows rain_rows(const DefaultFigures& figures) {
  TargetRows rows = default_rows(figures.scene, figures.views);
  if (figures.sequence) rows.push_back(sequence_row(figures.scene, *figures.sequence));
  return rows;
}

// Of several lines of the table of agreement that belong to one scene.
TargetRows agreement_rows(const std::string& scene, const std::vector<AgreementFigures>& lines) {
  TargetRows rows;
  for (const auto picture : {&FrameAgreement::bscope, &FrameAgreement::cscope}) {
    TargetRow row(fmt::format("{}, converged slices against rays, {}, grey RMS and mean", scene,
                              picture == &FrameAgreement::bscope ? "B-scope" : "C-scope"),
                  kNotKnown,
                  fmt::format("{:.1f} / {:.1f}, {:.2f} dB either way", kAgreement_grey.must,
                              kAgreementNoiseFree_grey.must, kAgreement_dB.must));
    for (const AgreementFigures& line : lines) {
      const PictureAgreement& figures = line.agreement.*picture;
      row.add(fmt::format("{}, {:+.3f} dB at {:.0f} m",
                          pair_text(figures.error.with_noise.rms, figures.error.noise_free.rms),
                          figures.mean_dB, line.distance_m));
      row.judge(figures.error.with_noise.rms, kAgreement_grey);
      row.judge(figures.error.noise_free.rms, kAgreementNoiseFree_grey);
      row.judge(std::abs(figures.mean_dB), kAgreement_dB);
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<AgreementFigures> of_slices(const SceneFigures& scene) {
  std::vector<AgreementFigures> lines;
  for (const ViewFigures& view : scene.views) lines.push_back(view.slices_agreement);
  return lines;
}

TargetRow scaling_row(const SceneFigures& scene) {
  const ScalingStep& few = scene.scaling.front();
  const ScalingStep& many = scene.scaling.back();
  TargetRow row(fmt::format("ground of {}, time with {:.1f} M triangles over that with {:.1f} M",
                            scene.scene->name, static_cast<double>(many.triangles) / 1e6,
                            static_cast<double>(few.triangles) / 1e6),
                kNotKnown, fmt::format("{:.0f}", kScaling.must));
  for (const auto& [name, time_ms] :
       {std::pair{"rays", &ScalingStep::rays_ms}, std::pair{"slices", &ScalingStep::slices_ms}}) {
    const double ratio = many.*time_ms / (few.*time_ms);
    row.add(fmt::format("{:.2f} {}", ratio, name));
    row.judge(ratio, kScaling);
  }
  return row;
}

TargetRows plan_rows(const PlanFigures& plan) {
  const std::string& name = plan.scene->name;
  TargetRow time(name + ", planning, ms", kNotKnown, fmt::format("{:.0f}", kPlanTime_ms.must));
  time.add(fmt::format("{:.2f}", plan.plan_ms));
  time.judge(plan.plan_ms, kPlanTime_ms);
  TargetRow conditions(name + ", other weather until the stages of its first frame stand, ms",
                       kNotKnown, fmt::format("{:.0f}", kConditions_ms.must));
  conditions.add(fmt::format("{:.1f}", plan.conditions_ms));
  conditions.judge(plan.conditions_ms, kConditions_ms);
  TargetRows rows = {time, conditions};
  // What it saves depends on what a scene needs: the target is the default scene's.
  if (name == kDefaultScene) {
    TargetRow saving(name +
                         ", rays, share of the frame time that pruning saves against all effects "
                         "forced on",
                     kAllNeeded, fmt::format("at least {:.2f}", kPlanSaving.must));
    saving.add(fmt::format("{:.2f} ({:.1f} ms with {} effects, {:.1f} ms with {})",
                           plan.saved_sample(), plan.planned_ms, plan.on_planned,
                           plan.forced_sample_ms, plan.on_forced_sample));
    saving.add(fmt::format("{:.2f} against {:.1f} ms with the {} of a mean picture", plan.saved(),
                           plan.forced_ms, plan.on_forced));
    saving.judge(plan.saved_sample(), kPlanSaving);
    rows.push_back(saving);
  }
  TargetRow absence(fmt::format("{}, rays, frame with {} effects possible but off over one where "
                                "they cannot occur",
                                name, plan.only_possible),
                    kNotKnown, fmt::format("{:.2f}", kOffOverAbsent.must));
  absence.add(fmt::format("{:.4f} over {} frames", plan.off_over_absent, plan.frames));
  absence.judge(plan.off_over_absent, kOffOverAbsent);
  rows.push_back(absence);
  return rows;
}

TargetRow estimates_row(const std::vector<EstimateCase>& cases) {
  const EstimateTally tally = tally_of(cases);
  TargetRow row(
      "all scenes, share of pictures whose error is within a factor of 1.5 of what they state, of "
      "those with more than 0.05 grey in one of the two",
      kNotKnown, fmt::format("at least {:.2f}", kEstimatesWithin.must));
  row.add(fmt::format("{:.2f}: {}", tally.share(), tally.text()));
  row.judge(tally.share(), kEstimatesWithin);
  return row;
}

}  // namespace

TargetRow layers_row(const std::vector<LayerCost>& costs) {
  TargetRow row("all scenes, frame with layers of both scopes over one without, default sampling",
                kLayerPass, fmt::format("{:.2f}", kLayers.must));
  for (const LayerCost& cost : costs) {
    row.add(fmt::format("{:.2f} {} ({:.1f} and {:.1f} ms)", cost.ratio(), cost.scene,
                        cost.layers_ms, cost.plain_ms));
    row.judge(cost.ratio(), kLayers);
  }
  return row;
}

TargetRow unasked_layers_row(const std::vector<LayerCost>& costs) {
  TargetRow row(
      "all scenes, frame without layers in a session that gives them to others, over one in a "
      "session that never did, median of the scenes",
      kNotKnown, fmt::format("{:.2f}", kUnaskedLayers.must));
  std::vector<double> ratios;
  for (const LayerCost& cost : costs) {
    row.add(fmt::format("{:.3f} {}", cost.unasked_ratio(), cost.scene));
    ratios.push_back(cost.unasked_ratio());
  }
  row.judge(core::median(ratios), kUnaskedLayers);
  return row;
}

TargetRows target_rows(const Report& report) {
  TargetRows rows;
  for (const SceneFigures& scene : report.scenes) {
    add_rows(rows, view_rows(scene, report.threads));
    add_rows(rows, agreement_rows(scene.scene->name, of_slices(scene)));
    if (scene.scene->name == kCityScene) rows.push_back(build_row(scene));
    if (!scene.scaling.empty()) rows.push_back(scaling_row(scene));
    if (scene.plan) add_rows(rows, plan_rows(*scene.plan));
    for (const SequenceFigures& sequence : scene.sequences)
      rows.push_back(sequence_row(scene.scene->name, sequence));
    if (scene.scene->name == kCityScene) add_rows(rows, city_defaults_rows(scene));
  }
  for (const AgreementFigures& line : report.agreement)
    add_rows(rows, agreement_rows(line.scene, {line}));
  if (report.rain) add_rows(rows, rain_rows(*report.rain));
  if (!report.layers.empty()) {
    rows.push_back(layers_row(report.layers));
    rows.push_back(unasked_layers_row(report.layers));
  }
  if (report.campaigns) add_rows(rows, campaign_rows(*report.campaigns));
  if (!report.bounds.empty()) rows.push_back(bounds_row(report.bounds));
  if (!report.estimates.empty()) rows.push_back(estimates_row(report.estimates));
  return rows;
}

std::string targets_markdown(const TargetRows& rows, const std::vector<std::string>& skipped) {
  std::string out =
      "## Targets and measured figures\n\n"
      "Set for two cores. Errors are with noise / noise-free, rates mean the finest sampling "
      "whose\n"
      "median frame fits 62.5 ms (16 Hz), 22.2 ms (45 Hz) or 11.1 ms (90 Hz); every view has to "
      "hold. Errors are of\nthe whole picture where a row does not say otherwise. Targets are\n"
      "upper limits where they do not say otherwise.\n\n"
      "| what | must | aim | measured | |\n| --- | --- | --- | --- | --- |\n" +
      markdown_of(rows);
  for (const std::string& name : skipped)
    out += fmt::format("| {} | | | not measured: its data were not there | |\n", name);
  return out + "\n";
}

}  // namespace fanbeam::benchmarks
