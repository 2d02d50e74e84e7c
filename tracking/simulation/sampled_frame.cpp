#include "tracking/simulation/sampled_frame.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/random.h"
#include "signal/detection/map_peaks.h"
#include "signal/receiver/link_budget.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/waveform/factories.h"
#include "tracking/simulation/directions.h"
#include "tracking/simulation/measurement_bound.h"
#include "tracking/simulation/triangle_beats.h"

namespace fanbeam::tracking {
namespace {

constexpr double kFalseAlarm = 1e-7;
constexpr double kCoarseSigma_m = 0.3, kCoarseSigma_mps = 0.3, kGate = 4.0;
constexpr double kMostSpeed_mps = 70.0;
// azimuth_peak steps over a quarter of a beamwidth at most, up to here.
constexpr double kWidestArray_wavelengths = 1250.0;
// Side lobes of neighbours, the bend of beats, the direction of a moving target.
constexpr double kSystematic_m = 0.005, kSystematic_mps = 0.005, kSystematic_rad = 5e-4;
constexpr int kCoarse = 0, kFine = 1;  // stages

std::vector<signal::ScatterPath> paths_of(const core::HighwayScenario& scenario,
                                          const core::HighwayRadar& radar, double time_s,
                                          const core::RandomKey& key, std::uint64_t run) {
  signal::Link link;
  link.transmitted_W = radar.transmitted_W;
  link.transmit_gain = radar.transmit_gain;
  link.receive_gain = radar.receive_gain;
  link.wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  link.loss = radar.loss;
  std::vector<signal::ScatterPath> paths;
  for (std::size_t i = 0; i < scenario.targets.size(); ++i) {
    const core::HighwayTarget& target = scenario.targets[i];
    const core::HighwayTruth truth = truth_at(target, scenario.radar_speed_mps, radar, time_s);
    if (!truth.in_view || is_suppressed(target, time_s)) continue;
    const double power_W = signal::received_power_W(link, truth.range_m, target.cross_section_m2) /
                           radar.array_elements;
    const double turn = core::uniform_from(core::random_words(key, (run << 32U) + i, 10)[0]);
    signal::ScatterPath path;
    path.range_m = truth.range_m;
    path.radial_speed_mps = truth.range_rate_mps;
    path.azimuth_rad = truth.azimuth_rad;
    path.amplitude_sqrtW = std::polar(std::sqrt(power_W), 2.0 * core::kPi * turn);
    paths.push_back(path);
  }
  return paths;
}

struct Pair {
  double misfit = kGate * kGate;
  std::size_t up = 0, down = 0;
  signal::RangeSpeed place;
  bool found = false;
};

// The pair of beats that fits a coarse place best, if any does and better than `best`.
void try_place(const signal::TriangleModel& model, const SampledBeats& beats,
               const signal::RangeSpeed& coarse, Pair& best) {
  for (std::size_t i = 0; i < beats.up.size(); ++i)
    for (std::size_t j = 0; j < beats.down.size(); ++j) {
      const signal::RangeSpeed pair = solve(model, {beats.up[i].Hz, beats.down[j].Hz});
      const double misfit =
          std::pow((pair.range_m - coarse.range_m) / kCoarseSigma_m, 2) +
          std::pow((pair.radial_speed_mps - coarse.radial_speed_mps) / kCoarseSigma_mps, 2);
      if (misfit < best.misfit) best = {misfit, i, j, pair, true};
    }
}

// Two coarse detections of one pair and one direction are one target.
bool seen_before(const std::vector<Pair>& pairs, const std::vector<RadarMeasurement>& result,
                 const Pair& pair, double azimuth_rad, double apart) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].up == pair.up && pairs[i].down == pair.down &&
        std::abs(std::sin(result[i].azimuth_rad) - std::sin(azimuth_rad)) < apart)
      return true;
  return false;
}

}  // namespace

SampledRadar::SampledRadar(const core::HighwayRadar& radar) : radar_(radar) {
  const double aperture = (radar.array_elements - 1) * radar.array_pitch_wavelengths;
  if (!(aperture <= kWidestArray_wavelengths))
    core::throw_input_error(core::ErrorClass::limit, "radar.virtual_ula_spacing_wavelengths",
                            radar.array_pitch_wavelengths,
                            "an array at most 1250 wavelengths long to measure from samples");
  signal::TwoStageParameters parameters;
  parameters.coarse.frequency_Hz = parameters.fine.frequency_Hz = radar.centre_frequency_Hz;
  parameters.coarse.bandwidth_Hz = parameters.fine.bandwidth_Hz = radar.bandwidth_Hz;
  const core::HighwayWaveforms& told = radar.waveforms;
  parameters.fine.ramp_s = radar_.ramp_s = told.fine_ramp_s;
  parameters.fine.sample_rate_Hz = told.fine_rate_Hz;
  parameters.coarse.ramp_s = parameters.coarse.interval_s = told.coarse_chirp_s;
  parameters.coarse.chirps = told.coarse_chirps;
  parameters.coarse.sample_rate_Hz = told.coarse_rate_Hz;
  waveform_ = signal::two_stage(parameters);
  array_ = signal::line_array(1, radar.array_elements,
                              radar.array_pitch_wavelengths * waveform_.wavelength_m());
  const auto chirps = signal::stage_segments(waveform_, kCoarse);
  const int samples = signal::samples_per_segment(waveform_, kCoarse);
  slope_Hz_per_s_ = chirps[0].slope_Hz_per_s;
  repetition_s_ = chirps[1].start_s - chirps[0].start_s;
  axes_ = signal::range_doppler_axes(waveform_.sample_rate_Hz[kCoarse], slope_Hz_per_s_,
                                     repetition_s_, waveform_.wavelength_m(), samples,
                                     static_cast<int>(chirps.size()));
  const double cell_m = core::kSpeedOfLight_mps / (2.0 * radar.bandwidth_Hz);
  transform_.range_window =
      transform_.doppler_window = {.kind = signal::WindowKind::chebyshev, .level_dB = 60.0};
  transform_.kept_range_cells =
      std::clamp(static_cast<int>(std::ceil(1.02 * radar.most_range_m / cell_m)), 2, samples);
  cfar_ = {.kind = signal::CfarKind::ordered_statistic,
           .design_probability = kFalseAlarm,
           .along_columns = {3, 6, false}};
}

