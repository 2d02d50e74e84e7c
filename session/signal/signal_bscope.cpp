#include "session/signal/signal_bscope.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "core/constants.h"
#include "core/effect_plan.h"
#include "renderer/stages/frame_echoes.h"
#include "sensors/display/grey_scale.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/scan/column_scan.h"
#include "signal/scan/column_sweep.h"

namespace fanbeam::session {
namespace {

renderer::FrameEchoSettings echo_settings(const SignalBscopeSettings& settings,
                                          std::uint32_t look) {
  renderer::FrameEchoSettings result;
  result.sampling.sub_columns = settings.azimuths;
  result.sampling.rays_per_cell = settings.rays_per_cell;
  result.own_velocity_mps = settings.own_velocity_mps;
  result.multipath = settings.multipath;
  result.swerling = settings.swerling;
  result.seed = settings.seed;
  result.look = look;
  return result;
}

std::vector<double> delays_s(const std::vector<core::Echo>& echoes) {
  std::vector<double> result;
  for (const core::Echo& echo : echoes)
    result.push_back(2.0 * echo.range_m / core::kSpeedOfLight_mps);
  return result;
}

signal::FloatCube beat_of(const sensors::Sensor& sensor, const renderer::FrameEchoes& found,
                          const std::vector<std::size_t>& members) {
  std::vector<core::Echo> echoes;
  std::vector<double> phases_rad;
  for (const std::size_t i : members) {
    echoes.push_back(found.echoes[i]);
    phases_rad.push_back(found.phase_rad[i]);
  }
  return signal::scan_beat(sensor, echoes, phases_rad);
}

double sum_W(const std::vector<core::Echo>& echoes) {
  double sum = 0.0;
  for (const core::Echo& echo : echoes) sum += echo.power_W;
  return sum;
}

}  // namespace

sensors::Sensor with_sweep_window(sensors::Sensor sensor) {
  using Window = sensors::Waveform::Window;
  if (sensor.waveform.window == Window::none) sensor.waveform.window = Window::taylor;
  return sensor;
}

SignalBscope signal_bscope(const renderer::World& world, const renderer::FramePose& pose,
                           const SignalBscopeSettings& settings) {
  const sensors::Sensor sensor = with_sweep_window(world.sensor);
  const double taken_off_mps =
      sensor.waveform.doppler_compensated ? glm::length(settings.own_velocity_mps) : 0.0;
  FmcwReceiver receiver =
      fmcw_receiver(settings.receiver, noise_figure_of(settings.receiver, sensor),
                    signal::column_sweep(sensor, 0).sample_rate_Hz[0], true);
  const SamplesShown shown{.window_dB = sensors::GreyScale(sensor).window_dB()};
  SignalBscope result;
  result.looks = settings.looks > 0 ? settings.looks : sensor.receiver.looks;
  result.power_W.assign(
      static_cast<std::size_t>(sensor.range.cells) * static_cast<std::size_t>(sensor.scan.columns),
      0.0);
  for (std::uint32_t look = 0; look < static_cast<std::uint32_t>(result.looks); ++look) {
    const renderer::FrameEchoes found =
        renderer::frame_echoes(world, pose, echo_settings(settings, look));
    result.rays += found.rays;
    result.scatterers += found.echoes.size();
    result.events = found.events;  // of every look the same
    signal::FloatCube beat = signal::scan_beat(sensor, found.echoes, found.phase_rad);
    const std::vector<double> delays = delays_s(found.echoes);
    receiver.longest_delay_s =
        delays.empty() ? 0.0 : *std::max_element(delays.begin(), delays.end());
    const core::EffectPlan plan =
        receiver_plan(settings.budget, shown, receiver, sum_W(found.echoes), beat);
    keep_larger(plan, result.plan);
    const core::RandomKey key{renderer::seed_of_look(settings.seed, look), 0, pose.frame_index};
    if (plan.runs(core::EffectId::phase_noise)) {
      beat = with_phase_noise(
          {}, receiver, key, delays,
          [&](const std::vector<std::size_t>& members) { return beat_of(sensor, found, members); });
      result.phase_noise_rad =
          std::max(result.phase_noise_rad, phase_noise_rad(receiver, beat.shape.samples));
    }
    result.clipped += receive({}, receiver, plan, key, beat);
    const std::vector<double> cells_W = signal::scan_cells_W(sensor, beat, taken_off_mps);
    for (std::size_t i = 0; i < cells_W.size(); ++i) result.power_W[i] += cells_W[i] / result.looks;
  }
  return result;
}

}  // namespace fanbeam::session
