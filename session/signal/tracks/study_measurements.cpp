// Buffer and noise figure against the error of one measurement, from samples.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/random.h"
#include "session/signal/tracks/study.h"
#include "signal/detection/tone.h"
#include "signal/pairing/triangle.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/waveform/factories.h"
#include "tracking/metrics/error_statistics.h"
#include "tracking/simulation/measurement_bound.h"

namespace fanbeam::session {
namespace {

constexpr double kRange_m = 100.0, kSpeed_mps = -100.0 / 3.6, kSection_m2 = 10.0;
constexpr double kHeight_m = 0.5;  // of antenna and car above the road
constexpr int kRuns = 100;
// An error beyond this is a wrong peak, not noise about the right one.
constexpr double kOutlier_m = 1.0;

// The radar as it measures here: bounds are those of its triangle.
core::HighwayRadar by_triangles(core::HighwayRadar radar) {
  radar.ramp_s = radar.waveforms.triangle_ramp_s;
  return radar;
}

// Measures a car by single triangles; turnarounds lie a triangle apart.
class TriangleRadar {
 public:
  explicit TriangleRadar(const core::HighwayRadar& radar) : radar_(radar) {
    signal::TriangleParameters parameters;
    parameters.frequency_Hz = radar.centre_frequency_Hz;
    parameters.bandwidth_Hz = radar.bandwidth_Hz;
    parameters.ramp_s = radar_.ramp_s;
    parameters.sample_rate_Hz = radar_.waveforms.triangle_rate_Hz;
    waveform_ = signal::triangle(parameters);
    model_ = signal::triangle_model(waveform_, 0);
  }

  double period_s() const { return waveform_.duration_s(); }

  // The car is at `range_m` at the turnaround. A road with that reflection coefficient adds the ways by
  // its mirror image: there, back, and both.
  signal::RangeSpeed measure(double range_m, std::uint64_t seed, int run, int triangle,
                             double reflection = 0.0) const {
    const auto bound = tracking::measurement_bound(radar_, kSection_m2, range_m, 0.0);
    const double rate_Hz = waveform_.sample_rate_Hz[0];
    const double noise_W = signal::noise_sample_W(radar_.noise_figure, rate_Hz);
    const core::RandomKey key{seed + (static_cast<std::uint64_t>(run) << 32U), 0,
                              static_cast<std::uint32_t>(triangle)};
    const double samples = radar_.ramp_s * rate_Hz;
    const double turn = core::uniform_from(core::random_words(key, 0, 1)[0]);
    const std::complex<double> amplitude =
        std::polar(std::sqrt(bound.signal_to_noise * noise_W / samples), 2.0 * core::kPi * turn);
    const double mirrored_m = std::hypot(range_m, 2.0 * kHeight_m);
    std::vector<signal::ScatterPath> paths = {{range_m, kSpeed_mps, 0.0, 0.0, amplitude}};
    if (reflection != 0.0) {
      paths.push_back(
          {0.5 * (range_m + mirrored_m), kSpeed_mps, 0.0, 0.0, 2.0 * reflection * amplitude});
      paths.push_back({mirrored_m, kSpeed_mps, 0.0, 0.0, reflection * reflection * amplitude});
    }
    const signal::Array array = signal::line_array(1, 1, 0.5 * waveform_.wavelength_m());
    auto cube = signal::synthesise_beat_double(waveform_, 0, array, paths, {1e-8});
    signal::add_receiver_noise(array, {noise_W, true, key}, cube);
    std::array<double, 2> beat_Hz{};
    for (int ramp = 0; ramp < 2; ++ramp) {
      const auto* first = &cube.at(0, ramp, 0);
      const double count = cube.shape.samples;
      const double bin = signal::strongest_tone({first, first + cube.shape.samples}).bin;
      beat_Hz[static_cast<std::size_t>(ramp)] =
          (bin - count * std::floor(bin / count + 0.5)) * rate_Hz / count;
    }
    return solve(model_, {beat_Hz[0], beat_Hz[1]});
  }