// Of the array's beam, between half powers.
double SampledRadar::beam_sine() const {
  return 0.8859 / (radar_.array_elements * radar_.array_pitch_wavelengths);
}

// The strongest first.
std::vector<SampledRadar::Coarse> SampledRadar::coarse_of(const signal::FloatCube& samples) const {
  signal::FloatCube cube;
  signal::range_doppler(samples, transform_, cube);
  const signal::PowerMap map = signal::range_doppler_map(cube, signal::Projection::sum);
  const auto elements_m = signal::virtual_elements_m(array_);
  std::vector<Coarse> result;
  for (const auto& peak : signal::map_peaks(map, signal::cfar_detections(map, cfar_), true)) {
    std::vector<std::complex<double>> snapshot;
    for (int channel = 0; channel < cube.shape.channels; ++channel)
      snapshot.emplace_back(cube.at(channel, peak.cell.row, peak.cell.column));
    for (const double azimuth_rad :
         directions_rad(snapshot, elements_m, axes_.wavelength_m, beam_sine()))
      result.push_back({axes_.range_m(peak.column, axes_.doppler_Hz(peak.row)),
                        axes_.speed_mps(peak.row), azimuth_rad, peak.cell.power_W});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Coarse& a, const Coarse& b) { return a.power_W > b.power_W; });
  return result;
}

std::vector<RadarMeasurement> SampledRadar::measure(const core::HighwayScenario& scenario,
                                                    std::uint64_t seed, std::uint32_t run,
                                                    int frame) const {
  // One stream of samples for each run: seed, run and frame in one key.
  core::RandomKey key{seed + (std::uint64_t{run} << 32U), core::kStreamHighway,
                      static_cast<std::uint32_t>(frame)};
  const auto paths = paths_of(scenario, radar_, frame * radar_.frame_s, key, run);
  const auto received = [&](int stage) {
    signal::FloatCube samples = signal::synthesise_beat(waveform_, stage, array_, paths);
    const double rate_Hz = waveform_.sample_rate_Hz[static_cast<std::size_t>(stage)];
    const core::RandomKey own{key.seed ^ (static_cast<std::uint64_t>(stage) << 63U), 0, key.frame};
    signal::add_receiver_noise(
        array_, {signal::noise_sample_W(radar_.noise_figure, rate_Hz), true, own}, samples);
    return samples;
  };
  const signal::TriangleModel model = signal::triangle_model(waveform_, kFine);
  const double fine_rate_Hz = waveform_.sample_rate_Hz[kFine];
  const SampledBeats beats =
      triangle_beats(received(kFine), model, fine_rate_Hz,
                     signal::noise_sample_W(radar_.noise_figure, fine_rate_Hz));
  const std::vector<Coarse> detections = coarse_of(received(kCoarse));
  const auto chirps = signal::stage_segments(waveform_, kCoarse);
  const double middle_s = 0.5 * (chirps.front().middle_s() + chirps.back().middle_s());
  const double folds_Hz = 1.0 / repetition_s_;
  std::vector<Pair> pairs;
  std::vector<RadarMeasurement> result;
  for (const Coarse& one : detections) {
    Pair best;
    for (const int fold : {0, -1, 1}) {
      const double more_Hz = fold * folds_Hz;
      const double speed_mps = one.speed_mps + 0.5 * waveform_.wavelength_m() * more_Hz;
      if (std::abs(speed_mps) > kMostSpeed_mps) continue;
      const double range_m =
          one.range_m - core::kSpeedOfLight_mps / (2.0 * slope_Hz_per_s_) * more_Hz;
      try_place(model, beats, {range_m - speed_mps * middle_s, speed_mps}, best);
    }
    if (!best.found || seen_before(pairs, result, best, one.azimuth_rad, 0.5 * beam_sine()))
      continue;
    const double ratio =
        std::min(beats.up[best.up].signal_to_noise, beats.down[best.down].signal_to_noise);
    const MeasurementBound bound = bound_at(radar_, ratio, one.azimuth_rad);
    const double wider = std::sqrt(beats.variance_ratio);
    pairs.push_back(best);
    result.push_back({best.place.range_m, best.place.radial_speed_mps, one.azimuth_rad,
                      wider * bound.range_sigma_m, wider * bound.range_rate_sigma_mps,
                      bound.azimuth_sigma_rad, kSystematic_m, kSystematic_mps, kSystematic_rad});
  }
  return result;
}

}  // namespace fanbeam::tracking
