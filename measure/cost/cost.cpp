#include "measure/cost/cost.h"

#include "core/files.h"
#include "core/machine.h"
#include "core/turns.h"
#include "measure/cost/cost_csv.h"
#include "measure/cost/cost_markdown.h"
#include "measure/cost/levels_report.h"
#include "measure/cost_plots.h"
#include "measure/effect_prices.h"
#include "measure/frame_clock.h"
#include "measure/ladder.h"
#include "measure/numerics.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;

double time_once_ms(const FrameClock& work) {
  return core::time_in_turns({[&work] { work.render(); }}, 1).front().ms;
}

CostFigures head_of(const CostBench& bench, int threads) {
  const scenes::Scene& scene = bench.scene;
  CostFigures figures;
  figures.scene = scene.description.name;
  figures.title = scene.description.title;
  figures.machine = {core::processor_name(), core::name_of(core::instruction_level()), threads};
  figures.caster = renderer::name_of(bench.sampling.caster);
  if (!bench.slices) figures.why_no_slices = scene.caster.why_no_slices;
  figures.triangles = scene.world.surfaces().triangle_count();
  figures.dB_per_grey = sensors::GreyScale(scene.world.sensor).dB_per_grey();
  figures.accuracy_grey = scene.accuracy_grey;
  figures.quick = bench.effort.quick;
  figures.repetitions = bench.effort.repetitions;
  figures.frames = bench.frames;
  return figures;
}

}  // namespace

Pace measure_pace(const scenes::Scene& scene, int frame, bool slices) {
  constexpr double kNaiveRays = 2.0;
  const renderer::FramePose pose = scene.frame_pose(frame);
  const renderer::Effects effects = renderer::without_draws(renderer::effects_of(scene.plan, 0));
  Pace pace;
  pace.build_s = scene.build_s;
  pace.frame_ms = time_once_ms(
      {scene.world, pose, renderer::default_sampling(renderer::CasterKind::rays), effects});
  if (slices)
    pace.slices_ms = time_once_ms(
        {scene.world, pose, renderer::default_sampling(renderer::CasterKind::profile), effects});
  pace.naive_ms = time_once_ms({scene.world,
                                pose,
                                renderer::NaiveKind::dithered,
                                kNaiveRays,
                                {scene.world.sensor.antenna.boresight_elevation_rad, 0.0},
                                effects}) /
                  kNaiveRays;
  return pace;
}

double expected_cost_s(const CostBench& bench, const CostParts& parts) {
  const auto frames = static_cast<double>(bench.frames.size());
  double total_s = 0.0;
  if (parts.ladder || parts.numerics)
    total_s += frames * 2.0 * bench.pace.reference_s(bench.effort);
  if (parts.ladder) total_s += frames * bench.pace.ladder_s(bench.effort);
  if (parts.effects) total_s += effects_s(bench);
  if (parts.numerics) total_s += numerics_s(bench);
  return total_s;
}

CostFigures measure_cost(const CostBench& bench, const CostParts& parts, int threads) {
  CostFigures figures = head_of(bench, threads);
  if (parts.ladder || parts.numerics) {
    const auto references = render_references(bench, figures.references);
    if (parts.ladder) figures.ladder = measure_ladder(bench, references);
    if (parts.numerics) figures.numerics = measure_numerics(bench, references);
  }
  if (parts.effects) figures.effects = measure_effects(bench);
  return figures;
}

void write_cost(const CostFigures& figures, const fs::path& folder) {
  core::write_file_atomically(folder / "cost.md", cost_markdown(figures));
  if (!figures.ladder.empty()) {
    core::write_file_atomically(folder / "ladder.csv", ladder_csv(figures));
    core::write_file_atomically(folder / "equal_error.csv", equal_error_csv(figures));
  }
  if (!figures.effects.empty())
    core::write_file_atomically(folder / "effects.csv", effects_csv(figures));
  if (!figures.numerics.variants.empty())
    core::write_file_atomically(folder / "numerics.csv", numerics_csv(figures));
  if (!figures.levels.empty())
    core::write_file_atomically(folder / "levels.csv", levels_csv(figures));
  if (!figures.ladder.empty()) {
    session::write_plots(cost_ladder_plot(figures, false), folder / "ladder");
    session::write_plots(cost_ladder_plot(figures, true), folder / "ladder-cscope");
  }
  if (!figures.effects.empty()) session::write_plots(effects_plot(figures), folder / "effects");
  if (!figures.levels.empty()) session::write_plots(levels_plot(figures), folder / "levels");
}

}  // namespace fanbeam::measure
