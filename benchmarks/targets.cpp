#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "benchmarks/report.h"

namespace fanbeam::benchmarks {
namespace {

// Grey levels RMS over all cells, with noise and noise-free.
struct ErrorTarget {
  double with_noise, noise_free;
};

struct RateTarget {
  const char* scene;
  const char* rate;
  double budget_ms;
  SamplingFigures ViewFigures::*figures;
  ErrorTarget must;
  std::optional<ErrorTarget> aim;
};

const std::vector<RateTarget>& rate_targets() {
  static const std::vector<RateTarget> kTargets = {
      {kDefaultScene, "16 Hz", kBudget16Hz_ms, &ViewFigures::at_16Hz, {1.0, 2.0}, {{0.5, 1.0}}},
      {kCityScene, "16 Hz", kBudget16Hz_ms, &ViewFigures::at_16Hz, {2.0, 3.5}, {{1.5, 2.5}}},
      {kDefaultScene, "90 Hz", kBudget90Hz_ms, &ViewFigures::at_90Hz, {3.0, 6.0}, {}},
  };
  return kTargets;
}

constexpr double kMostBareRatio = 1.5;
constexpr double kAimBareRatio = 1.2;
constexpr double kMostOfNaive = 0.25;
constexpr double kMostBuild_s = 15.0;
constexpr double kMostMemory_bytes = 2e9;
constexpr double kLeastWritten_Hz = 16.0;

enum class Verdict { aim_met, must_met, missed };

const char* text(Verdict verdict, bool has_aim) {
  if (verdict == Verdict::missed) return "missed";
  return verdict == Verdict::aim_met && has_aim ? "aim met" : "must met";
}

Verdict worse(Verdict a, Verdict b) { return std::max(a, b); }

Verdict judge(double value, double must, double aim) {
  if (value <= aim) return Verdict::aim_met;
  return value <= must ? Verdict::must_met : Verdict::missed;
}

std::string pair_text(const ErrorTarget& target) {
  return fmt::format("{:.1f} / {:.1f}", target.with_noise, target.noise_free);
}

std::string row(const std::string& what, const std::string& must, const std::string& aim,
                const std::string& measured, const char* verdict) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", what, must, aim, measured, verdict);
}

std::string error_row(const SceneFigures& scene, const RateTarget& target, const char* scope,
                      PictureError FrameError::*picture) {
  std::string measured;
  Verdict verdict = Verdict::aim_met;
  const ErrorTarget aim = target.aim.value_or(target.must);
  for (const ViewFigures& view : scene.views) {
    const SamplingFigures& figures = view.*target.figures;
    const PictureError& error = figures.error.*picture;
    if (!measured.empty()) measured += "; ";
    measured += fmt::format("{:.2f} / {:.2f} at {:.0f} m", error.with_noise.rms,
                            error.noise_free.rms, view.view.distance_m);
    verdict = worse(verdict, judge(error.with_noise.rms, target.must.with_noise, aim.with_noise));
    verdict = worse(verdict, judge(error.noise_free.rms, target.must.noise_free, aim.noise_free));
    if (figures.frame_ms <= target.budget_ms) continue;
    verdict = Verdict::missed;
    measured += fmt::format(", but in {:.1f} ms, the coarsest sampling", figures.frame_ms);
  }
  return row(fmt::format("{}, {}, {} error, grey RMS", scene.scene->name, target.rate, scope),
             pair_text(target.must), target.aim ? pair_text(*target.aim) : "-", measured,
             text(verdict, target.aim.has_value()));
}

std::string bare_row(const SceneFigures& scene) {
  std::string measured;
  Verdict verdict = Verdict::aim_met;
  for (const ViewFigures& view : scene.views) {
    if (!measured.empty()) measured += "; ";
    measured += fmt::format("{:.2f} at {:.0f} m", view.bare.ratio(), view.view.distance_m);
    verdict = worse(verdict, judge(view.bare.ratio(), kMostBareRatio, kAimBareRatio));
  }
  return row(scene.scene->name + ", 16 Hz, frame time over bare pass",
             fmt::format("{:.1f}", kMostBareRatio), fmt::format("{:.1f}", kAimBareRatio), measured,
             text(verdict, true));
}

std::string naive_row(const SceneFigures& scene, double rms) {
  std::string measured;
  Verdict verdict = Verdict::aim_met;
  for (const ViewFigures& view : scene.views) {
    if (!measured.empty()) measured += "; ";
    const std::string at = fmt::format(" at {:.0f} m", view.view.distance_m);
    const auto ours_ms = ms_at_error(view.ladder, rms);
    const auto naive_ms = ms_at_error(view.naive, NaiveKind::dithered, rms);
    if (!ours_ms) {
      measured += "error not reached" + at;
      verdict = Verdict::missed;
      continue;
    }
    // A naive ladder that ends before the error is reached bounds the share from above.
    const double share = *ours_ms / naive_ms.value_or(view.naive.back().frame_ms);
    measured += fmt::format("{}{:.2f}{}", naive_ms ? "" : "below ", share, at);
    verdict = worse(verdict, judge(share, kMostOfNaive, kMostOfNaive));
  }
  return row(fmt::format("{}, share of naive-dithered's time at noise-free error {:.1f}",
                         scene.scene->name, rms),
             fmt::format("{:.2f}", kMostOfNaive), "-", measured, text(verdict, false));
}

std::string build_row(const SceneFigures& scene) {
  const double build_s = scene.scene->scene->build_s;
  const double memory_bytes = scene.scene->peak_memory_bytes;
  const bool met = build_s < kMostBuild_s && memory_bytes < kMostMemory_bytes;
  return row(scene.scene->name + ", scene build and peak memory",
             fmt::format("{:.0f} s, {:.0f} GB", kMostBuild_s, kMostMemory_bytes / 1e9), "-",
             fmt::format("{:.1f} s, {:.2f} GB", build_s, memory_bytes / 1e9),
             met ? "must met" : "missed");
}

std::string sequence_row(const SceneFigures& scene) {
  const double written_Hz = scene.sequence->frames_per_s_written;
  return row(scene.scene->name + ", default sampling, frames/s on disk",
             fmt::format("{:.0f}", kLeastWritten_Hz), "-", fmt::format("{:.1f}", written_Hz),
             written_Hz >= kLeastWritten_Hz ? "must met" : "missed");
}

}  // namespace

std::string targets_markdown(const Report& report) {
  std::string out =
      "## Targets and measured figures\n\n"
      "Set for two cores. Errors are with noise / noise-free, rates mean the finest sampling "
      "whose\n"
      "median frame fits 62.5 ms (16 Hz) or 11.1 ms (90 Hz); every view has to hold.\n\n"
      "| what | must | aim | measured | |\n| --- | --- | --- | --- | --- |\n";
  for (const SceneFigures& scene : report.scenes) {
    for (const RateTarget& target : rate_targets()) {
      if (scene.scene->name != target.scene) continue;
      out += error_row(scene, target, "B-scope", &FrameError::bscope);
      out += error_row(scene, target, "C-scope", &FrameError::cscope);
    }
    out += bare_row(scene);
    for (const double rms : kEqualErrors) out += naive_row(scene, rms);
    if (scene.scene->name == kCityScene) out += build_row(scene);
    if (scene.sequence) out += sequence_row(scene);
  }
  for (const std::string& name : report.skipped)
    out += fmt::format("| {} | | | not measured: its data were not there | |\n", name);
  return out + "\n";
}

}  // namespace fanbeam::benchmarks
