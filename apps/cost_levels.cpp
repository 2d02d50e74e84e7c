#include "apps/cost_levels.h"

#include <fmt/core.h>

#include <cmath>

#include "core/turns.h"
#include "measure/clock.h"
#include "measure/frame_clock.h"
#include "renderer/accuracy/swept_picture.h"
#include "renderer/frame_renderer.h"
#include "renderer/stages/range_response.h"
#include "sensors/display/display.h"
#include "session/signal/signal_bscope.h"
#include "signal/scan/column_sweep.h"

namespace fanbeam::apps {
namespace {

constexpr int kThinParts = 8;
constexpr renderer::Products kBscopeAlone = {.bscope = true, .cscope = false};

// The whole picture but for its range response, which is given to powers here: shipped sensors show
// ideal cells, and a sweep has none.
renderer::Effects whole_picture(const measure::CostBench& bench) {
  renderer::Effects effects = renderer::without_draws(renderer::effects_of(bench.scene.plan, 0));
  effects.on.erase(core::EffectId::range_response);
  return effects;
}

// Converged powers behind the sweep. `thin` has its range cells in kThinParts.
std::vector<double> reference_W(const measure::CostBench& bench, const scenes::Scene& thin,
                                const sensors::Sensor& sensor, const renderer::Effects& effects) {
  renderer::Sampling sampling = bench.effort.reference(1);
  sampling.rays_per_cell /= kThinParts;
  const renderer::FrameRenderer frames(thin.world, sampling, kBscopeAlone, effects);
  return renderer::swept_power_W(
      sensor, frames.render(thin.frame_pose(bench.frames.front())).bscope_W, kThinParts);
}

class GreyDistance {
 public:
  GreyDistance(const sensors::Sensor& sensor, std::vector<double> reference_W)
      : sensor_(sensor), reference_(grey(std::move(reference_W), sensor.noise_power_W())) {}

  // RMS over all cells of grey. `noise_W` is added to `power_W`: 0 where it has its own.
  double rms(const std::vector<double>& power_W, double noise_W) const {
    const std::vector<double> shown = grey(power_W, noise_W);
    double squares = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      squares += (shown[i] - reference_[i]) * (shown[i] - reference_[i]);
    return std::sqrt(squares / static_cast<double>(shown.size()));
  }

 private:
  std::vector<double> grey(std::vector<double> power_W, double noise_W) const {
    for (double& power : power_W) power += noise_W;
    return sensors::bscope_grey(sensor_, power_W);
  }

  const sensors::Sensor& sensor_;
  std::vector<double> reference_;
};

void measure_pictures(const measure::CostBench& bench, const sensors::Sensor& sensor,
                      const renderer::Effects& effects, const GreyDistance& distance,
                      std::vector<measure::LevelStep>& steps) {
  const renderer::FramePose pose = bench.scene.frame_pose(bench.frames.front());
  const renderer::RangeResponse response(sensor);
  std::vector<renderer::FrameRenderer> renderers;
  for (const double fineness : bench.effort.rays)
    renderers.emplace_back(bench.scene.world, measure::sampling_of(measure::Way::rays, fineness),
                           kBscopeAlone, effects);
  const auto render = [&](const renderer::FrameRenderer& frames) {
    std::vector<double> power_W = frames.render(pose).bscope_W;
    response.apply(power_W);
    return power_W;
  };
  std::vector<std::function<void()>> works;
  for (const renderer::FrameRenderer& frames : renderers)
    works.emplace_back([&render, &frames] { render(frames); });
  const std::vector<core::MedianTime> times = core::time_in_turns(works, bench.effort.repetitions);
  for (std::size_t i = 0; i < renderers.size(); ++i)
    steps.push_back({bench.frames.front(), "picture", bench.effort.rays[i], times[i],
                     distance.rms(render(renderers[i]), sensor.noise_power_W())});
}

void measure_signals(const measure::CostBench& bench, const GreyDistance& distance,
                     std::vector<measure::LevelStep>& steps) {
  const renderer::FramePose pose = bench.scene.frame_pose(bench.frames.front());
  std::vector<double> sum_W, times_ms;
  for (const int looks : bench.effort.looks) {
    while (static_cast<int>(times_ms.size()) < looks) {
      session::SignalBscopeSettings settings;
      settings.looks = 1;
      settings.seed = times_ms.size();
      const measure::Clock::time_point begin = measure::Clock::now();
      const std::vector<double> power_W =
          session::signal_bscope(bench.scene.world, pose, settings).power_W;
      times_ms.push_back(measure::milliseconds_since(begin));
      sum_W.resize(power_W.size(), 0.0);
      for (std::size_t i = 0; i < power_W.size(); ++i) sum_W[i] += power_W[i];
    }
    std::vector<double> mean_W = sum_W;
    for (double& power : mean_W) power /= looks;
    core::MedianTime time = core::median_of(times_ms);
    time.ms *= looks;
    time.error_ms *= looks;
    steps.push_back({bench.frames.front(), "signal", static_cast<double>(looks), time,
                     distance.rms(mean_W, 0.0)});
  }
}

}  // namespace

std::string why_no_levels(const measure::CostBench& bench) {
  return signal::why_no_column_sweep(bench.scene.world.sensor);
}

double levels_s(const measure::CostBench& bench) {
  // Measured: a look takes as long as some 30 frames of rays at default sampling.
  constexpr double kLookOverFrame = 30.0;
  double rays_ms = 0.0;
  for (const double fineness : bench.effort.rays)
    rays_ms += bench.pace.step_ms(measure::Way::rays, fineness);
  return bench.pace.build_s + 2.0 * bench.pace.reference_s(bench.effort) +
         (bench.effort.repetitions + 6.0) * rays_ms / 1000.0 +
         bench.effort.looks.back() * kLookOverFrame * bench.pace.frame_ms / 1000.0;
}

std::vector<measure::LevelStep> measure_levels(const measure::CostBench& bench) {
  bench.begin(fmt::format("frame {}, signal level", bench.frames.front()), levels_s(bench));
  const sensors::Sensor sensor = session::with_sweep_window(bench.scene.world.sensor);
  const auto thin = bench.with_sensor(renderer::thin_cells(sensor, kThinParts));
  const auto distance = [&](const renderer::Effects& effects) {
    return GreyDistance(sensor, reference_W(bench, *thin, sensor, effects));
  };
  std::vector<measure::LevelStep> steps;
  const renderer::Effects whole = whole_picture(bench);
  measure_pictures(bench, sensor, whole, distance(whole), steps);
  measure_signals(bench, distance(renderer::Effects{}), steps);
  return steps;
}

}  // namespace fanbeam::apps
