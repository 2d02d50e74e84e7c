#include "session/signal/chain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.h"
#include "core/effect_plan.h"
#include "session/signal/channel_factors.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/keystone_synthesis.h"
#include "signal/waveform/folding.h"

namespace fanbeam::session {
namespace {

// Kinds without a fast way take every path for every sample: more than this would take hours.
constexpr double kMostProducts = 1e11;

void check_work(const signal::Frame& frame, std::size_t paths) {
  const double products = static_cast<double>(frame.shape.count()) * static_cast<double>(paths);
  if (!frame.uniform && products > kMostProducts)
    core::throw_input_error(
        core::ErrorClass::limit, "--waveform",
        fmt::format("{} with {} paths x {} samples", signal::name(frame.waveform.kind), paths,
                    frame.shape.count()),
        "at most 1e11 products: fewer --rays-per-cell, samples or receivers");
}

// Complex samples, of a real waveform too: receive() makes those real.
signal::FloatCube synthesise(const FmcwRadar& radar, int stage,
                             const std::vector<signal::ScatterPath>& paths, FmcwFrame& frame) {
  signal::Waveform waveform = radar.waveform;
  waveform.complex_baseband = true;
  const signal::Frame layout = signal::make_frame(waveform, stage, radar.array);
  check_work(layout, paths.size());
  if (layout.uniform && paths.size() > kMostDirectPaths) {
    signal::KeystoneBeat beat = signal::keystone_beat(waveform, stage, radar.array, paths);
    if (stage == 0) {
      frame.keystone = true;
      frame.synthesis_error = std::max(frame.synthesis_error, beat.estimated_error);
    }
    return std::move(beat.cube);
  }
  const signal::SynthesisOptions fine;
  if (stage == 0) frame.synthesis_error = std::max(frame.synthesis_error, fine.relative_error);
  return signal::synthesise_beat(waveform, stage, radar.array, paths, fine);
}

std::vector<double> delays_s(const std::vector<signal::ScatterPath>& paths) {
  std::vector<double> result;
  for (const signal::ScatterPath& path : paths)
    result.push_back(2.0 * std::abs(path.range_m) / core::kSpeedOfLight_mps);
  return result;
}

// Every channel's own gain and phase.
void apply_channel_errors(const ArraySettings& array, signal::FloatCube& beat) {
  const auto factors =
      channel_factors(array.gain_errors_dB, array.phase_errors_rad, beat.shape.channels);
  for (int channel = 0; channel < beat.shape.channels; ++channel) {
    const auto factor =
        static_cast<std::complex<float>>(factors[static_cast<std::size_t>(channel)]);
    if (factor == 1.0F) continue;
    for (std::size_t k = beat.index(channel, 0, 0); k < beat.index(channel + 1, 0, 0); ++k)
      beat.values[k] *= factor;
  }
}

// Of the channel that has most, in power.
double largest_gain(const ArraySettings& array, int channels) {
  double largest = 0.0;
  for (const auto& factor : channel_factors(array.gain_errors_dB, {}, channels))
    largest = std::max(largest, std::norm(factor));
  return largest;
}

// What other radars' chirps add to samples of `shape`, channel errors included; empty without any.
signal::FloatCube interference_in(const FmcwRadar& radar, int stage, const FmcwSettings& options,
                                  const std::vector<signal::Interferer>& interferers,
                                  const signal::CubeShape& shape, std::size_t& crossed) {
  if (interferers.empty()) return {};
  signal::FloatCube heard(shape);
  crossed = signal::add_interference(radar.waveform, stage, radar.array, interferers, heard);
  apply_channel_errors(options, heard);
  return heard;
}

double sum_W(const std::vector<signal::ScatterPath>& paths) {
  double sum = 0.0;
  for (const signal::ScatterPath& path : paths) sum += std::norm(path.amplitude_sqrtW);
  return sum;
}

SamplesShown shown_by(const FmcwRadar& radar, const FmcwSettings& options,
                      const std::set<std::string>& products) {
  SamplesShown shown;
  shown.window_dB = options.dynamic_range_dB;
  shown.samples_asked = products.contains("beat");
  const bool beams = products.contains("cube") || products.contains("range-azimuth") ||
                     products.contains("top-view");
  if (beams) shown.beams = radar.array.channels();
  return shown;
}

}  // namespace

FmcwFrame fmcw_frame(const FmcwRadar& radar, const std::vector<signal::ScatterPath>& paths,
                     int frame_number, const FmcwSettings& options,
                     const std::set<std::string>& products, const SignalBudget& budget,
                     const std::vector<signal::Interferer>& interferers) {
  if (!interferers.empty()) signal::check_hears_others(radar.waveform);
  FmcwFrame frame;
  const auto policy =
      options.refuse_folding ? signal::FoldingPolicy::refuse : signal::FoldingPolicy::count;
  frame.warnings = signal::folding_warnings(signal::count_folding(radar.waveform, paths, policy));
  const std::vector<core::Problem> azimuths =
      signal::folded_azimuths(radar.array, radar.waveform.wavelength_m(), paths, policy);
  frame.warnings.insert(frame.warnings.end(), azimuths.begin(), azimuths.end());
  const SamplesShown shown = shown_by(radar, options, products);
  const double echo_W = sum_W(paths);
  const std::vector<double> delays = delays_s(paths);
  for (int stage = 0; stage < radar.waveform.stages(); ++stage) {
    signal::FloatCube beat = synthesise(radar, stage, paths, frame);
    apply_channel_errors(options, beat);
    FmcwReceiver receiver = fmcw_receiver(
        options, radar.noise_figure, radar.waveform.sample_rate_Hz[static_cast<std::size_t>(stage)],
        !options.real);
    receiver.longest_delay_s =
        delays.empty() ? 0.0 : *std::max_element(delays.begin(), delays.end());
    std::size_t crossed = 0;
    const signal::FloatCube interference =
        interference_in(radar, stage, options, interferers, beat.shape, crossed);
    const double strongest_W = echo_W * largest_gain(options, beat.shape.channels);
    const core::EffectPlan plan =
        receiver_plan(budget, shown, receiver, strongest_W, beat, interference);
    keep_larger(plan, frame.plan);
    // A stage more is another stretch of time: draws of its own.
    const core::RandomKey key{options.seed, 0,
                              static_cast<std::uint64_t>(frame_number) *
                                      static_cast<std::uint64_t>(radar.waveform.stages()) +
                                  static_cast<std::uint64_t>(stage)};
    if (plan.runs(core::EffectId::phase_noise)) {
      if (stage == 0) {  // made anew, echoes of one delay at a time
        frame.keystone = false;
        frame.synthesis_error = 0.0;
      }
      beat = with_phase_noise(radar.array, receiver, key, delays,
                              [&](const std::vector<std::size_t>& members) {
                                std::vector<signal::ScatterPath> some;
                                for (const std::size_t i : members) some.push_back(paths[i]);
                                return synthesise(radar, stage, some, frame);
                              });
      apply_channel_errors(options, beat);
      frame.phase_noise_rad =
          std::max(frame.phase_noise_rad, phase_noise_rad(receiver, beat.shape.samples));
    }
    if (plan.runs(core::EffectId::interference)) {
      frame.crossed += crossed;
      for (std::size_t i = 0; i < beat.values.size(); ++i) beat.values[i] += interference.values[i];
    }
    frame.clipped += receive(radar.array, receiver, plan, key, beat);
    frame.beats.push_back(std::move(beat));
  }
  process_samples(radar, options, products, frame);
  return frame;
}

FmcwFrame fmcw_frame(const FmcwRadar& radar, const scenes::Scene& scene, const FmcwPaths& paths,
                     int frame, const FmcwSettings& options,
                     const std::set<std::string>& products) {
  return fmcw_frame(radar, paths.paths, frame, options, products, signal_budget(scene),
                    paths.interferers);
}

}  // namespace fanbeam::session
