#include "benchmarks/plan_cost.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/view_clock.h"
#include "core/median.h"
#include "renderer/frame_renderer.h"
#include "scenes/scene_reader.h"
#include "session/session.h"

namespace fanbeam::benchmarks {
namespace {

constexpr int kBuilds = 3;

std::shared_ptr<const scenes::Scene> build_with(const scenes::SceneDescription& description,
                                                const std::string& effects) {
  core::ProblemList problems;
  scenes::BuildOptions options;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  return session::Session(description, {.build = options}, problems).scene();
}

FrameClock clock_of(const scenes::Scene& scene, const renderer::FramePose& pose) {
  return {scene.world, pose, renderer::sampling_for(renderer::kDefaultRaysPerCell),
          renderer::effects_of(scene.plan, 1)};
}

std::size_t running(const core::EffectPlan& plan) {
  return static_cast<std::size_t>(std::count_if(plan.decisions.begin(), plan.decisions.end(),
                                                [](const auto& decision) { return decision.on; }));
}

std::size_t possible(const scenes::Scene& scene) {
  const auto& effects = renderer::effect_catalogue();
  return static_cast<std::size_t>(
      std::count_if(effects.begin(), effects.end(),
                    [&](const auto& effect) { return effect.possible(scene.facts); }));
}

void measure_saving(const View& view, const Effort& effort, PlanFigures& figures) {
  const scenes::Scene& planned = *view.scene->scene;
  const auto forced = build_with(planned.description, "all");
  const auto sample = build_with(planned.description, "all,+speckle,+swerling");
  figures.on_planned = running(planned.plan);
  figures.on_forced = running(forced->plan);
  figures.on_forced_sample = running(sample->plan);
  const FrameClock clocks[] = {clock_of(planned, view.pose), clock_of(*forced, view.pose),
                               clock_of(*sample, view.pose)};
  std::vector<double> times_ms[3];
  for (int turn = 0; turn < std::max(effort.turns, 2); ++turn)
    for (std::size_t i = 0; i < 3; ++i) times_ms[i].push_back(clocks[i].second_frame_ms());
  figures.planned_ms = core::median(times_ms[0]);
  figures.forced_ms = core::median(times_ms[1]);
  figures.forced_sample_ms = core::median(times_ms[2]);
}

scenes::SceneDescription with_weather_and_lobes(scenes::SceneDescription scene) {
  scene.weather.rain_rate_mm_per_h = 5.0;
  scene.surface_state = materials::SurfaceState::wet;
  scene.sensor.antenna.azimuth.side_lobe_gain = 1e-3;
  scene.sensor.antenna.azimuth.side_lobe_extent_rad = 0.1;
  scene.sensor.waveform.window = sensors::Waveform::Window::hann;
  return scene;
}

scenes::SceneDescription without_weather(scenes::SceneDescription scene) {
  scene.weather.visibility_m.reset();
  scene.weather.liquid_water_g_per_m3.reset();
  return scene;
}

// Two worlds of each kind, built in mirrored order: where a world comes to lie in memory changes a
// frame's time by a per cent.
void measure_absence(const View& view, const Effort& effort, PlanFigures& figures) {
  const scenes::SceneDescription& description = view.scene->scene->description;
  const auto build_off = [&] { return build_with(with_weather_and_lobes(description), "none"); };
  const auto build_absent = [&] { return build_with(without_weather(description), "none"); };
  std::vector<std::shared_ptr<const scenes::Scene>> off, absent;
  off.push_back(build_off());
  absent.push_back(build_absent());
  absent.push_back(build_absent());
  off.push_back(build_off());
  figures.only_possible = possible(*off[0]) - possible(*absent[0]);
  const int frames = std::min(effort.quick ? 4 : 100, off[0]->frame_count());
  std::vector<double> ratios;
  for (int i = 0; i < frames; ++i) {
    const int frame = off[0]->frame_count() * i / frames;
    double with_ms = 0.0, without_ms = 0.0;
    for (std::size_t world = 0; world < off.size(); ++world) {
      const FrameClock with = clock_of(*off[world], off[world]->frame_pose(frame));
      const FrameClock without = clock_of(*absent[world], absent[world]->frame_pose(frame));
      with.frame_ms();
      without.frame_ms();
      // There and back: what drifts meanwhile falls on both.
      with_ms += with.frame_ms();
      without_ms += without.frame_ms();
      without_ms += without.frame_ms();
      with_ms += with.frame_ms();
    }
    ratios.push_back(with_ms / without_ms);
  }
  figures.frames = frames;
  figures.off_over_absent = core::median(ratios);
}

void measure_conditions(const View& view, const Effort& effort, PlanFigures& figures) {
  const scenes::Scene& scene = *view.scene->scene;
  const renderer::Sampling sampling = renderer::default_sampling(scene.caster.chosen);
  std::vector<double> conditions_ms;
  for (int turn = 0; turn < std::max(effort.turns, 2); ++turn) {
    scenes::Conditions other{.weather = scene.weather};
    other.weather->rain_rate_mm_per_h = 1.0 + turn;
    const auto begin = measure::Clock::now();
    core::ProblemList known;
    const auto rainy = scenes::under_conditions(scene, other, known);
    const renderer::FrameRenderer stages(rainy->world, sampling, {},
                                         renderer::effects_of(rainy->plan, 0));
    conditions_ms.push_back(measure::milliseconds_since(begin));
  }
  figures.conditions_ms = core::median(conditions_ms);
}

}  // namespace

PlanFigures measure_plan(const View& view, const Effort& effort) {
  fmt::print(stderr, "{}: what the plan costs and saves\n", view.scene->name);
  PlanFigures figures;
  figures.scene = view.scene;
  std::vector<double> plan_ms;
  for (int i = 0; i < kBuilds; ++i)
    plan_ms.push_back(1000.0 * build_with(view.scene->scene->description, "")->plan_s);
  figures.plan_ms = core::median(plan_ms);
  measure_conditions(view, effort, figures);
  measure_saving(view, effort, figures);
  measure_absence(view, effort, figures);
  return figures;
}

}  // namespace fanbeam::benchmarks
