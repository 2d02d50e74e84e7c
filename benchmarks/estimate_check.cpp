#include "benchmarks/estimate_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/bench_scene.h"
#include "benchmarks/view_clock.h"
#include "renderer/accuracy/refinement.h"

namespace fanbeam::benchmarks {
namespace {

struct EstimateWay {
  std::string name;
  renderer::Sampling sampling;
};

std::vector<EstimateWay> ways_of(const scenes::Scene& scene) {
  std::vector<renderer::CasterKind> casters = {renderer::CasterKind::rays};
  if (scene.caster.why_no_slices.empty()) casters.push_back(renderer::CasterKind::profile);
  std::vector<EstimateWay> ways;
  for (const renderer::CasterKind caster : casters) {
    const std::string name = caster == renderer::CasterKind::rays ? "rays" : "slices";
    renderer::Sampling sampling = renderer::default_sampling(caster);
    sampling.estimate_error = true;
    ways.push_back({name + ", default", sampling});
    ways.push_back({name + ", --accuracy 0.5",
                    renderer::refined_sampling(caster, renderer::sampling_share_grey(0.5))});
  }
  return ways;
}

FramePower mean_of(FramePower one, const FramePower& other) {
  const auto mix = [](std::vector<double>& into, const std::vector<double>& more) {
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = (into[i] + more[i]) / 2;
  };
  mix(one.bscope_W, other.bscope_W);
  mix(one.cscope_W_m3, other.cscope_W_m3);
  return one;
}

void check_frame(const BenchScene& bench, int frame, const Effort& effort,
                 std::vector<EstimateCase>& cases) {
  const scenes::Scene& scene = *bench.scene;
  const renderer::Effects effects = bench.effects();
  const auto render = [&](const renderer::Sampling& sampling) {
    return renderer::render_frame(scene.world, sampling, {true, true}, effects,
                                  scene.frame_pose(frame));
  };
  // In two halves: they tell the error of their mean, which is in what a frame differs from it.
  renderer::Sampling half = effort.reference(1), other_half = effort.reference(2);
  half.jittered_passes = other_half.jittered_passes = std::max(half.jittered_passes / 2, 1);
  const FramePower first = power_of(render(half)), second = power_of(render(other_half));
  const auto shown_rms = [&](const PictureError& error) {
    return (effects.runs(core::EffectId::thermal_noise) ? error.with_noise : error.noise_free).rms;
  };
  const renderer::FrameError own = GreyReference(scene.world.sensor, first).error_of(second);
  const GreyReference reference(scene.world.sensor, mean_of(first, second));
  const auto add = [&](const EstimateWay& way, const char* scope, double estimate_grey,
                       const PictureError& error, const PictureError& of_halves) {
    const double apart_grey = shown_rms(error), own_grey = shown_rms(of_halves) / 2;
    const double true_grey =
        std::sqrt(std::max(apart_grey * apart_grey - own_grey * own_grey, 0.0));
    cases.push_back({bench.name, frame, way.name, scope, estimate_grey, true_grey});
  };
  for (const EstimateWay& way : ways_of(scene)) {
    renderer::Frame picture = render(way.sampling);
    const renderer::ErrorEstimate told = *picture.error;
    const renderer::FrameError error = reference.error_of(power_of(std::move(picture)));
    add(way, "B-scope", told.rms_grey, error.bscope, own.bscope);
    add(way, "C-scope", told.cscope_rms_grey, error.cscope, own.cscope);
  }
}

}  // namespace

std::vector<EstimateCase> check_estimates(const Effort& effort) {
  std::vector<EstimateCase> cases;
  for (const std::string& name : shipped_scenes()) {
    const auto bench = load(name);
    if (!bench) continue;
    for (const int frame : spread_frames(*bench->scene, effort.estimate_frames)) {
      fmt::print(stderr, "{}: estimates of frame {}\n", name, frame);
      check_frame(*bench, frame, effort, cases);
    }
  }
  return cases;
}

EstimateTally tally_of(const std::vector<EstimateCase>& cases) {
  EstimateTally tally;
  for (const EstimateCase& each : cases) {
    if (each.invisible()) {
      ++tally.unseen;
      continue;
    }
    ++tally.seen;
    if (each.within()) ++tally.within;
  }
  return tally;
}

std::string EstimateTally::text() const {
  return fmt::format(
      "{} of {} within a factor of 1.5; {} more are below 0.05 grey in both, where nobody sees an "
      "error",
      within, seen, unseen);
}

std::string estimates_markdown(const std::vector<EstimateCase>& cases) {
  if (cases.empty()) return "";
  std::string text =
      "## Errors that frames state of themselves\n\n"
      "Estimated and true error of B-scope and C-scope, grey RMS, with every effect and the noise "
      "that the\n"
      "plan of the scene has. The true error is that against a converged picture less, in "
      "squares,\n"
      "what the halves of that picture say of its own. The last column is the true error over the\n"
      "estimate; an error below 0.05 grey in both is seen by nobody and not counted.\n\n"
      "| scene | frame | sampling | picture | estimated | true | ratio |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const EstimateCase& each : cases)
    text += fmt::format(
        "| {} | {} | {} | {} | {:.3f} | {:.3f} | {}{} |\n", each.scene, each.frame, each.sampling,
        each.scope, each.estimate_grey, each.true_grey,
        each.invisible() ? "-" : fmt::format("{:.2f}", each.true_grey / each.estimate_grey),
        each.within() ? "" : ", **missed**");
  return text + "\n" + tally_of(cases).text() + ".\n\n";
}

}  // namespace fanbeam::benchmarks
