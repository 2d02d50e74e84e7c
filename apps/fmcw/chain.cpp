#include "apps/fmcw/chain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/detection/clusters.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/keystone_synthesis.h"
#include "signal/transform/angle_transform.h"
#include "signal/transform/slot_compensation.h"
#include "signal/waveform/folding.h"

namespace fanbeam::apps {
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

signal::FloatCube synthesise(const FmcwRadar& radar, int stage,
                             const std::vector<signal::ScatterPath>& paths, FmcwFrame& frame) {
  const signal::Frame layout = signal::make_frame(radar.waveform, stage, radar.array);
  check_work(layout, paths.size());
  if (layout.uniform && paths.size() > kMostDirectPaths) {
    signal::KeystoneBeat beat = signal::keystone_beat(radar.waveform, stage, radar.array, paths);
    if (stage == 0) {
      frame.keystone = true;
      frame.synthesis_error = beat.estimated_error;
    }
    return std::move(beat.cube);
  }
  const signal::SynthesisOptions fine;
  if (stage == 0) frame.synthesis_error = fine.relative_error;
  return signal::synthesise_beat(radar.waveform, stage, radar.array, paths, fine);
}

double strongest_delay_s(const std::vector<signal::ScatterPath>& paths) {
  const auto strongest =
      std::max_element(paths.begin(), paths.end(), [](const auto& a, const auto& b) {
        return std::norm(a.amplitude_sqrtW) < std::norm(b.amplitude_sqrtW);
      });
  return strongest == paths.end() ? 0.0 : 2.0 * strongest->range_m / core::kSpeedOfLight_mps;
}

// The converter's range is set to the frame's largest sample.
std::size_t convert(int bits, signal::FloatCube& beat) {
  float largest = 0.0F;
  for (const std::complex<float>& sample : beat.values)
    largest = std::max({largest, std::abs(sample.real()), std::abs(sample.imag())});
  if (!(largest > 0.0F)) return 0;
  return signal::quantise(signal::Quantiser{bits, static_cast<double>(largest)}, beat);
}

void receive(const FmcwRadar& radar, const sensors::Sensor& sensor, int stage, int number,
             const FmcwOptions& options, FmcwFrame& frame, signal::FloatCube& beat) {
  const double fs_Hz = radar.waveform.sample_rate_Hz[static_cast<std::size_t>(stage)];
  // A stage more is another stretch of time: draws of its own.
  const core::RandomKey key{options.seed + static_cast<std::uint64_t>(stage), 0,
                            static_cast<std::uint32_t>(number)};
  if (frame.phase_noise_rad > 0.0)
    signal::apply_phase_noise(
        signal::PhaseNoise{.rms_rad = frame.phase_noise_rad, .sample_rate_Hz = fs_Hz, .key = key},
        beat);
  signal::add_receiver_noise(
      radar.array,
      {signal::noise_sample_W(sensor.receiver.noise_figure, fs_Hz), !options.real, key}, beat);
  if (options.adc_bits > 0) frame.clipped += convert(options.adc_bits, beat);
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

void make_maps(const FmcwRadar& radar, FmcwFrame& frame) {
  signal::FloatCube range_speed;
  signal::range_doppler(frame.beats[0], radar.detection.transform, range_speed);
  frame.range_doppler = signal::range_doppler_map(range_speed, signal::Projection::sum);
  signal::compensate_slots(range_speed, radar.array);
  const int cells = std::max(kAngleCells, range_speed.shape.channels);
  signal::angle_transform(range_speed, {.kind = signal::WindowKind::taylor}, cells, frame.cube);
  frame.azimuths_rad =
      signal::angle_cell_azimuths_rad(cells, radar.pitch_m, radar.waveform.wavelength_m());
  frame.range_azimuth = signal::range_azimuth_map(frame.cube, signal::Projection::max);
  frame.grid = grid_of(radar);
  frame.top_view = signal::top_view(frame.range_azimuth, frame.azimuths_rad,
                                    radar.axes.range_step_m, frame.grid);
  frame.detections = signal::detect(frame.beats[0], radar.array, radar.timing, radar.detection);
  frame.clusters = signal::detection_clusters(frame.detections, {});
}

}  // namespace

FmcwFrame fmcw_frame(const FmcwRadar& radar, const sensors::Sensor& sensor,
                     const std::vector<signal::ScatterPath>& paths, int frame_number,
                     const FmcwOptions& options, bool with_maps) {
  FmcwFrame frame;
  const auto policy =
      options.refuse_folding ? signal::FoldingPolicy::refuse : signal::FoldingPolicy::count;
  frame.warnings = signal::folding_warnings(signal::count_folding(radar.waveform, paths, policy));
  if (options.line_width_Hz > 0.0)
    frame.phase_noise_rad =
        signal::phase_noise_rms_rad(options.line_width_Hz, strongest_delay_s(paths));
  for (int stage = 0; stage < radar.waveform.stages(); ++stage) {
    frame.beats.push_back(synthesise(radar, stage, paths, frame));
    receive(radar, sensor, stage, frame_number, options, frame, frame.beats.back());
  }
  if (with_maps) make_maps(radar, frame);
  return frame;
}

}  // namespace fanbeam::apps
