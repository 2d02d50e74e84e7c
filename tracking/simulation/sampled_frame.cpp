#include "tracking/simulation/sampled_frame.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/errors.h"
#include "core/random.h"
#include "signal/angle/angle_peak.h"
#include "signal/detection/cfar_calibration.h"
#include "signal/detection/map_peaks.h"
#include "signal/receiver/link_budget.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/waveform/factories.h"
#include "tracking/simulation/directions.h"
#include "tracking/simulation/measurement_bound.h"
#include "tracking/simulation/simulation_private.h"
#include "tracking/simulation/triangle_beats.h"

namespace fanbeam::tracking {
namespace {

constexpr double kFalseAlarm = 1e-7;
constexpr double kSideLobes_dB = 60.0;
constexpr double kMostSpeed_mps = 70.0;
// azimuth_peak steps over a quarter of a beamwidth at most, up to here.
constexpr double kWidestArray_wavelengths = 1250.0;
constexpr int kCoarse = 0, kFine = 1;  // stages

// A target that comes through the radar while it looks has no path to both ends.
bool is_ahead(const signal::Waveform& waveform, const core::HighwayTruth& truth) {
  const double first_s = waveform.segments.front().start_s;
  return std::min(truth.range_m + truth.range_rate_mps * first_s,
                  truth.range_m + truth.range_rate_mps * (first_s + waveform.duration_s())) > 0.0;
}

std::vector<signal::ScatterPath> paths_of(const core::HighwayScenario& scenario,
                                          const core::HighwayRadar& radar,
                                          const signal::Waveform& waveform, double time_s,
                                          const Draws& draws, const core::RandomKey& key,
                                          std::uint64_t run) {
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
    if (!truth.in_view || is_suppressed(target, time_s) || !is_ahead(waveform, truth)) continue;
    const double section_m2 = target.cross_section_m2 * draws.fluctuation(target.fluctuation, i);
    if (!(section_m2 > 0.0)) continue;
    const double power_W =
        signal::received_power_W(link, truth.range_m, section_m2) / radar.array_elements;
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

// Along range, of cells that are sums over the channels of an array.
signal::CfarSettings detector(const signal::Window& window, int samples, int channels) {
  signal::CfarSettings cfar = {.kind = signal::CfarKind::ordered_statistic,
                               .design_probability = kFalseAlarm,
                               .along_columns = {3, 6, false}};
  const signal::CfarCalibration calibration =
      signal::calibrated_cfar(cfar, {signal::window_weights(window, samples), samples, {}, 0},
                              std::min(channels, signal::kMostLooks));
  if (!calibration.covered())
    core::throw_input_error(core::ErrorClass::range, "samples of a coarse chirp", samples,
                            "more, for cells of noise around a target's");
  cfar.design_probability = calibration.design_probability;
  cfar.mean_estimate = calibration.mean_estimate;
  return cfar;
}

// Of every range, over all speeds.
std::vector<double> strongest_of_ranges_W(const signal::PowerMap& map) {
  std::vector<double> strongest(static_cast<std::size_t>(map.columns), 0.0);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      double& most_W = strongest[static_cast<std::size_t>(column)];
      most_W = std::max(most_W, map.at(row, column));
    }
  return strongest;
}

// Side lobes of a strong echo lie at all speeds of its range, of which the reference cells, at other ranges, know nothing.
bool over_side_lobes(const signal::CfarCell& cell, double strongest_W) {
  const double side_W = core::power_from_dB(-kSideLobes_dB) * strongest_W;
  return cell.margin * cell.background_W > cell.background_W + side_W;
}

// Of what neighbours leave beside a wave: its share of the energy.
constexpr double kCoarseLeft = 2e-4;

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
  fine_ = signal::triangle_model(waveform_, kFine);
  const auto chirps = signal::stage_segments(waveform_, kCoarse);
  const int samples = signal::samples_per_segment(waveform_, kCoarse);
  slope_Hz_per_s_ = chirps[0].slope_Hz_per_s;
  repetition_s_ = chirps[1].start_s - chirps[0].start_s;
  axes_ = signal::range_doppler_axes(waveform_.sample_rate_Hz[kCoarse], slope_Hz_per_s_,
                                     repetition_s_, waveform_.wavelength_m(), samples,
                                     static_cast<int>(chirps.size()));
  const double cell_m = core::kSpeedOfLight_mps / (2.0 * radar.bandwidth_Hz);
  transform_.range_window = transform_.doppler_window = {
      .kind = signal::WindowKind::chebyshev, .level_dB = kSideLobes_dB, .symmetric = true};
  transform_.kept_range_cells =
      std::clamp(static_cast<int>(std::ceil(1.02 * radar.most_range_m / cell_m)), 2, samples);
  cfar_ = detector(transform_.range_window, samples, radar.array_elements);
}

bool SampledRadar::shows(const core::HighwayTruth& truth) const {
  const signal::BeatPair beats = predict(fine_, {truth.range_m, truth.range_rate_mps});
  return truth.range_m <= axes_.range_step_m * transform_.kept_range_cells &&
         std::abs(truth.range_rate_mps) <= kMostSpeed_mps &&
         std::abs(std::sin(truth.azimuth_rad)) <=
             signal::unambiguous_sine(signal::virtual_elements_m(array_), axes_.wavelength_m) &&
         std::max(std::abs(beats.up_Hz), std::abs(beats.down_Hz)) <
             0.5 * waveform_.sample_rate_Hz[kFine];
}

double SampledRadar::most_speed_mps() { return kMostSpeed_mps; }

// Of the array's beam, between half powers.
double SampledRadar::beam_sine() const {
  return 0.8859 / (radar_.array_elements * radar_.array_pitch_wavelengths);
}

// The strongest first.
std::vector<SampledRadar::Coarse> SampledRadar::coarse_of(const signal::FloatCube& samples) const {
  signal::FloatCube cube;
  signal::range_doppler(samples, transform_, cube);
  const signal::PowerMap map = signal::range_doppler_map(cube, signal::Projection::sum);
  const std::vector<double> strongest = strongest_of_ranges_W(map);
  const auto elements_m = signal::virtual_elements_m(array_);
  std::vector<Coarse> result;
  for (const auto& peak : signal::map_peaks(map, signal::cfar_detections(map, cfar_), true)) {
    if (!over_side_lobes(peak.cell, strongest[static_cast<std::size_t>(peak.cell.column)]))
      continue;
    std::vector<std::complex<double>> snapshot;
    for (int channel = 0; channel < cube.shape.channels; ++channel)
      snapshot.emplace_back(cube.at(channel, peak.cell.row, peak.cell.column));
    const std::vector<double> directions =
        directions_rad(snapshot, elements_m, axes_.wavelength_m, beam_sine(),
                       peak.cell.background_W / cube.shape.channels);
    const bool lone =
        directions.size() == 1 && is_lone_wave(snapshot, elements_m, axes_.wavelength_m,
                                               directions[0], kCoarseLeft, peak.cell.background_W);
    const std::vector<double> sigmas =
        direction_sigmas_rad(snapshot, directions, radar_.array_pitch_wavelengths,
                             peak.cell.background_W / cube.shape.channels);
    for (std::size_t i = 0; i < directions.size(); ++i)
      result.push_back({axes_.range_m(peak.column, axes_.doppler_Hz(peak.row)),
                        axes_.speed_mps(peak.row), directions[i], sigmas[i], peak.cell.power_W,
                        directions.size(), lone});
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
  const auto paths = paths_of(scenario, radar_, waveform_, frame * radar_.frame_s,
                              Draws(seed, run, frame), key, run);
  const auto received = [&](int stage) {
    signal::FloatCube samples = signal::synthesise_beat(waveform_, stage, array_, paths);
    const double rate_Hz = waveform_.sample_rate_Hz[static_cast<std::size_t>(stage)];
    const core::RandomKey own{key.seed ^ (static_cast<std::uint64_t>(stage) << 63U), 0, key.frame};
    signal::add_receiver_noise(
        array_, {signal::noise_sample_W(radar_.noise_figure, rate_Hz), true, own}, samples);
    return samples;
  };
  const signal::TriangleModel& model = fine_;
  const double fine_rate_Hz = waveform_.sample_rate_Hz[kFine];
  const std::vector<Coarse> detections = coarse_of(received(kCoarse));
  std::vector<std::vector<signal::RangeSpeed>> places;  // of each, one for every fold
  std::vector<signal::RangeSpeed> all;
  for (const Coarse& one : detections) {
    places.push_back(folded(one));
    all.insert(all.end(), places.back().begin(), places.back().end());
  }
  const SampledBeats beats =
      triangle_beats(received(kFine), model, fine_rate_Hz,
                     signal::noise_sample_W(radar_.noise_figure, fine_rate_Hz), all,
                     {signal::virtual_elements_m(array_), axes_.wavelength_m,
                      radar_.array_pitch_wavelengths, beam_sine()});
  std::vector<Found> found;
  const std::vector<Pair> bests = best_pairs(model, beats, places, detections);
  for (std::size_t i = 0; i < detections.size(); ++i)
    if (bests[i].found) add(apart(model, beats, bests, i, detections[i]), found);
  // Beats that no place has taken: another target in the cell of one that has.
  for (std::size_t i = 0; i < detections.size(); ++i)
    for (const signal::RangeSpeed& place : places[i]) {
      const std::vector<Pair> left =
          fitting(model, left_over(beats, found), {place}, detections[i]);
      if (!left.empty() && agree(beats.up[left[0].up], beats.down[left[0].down]))
        add(apart(model, beats, {left[0]}, 0, detections[i]), found);
    }
  tell_shared(beats, found);
  std::vector<RadarMeasurement> result;
  for (const Found& one : found) result.push_back(measured(beats, one));
  return result;
}

// At the turnaround of the triangle.
std::vector<signal::RangeSpeed> SampledRadar::folded(const Coarse& one) const {
  const double middle_s = signal::middle_s(signal::stage_segments(waveform_, kCoarse));
  std::vector<signal::RangeSpeed> places;
  const double fold_mps = 0.5 * waveform_.wavelength_m() / repetition_s_;
  const int most = static_cast<int>(std::ceil((kMostSpeed_mps + fold_mps) / fold_mps));
  for (int k = 0; k <= 2 * most; ++k) {  // 0, -1, 1, -2, 2 ...
    const int fold = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
    const double more_Hz = fold / repetition_s_;
    const double speed_mps = one.speed_mps + fold * fold_mps;
    if (std::abs(speed_mps) > kMostSpeed_mps) continue;
    const double range_m =
        one.range_m - core::kSpeedOfLight_mps / (2.0 * slope_Hz_per_s_) * more_Hz;
    places.push_back({range_m - speed_mps * middle_s, speed_mps});
  }
  return places;
}

}  // namespace fanbeam::tracking
