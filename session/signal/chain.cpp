#include "session/signal/chain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "core/constants.h"
#include "core/effect_plan.h"
#include "signal/detection/clusters.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/keystone_synthesis.h"
#include "signal/transform/angle_transform.h"
#include "signal/transform/slot_compensation.h"
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
      frame.synthesis_error = beat.estimated_error;
    }
    return std::move(beat.cube);
  }
  const signal::SynthesisOptions fine;
  if (stage == 0) frame.synthesis_error = fine.relative_error;
  return signal::synthesise_beat(waveform, stage, radar.array, paths, fine);
}

double strongest_delay_s(const std::vector<signal::ScatterPath>& paths) {
  const auto strongest =
      std::max_element(paths.begin(), paths.end(), [](const auto& a, const auto& b) {
        return std::norm(a.amplitude_sqrtW) < std::norm(b.amplitude_sqrtW);
      });
  return strongest == paths.end() ? 0.0 : 2.0 * strongest->range_m / core::kSpeedOfLight_mps;
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

signal::TopViewGrid grid_of(const FmcwRadar& radar) {
  const double reach_m = radar.axes.range_step_m * (radar.detection.transform.kept_range_cells - 1);
  signal::TopViewGrid grid;
  grid.step_m = reach_m / 240.0;
  grid.rows = 241;
  grid.columns = 2 * 120 + 1;  // half as far to either side
  grid.leftmost_m = -120.0 * grid.step_m;
  return grid;
}

void make_maps(const FmcwRadar& radar, const std::set<std::string>& products, FmcwFrame& frame) {
  const auto wants = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return products.contains(name); });
  };
  const bool detections = wants({"range-doppler", "range-azimuth", "top-view", "detections"});
  const bool angles = wants({"cube", "range-azimuth", "top-view"});
  if (!radar.maps || !(detections || angles)) return;
  signal::FloatCube scaled;
  if (radar.power_scale != 1.0) {
    scaled = frame.beats[0];
    const auto scale = static_cast<float>(std::sqrt(radar.power_scale));
    for (std::complex<float>& sample : scaled.values) sample *= scale;
  }
  const signal::FloatCube& beat = radar.power_scale != 1.0 ? scaled : frame.beats[0];
  signal::FloatCube range_speed;
  signal::range_doppler(beat, radar.detection.transform, range_speed);
  if (detections) {
    frame.range_doppler = signal::range_doppler_map(range_speed, signal::Projection::sum);
    FmcwDetections found;
    found.detections =
        signal::detect(beat, frame.range_doppler, radar.array, radar.timing, radar.detection);
    found.clusters = signal::detection_clusters(found.detections, {});
    frame.found = std::move(found);
  }
  if (!angles) return;
  signal::compensate_slots(range_speed, radar.array);
  signal::angle_transform(range_speed, {.kind = signal::WindowKind::taylor, .symmetric = true},
                          static_cast<int>(radar.azimuths_rad.size()), frame.cube);
  if (!wants({"range-azimuth", "top-view"})) return;
  frame.range_azimuth = signal::range_azimuth_map(frame.cube, signal::Projection::max);
  if (!wants({"top-view"})) return;
  frame.grid = grid_of(radar);
  frame.top_view = signal::top_view(frame.range_azimuth, radar.azimuths_rad,
                                    radar.axes.range_step_m, frame.grid);
}

}  // namespace

FmcwFrame fmcw_frame(const FmcwRadar& radar, const sensors::Sensor& sensor,
                     const std::vector<signal::ScatterPath>& paths, int frame_number,
                     const FmcwSettings& options, const std::set<std::string>& products,
                     const SignalBudget& budget) {
  FmcwFrame frame;
  const auto policy =
      options.refuse_folding ? signal::FoldingPolicy::refuse : signal::FoldingPolicy::count;
  frame.warnings = signal::folding_warnings(signal::count_folding(radar.waveform, paths, policy));
  const SamplesShown shown = shown_by(radar, options, products);
  const double echo_W = sum_W(paths);
  const double phase_noise_rad =
      signal::phase_noise_rms_rad(options.line_width_Hz, strongest_delay_s(paths));
  for (int stage = 0; stage < radar.waveform.stages(); ++stage) {
    frame.beats.push_back(synthesise(radar, stage, paths, frame));
    const auto number = static_cast<std::uint64_t>(frame_number) *
                            static_cast<std::uint64_t>(radar.waveform.stages()) +
                        static_cast<std::uint64_t>(stage);
    const FmcwReceiver receiver{
        .noise_figure = sensor.receiver.noise_figure,
        .sample_rate_Hz = radar.waveform.sample_rate_Hz[static_cast<std::size_t>(stage)],
        .complex_baseband = !options.real,
        .phase_noise_rad = phase_noise_rad,
        .adc_bits = options.adc_bits};
    const core::EffectPlan plan =
        receiver_plan(budget, shown, sensor, receiver, echo_W, frame.beats.back());
    keep_larger(plan, frame.plan);
    // A stage more is another stretch of time: draws of its own.
    frame.clipped +=
        receive(radar.array, receiver, plan, {options.seed, 0, number}, frame.beats.back());
  }
  if (frame.plan.runs(core::EffectId::phase_noise)) frame.phase_noise_rad = phase_noise_rad;
  make_maps(radar, products, frame);
  return frame;
}

}  // namespace fanbeam::session