 private:
  core::HighwayRadar radar_;
  signal::Waveform waveform_;
  signal::TriangleModel model_;
};

struct Errors {
  tracking::MeanSquare range_m, speed_mps, uncompensated_m;
  int outliers = 0;
  double ms = 0.0;  // of processing one buffer, its synthesis included
};

// In thousandths; a dash, and no point of a plot, where no right peak is left.
std::string rms_cell(const tracking::MeanSquare& errors, int decimals) {
  return figure_cell(errors.count(), 1e3 * errors.rms(), decimals);
}

double rms_point(const tracking::MeanSquare& errors) {
  return errors.count() > 0 ? 1e3 * errors.rms() : std::nan("");
}

// Mean over a buffer of triangles, which belongs to its middle; also as if it belonged to its end,
// when it comes out.
Errors errors_of(const core::HighwayRadar& radar, int triangles, std::uint64_t seed) {
  const TriangleRadar measuring(radar);
  Errors errors;
  const auto start = std::chrono::steady_clock::now();
  for (int run = 0; run < kRuns; ++run) {
    double speed_mps = 0.0, range_m = 0.0;
    for (int k = 0; k < triangles; ++k) {
      const double from_middle_s = measuring.period_s() * (k - 0.5 * (triangles - 1));
      const auto one = measuring.measure(kRange_m + kSpeed_mps * from_middle_s, seed, run, k);
      // What the car moves until the middle cancels: triangles lie symmetrically about it.
      range_m += one.range_m / triangles;
      speed_mps += one.radial_speed_mps / triangles;
    }
    if (std::abs(range_m - kRange_m) > kOutlier_m) {
      ++errors.outliers;
      continue;
    }
    const double to_end_s = 0.5 * measuring.period_s() * triangles;
    errors.range_m.add(range_m - kRange_m);
    errors.speed_mps.add(speed_mps - kSpeed_mps);
    errors.uncompensated_m.add(range_m - (kRange_m + kSpeed_mps * to_end_s));
  }
  errors.ms =
      1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kRuns;
  return errors;
}

}  // namespace

StudyPart study_buffer(const core::HighwayRadar& given, std::uint64_t seed) {
  const core::HighwayRadar radar = by_triangles(given);
  StudyPart part;
  part.text =
      "| ramps in the buffer | range error, mm rms | bound, mm | taken as of its end, mm rms | "
      "speed error, mm/s rms | bound, mm/s | wrong peaks of 100 | measuring takes, ms | "
      "processing, ms |\n|---|---|---|---|---|---|---|---|---|\n";
  Plot plot;
  plot.title = "One car at 100 m, 100 km/h closing: error over the ramps in the buffer";
  plot.x = {fmt::format("ramps of {:.6g} ms in the buffer", 1e3 * radar.ramp_s), true, 1.5, 80.0};
  plot.y = {"error of range (mm rms)", true, {}, {}};
  plot.series = {{"measured, of its middle", {}, {}, PlotSeries::Style::line_points},
                 {"bound", {}, {}, PlotSeries::Style::dashed_line},
                 {"measured, taken as of its end", {}, {}, PlotSeries::Style::line_points}};
  const auto bound = tracking::measurement_bound(radar, kSection_m2, kRange_m, 0.0);
  for (const int triangles : {1, 2, 4, 8, 16, 32}) {
    const Errors errors = errors_of(radar, triangles, seed);
    const double root = std::sqrt(static_cast<double>(triangles));
    const double ramps = 2.0 * triangles;
    part.text += fmt::format("| {} | {} | {:.3f} | {} | {} | {:.3f} | {} | {:.0f} | {:.2f} |\n",
                             2 * triangles, rms_cell(errors.range_m, 3),
                             1e3 * bound.range_sigma_m / root, rms_cell(errors.uncompensated_m, 0),
                             rms_cell(errors.speed_mps, 3), 1e3 * bound.range_rate_sigma_mps / root,
                             errors.outliers, 1e3 * radar.ramp_s * ramps, errors.ms);
    const double values[] = {rms_point(errors.range_m), 1e3 * bound.range_sigma_m / root,
                             rms_point(errors.uncompensated_m)};
    for (std::size_t i = 0; i < 3; ++i) {
      plot.series[i].x.push_back(ramps);
      plot.series[i].y.push_back(values[i]);
    }
  }
  part.plots.emplace_back("buffer", plot);
  return part;
}

StudyPart study_noise_figure(const core::HighwayRadar& given, std::uint64_t seed) {
  const core::HighwayRadar radar = by_triangles(given);
  StudyPart part;
  part.text =
      "| noise figure, dB | signal to noise, dB | range error, mm rms | bound, mm | speed error, "
      "mm/s rms | bound, mm/s | wrong peaks of 100 |\n|---|---|---|---|---|---|---|\n";
  Plot plot;
  plot.title = "The same of one triangle: error over the noise figure";
  plot.x = {"noise figure (dB)", false, 0.0, 52.0};
  plot.y = {"error of range (mm rms)", true, {}, {}};
  plot.series = {{"measured", {}, {}, PlotSeries::Style::line_points},
                 {"bound", {}, {}, PlotSeries::Style::dashed_line},
                 {"wrong peaks (of 100)", {}, {}, PlotSeries::Style::points}};
  for (const double figure_dB : {0.1, 1.0, 4.5, 10.0, 20.0, 30.0, 40.0, 44.0, 46.0, 48.0, 50.0}) {
    core::HighwayRadar noisy = radar;
    noisy.noise_figure = core::power_from_dB(figure_dB);
    const Errors errors = errors_of(noisy, 1, seed);
    const auto bound = tracking::measurement_bound(noisy, kSection_m2, kRange_m, 0.0);
    part.text +=
        fmt::format("| {:g} | {:.1f} | {} | {:.2f} | {} | {:.2f} | {} |\n", figure_dB,
                    core::dB_from_power(bound.signal_to_noise, -300.0), rms_cell(errors.range_m, 2),
                    1e3 * bound.range_sigma_m, rms_cell(errors.speed_mps, 2),
                    1e3 * bound.range_rate_sigma_mps, errors.outliers);
    const double values[] = {rms_point(errors.range_m), 1e3 * bound.range_sigma_m,
                             errors.outliers > 0 ? errors.outliers : std::nan("")};
    for (std::size_t i = 0; i < 3; ++i) {
      plot.series[i].x.push_back(figure_dB);
      plot.series[i].y.push_back(values[i]);
    }
  }
  part.plots.emplace_back("noise-figure", plot);
  return part;
}

namespace {

// Ranges spread evenly, so that peaks and nulls of the two rays come in their shares.
Errors errors_over_ranges(const core::HighwayRadar& radar, double reflection, std::uint64_t seed) {
  constexpr double kNearest_m = 60.0, kFarthest_m = 140.0;
  constexpr int kRangesOf = 400;
  const TriangleRadar measuring(radar);
  Errors errors;
  for (int run = 0; run < kRangesOf; ++run) {
    const double range_m = kNearest_m + (kFarthest_m - kNearest_m) * (run + 0.5) / kRangesOf;
    const auto one = measuring.measure(range_m, seed, run, 0, reflection);
    if (std::abs(one.range_m - range_m) > kOutlier_m) {
      ++errors.outliers;
      continue;
    }
    errors.range_m.add(one.range_m - range_m);
    errors.speed_mps.add(one.radial_speed_mps - kSpeed_mps);
  }
  errors.outliers = errors.outliers * 100 / kRangesOf;
  return errors;
}

}  // namespace

StudyPart study_reflections(const core::HighwayRadar& given, std::uint64_t seed) {
  const core::HighwayRadar radar = by_triangles(given);
  constexpr std::array kRoads = {0.0, -0.7, -1.0};
  StudyPart part;
  part.text =
      "| noise figure, dB | no road: range, mm rms; speed, mm/s rms; wrong, % | road, -0.7 | road, "
      "-1 "
      "|\n|---|---|---|---|\n";
  Plot range, speed;
  range.title = "A car at 60 to 140 m over the road's reflection: error of range";
  speed.title = "The same: error of speed";
  range.x = speed.x = {"noise figure (dB)", false, 0.0, 52.0};
  range.y = {"error of range (mm rms)", true, {}, {}};
  speed.y = {"error of speed (mm/s rms)", true, {}, {}};
  for (Plot* plot : {&range, &speed})
    plot->series = {{"no reflection", {}, {}, PlotSeries::Style::line_points},
                    {"coefficient -0.7", {}, {}, PlotSeries::Style::line_points},
                    {"coefficient -1", {}, {}, PlotSeries::Style::line_points}};
  for (const double figure_dB : {0.1, 1.0, 4.5, 10.0, 20.0, 30.0, 40.0, 44.0, 48.0}) {
    core::HighwayRadar noisy = radar;
    noisy.noise_figure = core::power_from_dB(figure_dB);
    part.text += fmt::format("| {:g} |", figure_dB);
    for (std::size_t i = 0; i < kRoads.size(); ++i) {
      const Errors errors = errors_over_ranges(noisy, kRoads[i], seed);
      part.text += fmt::format(" {}; {}; {} |", rms_cell(errors.range_m, 2),
                               rms_cell(errors.speed_mps, 2), errors.outliers);
      range.series[i].x.push_back(figure_dB);
      range.series[i].y.push_back(rms_point(errors.range_m));
      speed.series[i].x.push_back(figure_dB);
      speed.series[i].y.push_back(rms_point(errors.speed_mps));
    }
    part.text += "\n";
  }
  part.plots.emplace_back("reflections-range", range);
  part.plots.emplace_back("reflections-speed", speed);
  return part;
}

}  // namespace fanbeam::session
