// The receiving chain of fanbeam fmcw inside the program: draws of noise, and what is left out.
#include <cmath>

#include "renderer/plan/plan.h"
#include "sensors/sensor_file.h"
#include "session/signal/chain.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::session;

namespace {

sensors::Sensor automotive() {
  core::ProblemList problems;
  sensors::Sensor sensor =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/automotive-76.toml", problems);
  REQUIRE_FALSE(problems.has_errors());
  return sensor;
}

FmcwSettings of_16_chirps() {
  FmcwSettings options;
  REQUIRE(std::string(kWaveformNumbers[11].option) == "--chirps");
  options.numbers[11] = 16.0;
  return options;
}

signal::ScatterPath echo_at_40_m() {
  signal::ScatterPath path;
  path.range_m = 40.0;
  path.amplitude_sqrtW = 1e-6;
  return path;
}

// |mean of a conj(b)| over the first samples, 1 for equal rows.
double correlation(const signal::FloatCube& a, const signal::FloatCube& b) {
  const int count = std::min(a.shape.samples, b.shape.samples);
  std::complex<double> sum = 0.0;
  double a_W = 0.0, b_W = 0.0;
  for (int n = 0; n < count; ++n) {
    const std::complex<double> x(a.at(0, 0, n)), y(b.at(0, 0, n));
    sum += x * std::conj(y);
    a_W += std::norm(x);
    b_W += std::norm(y);
  }
  return std::abs(sum) / std::sqrt(a_W * b_W);
}

}  // namespace

TEST_CASE("The noise of a stage is that of no other stage, frame or seed", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options;
  options.waveform = "two-slopes";
  const FmcwRadar radar = fmcw_radar(options, sensor);
  std::vector<signal::FloatCube> beats;
  for (const std::uint64_t seed : {5U, 6U})
    for (const int frame : {0, 1, 2}) {
      options.seed = seed;
      for (signal::FloatCube& beat : fmcw_frame(radar, {}, frame, options, {"beat"}).beats)
        beats.push_back(std::move(beat));
    }
  REQUIRE(beats.size() == 12);
  REQUIRE(beats[0].shape.samples >= 500);
  // Independent rows of 500 samples: 0.25 is above five standard deviations.
  for (std::size_t i = 0; i < beats.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      INFO("cubes " << k << " and " << i);
      CHECK(correlation(beats[i], beats[k]) < 0.25);
    }
}

TEST_CASE("A frame holds what its products need and nothing else", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  const FmcwRadar radar = fmcw_radar(options, sensor);
  const signal::ScatterPath path = echo_at_40_m();
  const auto made = [&](const std::set<std::string>& products) {
    return fmcw_frame(radar, {path}, 0, options, products);
  };
  const FmcwFrame beat = made({"beat"});
  CHECK_FALSE(beat.found);
  CHECK(beat.range_doppler.values_W.empty());
  CHECK(beat.cube.values.empty());
  const FmcwFrame list = made({"detections"});
  REQUIRE(list.found);
  REQUIRE(list.found->detections.size() == 1);
  CHECK(list.found->detections[0].range_m == Approx(40.0).margin(0.05).epsilon(0.0));
  CHECK(list.found->clusters.size() == 1);
  CHECK(list.cube.values.empty());
  const FmcwFrame cube = made({"cube"});
  CHECK_FALSE(cube.found);
  CHECK(cube.cube.shape.channels == static_cast<int>(radar.azimuths_rad.size()));
  CHECK(cube.range_azimuth.values_W.empty());
  const FmcwFrame view = made({"top-view"});
  CHECK(view.found);
  CHECK_FALSE(view.top_view.values_W.empty());
}

TEST_CASE("Receiver effects of zero magnitude, and pruned ones, change no byte", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  const FmcwRadar radar = fmcw_radar(options, sensor);
  const signal::ScatterPath path = echo_at_40_m();
  const auto made = [&](const char* wishes) {
    SignalBudget budget;
    if (*wishes != 0)
      budget.wishes = renderer::parse_effect_wishes(wishes, renderer::Touches::samples);
    return fmcw_frame(radar, {path}, 0, options, {"range-doppler"}, budget);
  };
  const FmcwFrame plain = made("");
  CHECK(made("+phase-noise,+quantiser").beats[0].values == plain.beats[0].values);
  options.adc_bits = 20;
  options.line_width_Hz = 1e-9;
  const FmcwFrame pruned = made("");
  CHECK(pruned.beats[0].values == plain.beats[0].values);
  const FmcwFrame forced = made("+phase-noise,+quantiser");
  CHECK(forced.beats[0].values != plain.beats[0].values);
  // Mean powers: within the budget of 0.25 grey of 60 / 255 dB.
  double pruned_W = 0.0, forced_W = 0.0;
  for (const double power_W : pruned.range_doppler.values_W) pruned_W += power_W;
  for (const double power_W : forced.range_doppler.values_W) forced_W += power_W;
  CHECK(std::abs(10.0 * std::log10(forced_W / pruned_W)) < 0.25 * 60.0 / 255.0);
  options.adc_bits = 3;  // steps longer than the noise's standard deviation
  CHECK(made("").plan.runs(core::EffectId::quantiser));
  CHECK_FALSE(made("-quantiser").plan.runs(core::EffectId::quantiser));
}

TEST_CASE("A fixed full scale saturates, and is free of samples below it", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  options.adc_bits = 12;
  const FmcwRadar radar = fmcw_radar(options, sensor);
  signal::ScatterPath path = echo_at_40_m();
  path.amplitude_sqrtW = 1e-3;  // 0 dBm at the port is 31.6 times as much
  const auto made = [&] { return fmcw_frame(radar, {path}, 0, options, {"beat"}); };
  options.adc_full_scale_dBm = -20.0;
  CHECK(made().clipped == 0);
  options.adc_full_scale_dBm = -36.0206;  // half the amplitude
  const FmcwFrame clipped = made();
  // A tone's part is beyond half its amplitude two thirds of the time.
  CHECK(static_cast<double>(clipped.clipped) /
            (2.0 * static_cast<double>(clipped.beats[0].values.size())) ==
        Approx(2.0 / 3.0).epsilon(0.0).margin(0.01));
  const double full_scale = std::pow(10.0, 0.05 * (-36.0206 - 30.0));
  double largest = 0.0;
  for (const auto& sample : clipped.beats[0].values)
    largest = std::max(largest, static_cast<double>(std::abs(sample.real())));
  CHECK(largest == Approx(full_scale).epsilon(1e-6));
}

TEST_CASE("What a channel's gain lets clip, or lifts over the noise, is not pruned", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  options.adc_bits = 14;
  options.adc_full_scale_dBm = -55.0;  // 35 dB over the echo
  options.line_width_Hz = 1e-4;
  const FmcwRadar radar = fmcw_radar(options, sensor);
  const signal::ScatterPath path = echo_at_40_m();
  const auto made = [&] { return fmcw_frame(radar, {path}, 0, options, {"range-doppler"}); };
  const FmcwFrame even = made();
  CHECK_FALSE(even.plan.runs(core::EffectId::quantiser));
  CHECK(even.clipped == 0);
  options.gain_errors_dB.assign(12, 0.0);
  options.gain_errors_dB[0] = 40.0;
  const FmcwFrame uneven = made();
  CHECK(uneven.plan.runs(core::EffectId::quantiser));
  CHECK(uneven.clipped > 0);
  // The pedestal's bound goes with the power while both are small.
  const auto bound_dB = [](const FmcwFrame& frame) {
    for (const core::EffectDecision& one : frame.plan.decisions)
      if (one.effect == core::EffectId::phase_noise) return one.bound_dB;
    return 0.0;
  };
  REQUIRE(bound_dB(even) > 0.0);
  REQUIRE(bound_dB(uneven) < 0.1);
  CHECK(bound_dB(uneven) == Approx(1e4 * bound_dB(even)).epsilon(0.02));
}

TEST_CASE("Errors of channels are in the samples and bend the beam", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  const FmcwRadar radar = fmcw_radar(options, sensor);
  const signal::ScatterPath path = echo_at_40_m();
  const auto made = [&] { return fmcw_frame(radar, {path}, 0, options, {"detections"}); };
  const FmcwFrame good = made();
  options.gain_errors_dB.assign(12, 0.0);
  options.gain_errors_dB[3] = 6.0;
  for (int i = 0; i < 12; ++i) options.phase_errors_rad.push_back(-0.3 * i);  // looks like an angle
  const FmcwFrame bad = made();
  REQUIRE(good.found->detections.size() == 1);
  REQUIRE(!bad.found->detections.empty());
  CHECK(good.found->detections[0].azimuth_rad == Approx(0.0).epsilon(0.0).margin(1e-3));
  CHECK(std::sin(bad.found->detections[0].azimuth_rad) == Approx(0.3 / core::kPi).epsilon(0.02));
  options.phase_errors_rad.pop_back();
  CHECK_THROWS_AS(fmcw_radar(options, sensor), core::InputError);
}

TEST_CASE("A window over the channels weighs beams and changes no detection", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options = of_16_chirps();
  const FmcwRadar radar = fmcw_radar(options, sensor);
  signal::ScatterPath path = echo_at_40_m();
  path.azimuth_rad = 0.2;
  const auto made = [&] {
    return fmcw_frame(radar, {path}, 0, options, {"detections", "range-azimuth"});
  };
  const FmcwFrame tapered = made();
  options.angle_window = {};
  const FmcwFrame even = made();
  REQUIRE(tapered.found->detections.size() == 1);
  REQUIRE(even.found->detections.size() == 1);
  CHECK(even.found->detections[0].azimuth_rad == tapered.found->detections[0].azimuth_rad);
  CHECK(even.found->detections[0].power_W == tapered.found->detections[0].power_W);
  CHECK(even.range_azimuth.values_W != tapered.range_azimuth.values_W);
}

TEST_CASE("An array at two heights measures elevation", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options;
  options.numbers[11] = 64.0;
  const double half_m = 0.5 * core::kSpeedOfLight_mps / sensor.waveform.frequency_Hz;
  options.transmitters_m = {{0.0, 0.0, 0.0}, {0.0, 4.0 * half_m, half_m}};
  for (int i = 0; i < 4; ++i) options.receivers_m.emplace_back(0.0, i * half_m, 0.0);
  const FmcwRadar radar = fmcw_radar(options, sensor);
  CHECK_FALSE(radar.line);
  signal::ScatterPath path;
  path.range_m = 40.0;
  path.azimuth_rad = 0.2;
  path.elevation_rad = 0.1;
  path.amplitude_sqrtW = 1e-6;
  const FmcwFrame frame = fmcw_frame(radar, {path}, 0, options, {"detections", "range-azimuth"});
  REQUIRE(frame.found->detections.size() == 1);
  CHECK(frame.found->detections[0].azimuth_rad == Approx(0.2).epsilon(0.0).margin(2e-3));
  CHECK(frame.found->detections[0].elevation_rad == Approx(0.1).epsilon(0.0).margin(4e-3));
  CHECK_FALSE(frame.range_azimuth.values_W.empty());
  options.angle_method = signal::AngleMethod::music;
  CHECK_THROWS_AS(fmcw_radar(options, sensor), core::InputError);
}

TEST_CASE("A ramp with too few samples for ranges is told as that, not as too few chirps",
          "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options;
  options.waveform = "chirp-sequence";
  const auto told = [&](double rate_MHz) -> std::string {
    options.numbers[2] = rate_MHz;
    options.numbers[8] = 0.1;  // us
    try {
      fmcw_radar(options, sensor);
    } catch (const core::InputError& error) {
      const core::Problem& problem = error.problems().at(0);
      return problem.field + " = " + problem.value + ": " + problem.expected;
    }
    return "taken";
  };
  CHECK(told(10.0) == "--sample-rate = 1 in a ramp: 2 samples or more");
  CHECK(told(20.0) == "taken");
  // Real ones hold every range twice.
  options.real = true;
  CHECK(told(30.0) == "--sample-rate = 3 in a ramp: 4 samples or more");
  CHECK(told(40.0) == "taken");
}

TEST_CASE("One chirp has samples, and no maps or detections", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  FmcwSettings options;
  options.numbers[11] = 1.0;
  const FmcwRadar radar = fmcw_radar(options, sensor);
  CHECK_FALSE(radar.maps);
  CHECK_THROWS_WITH(check_has_maps(radar), Catch::Contains("2 chirps or more"));
  const FmcwFrame frame = fmcw_frame(radar, {}, 0, options, {"beat"});
  REQUIRE(frame.beats.size() == 1);
  CHECK(frame.beats[0].shape.channels == 12);
  CHECK(frame.beats[0].shape.chirps == 1);
  CHECK_FALSE(frame.found);
  options.numbers[11] = 2.0;
  CHECK(fmcw_radar(options, sensor).maps);
}

// Two wavelengths apart: azimuths beyond 14.5 deg look like nearer ones. Detections had the direction of any of four lobes.
TEST_CASE("Detections of a sparse line are where its cube has them, and what folds is told",
          "[fmcw]") {
  FmcwSettings options;
  options.numbers[11] = 64.0;
  options.pitch_wavelengths = 2.0;
  signal::ScatterPath path = echo_at_40_m();
  for (const auto method : {signal::AngleMethod::beamforming, signal::AngleMethod::music}) {
    options.angle_method = method;
    const FmcwRadar radar = fmcw_radar(options, automotive());
    for (const double azimuth_rad : {-0.2, 0.0, 0.173, 0.4}) {
      path.azimuth_rad = azimuth_rad;
      const FmcwFrame frame = fmcw_frame(radar, {path}, 0, options, {"detections"});
      INFO(signal::name(method) << ", " << azimuth_rad);
      REQUIRE(frame.found->detections.size() == 1);
      const double sine = std::remainder(std::sin(azimuth_rad), 0.5);
      CHECK(std::sin(frame.found->detections[0].azimuth_rad) ==
            Approx(sine).epsilon(0.0).margin(2e-3));
      CHECK(frame.warnings.size() == (azimuth_rad > 0.3 ? 1 : 0));
    }
    CHECK(to_string(fmcw_frame(radar, {path}, 0, options, {"detections"}).warnings.at(0))
              .find("W-FOLDED azimuth") != std::string::npos);
  }
  options.refuse_folding = true;
  CHECK_THROWS_AS(fmcw_frame(fmcw_radar(options, automotive()), {path}, 0, options, {"detections"}),
                  core::InputError);
}

TEST_CASE("False alarms are as many as asked for, in turn and at once, by every detector",
          "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  for (const int slots : {1, 3})
    for (const signal::CfarKind kind :
         {signal::CfarKind::ordered_statistic, signal::CfarKind::cell_averaging,
          signal::CfarKind::greatest_of, signal::CfarKind::smallest_of}) {
      FmcwSettings options;
      options.waveform = "chirp-sequence";
      options.numbers[2] = 20.0;  // MHz
      options.numbers[11] = 128.0;
      options.numbers[12] = slots;
      options.cfar = kind;
      options.false_alarm_probability = 1e-4;
      const FmcwRadar radar = fmcw_radar(options, sensor);
      // Local maxima alone are detections: of exceedances, which come in neighbours, hardly fewer at this rate.
      std::size_t found = 0;
      constexpr int kFrames = 24;
      for (int frame = 0; frame < kFrames; ++frame)
        found += fmcw_frame(radar, {}, frame, options, {"detections"}).found->detections.size();
      const double cells = kFrames * 128.0 * radar.detection.transform.kept_range_cells;
      const double expected = cells * options.false_alarm_probability;
      INFO(signal::name(kind) << ", " << slots << " slots: " << found << " for " << expected);
      // Four standard deviations and a tenth of the calibration and the edges; two of five may be neighbours.
      CHECK(static_cast<double>(found) < 1.1 * expected + 4.0 * std::sqrt(expected));
      CHECK(static_cast<double>(found) > 0.6 * expected - 4.0 * std::sqrt(expected));
    }
}

TEST_CASE("Samples reach the sensor's last range cell whatever bandwidth is asked for", "[fmcw]") {
  core::ProblemList problems;
  const sensors::Sensor sensor =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", problems);
  REQUIRE_FALSE(problems.has_errors());
  for (const double bandwidth_MHz : {10.0, 22.473, 225.0}) {
    FmcwSettings options;
    options.numbers[1] = bandwidth_MHz;
    const FmcwRadar radar = fmcw_radar(options, sensor);
    const int samples = signal::samples_per_segment(radar.waveform, 0);
    INFO(bandwidth_MHz << " MHz: " << samples << " samples");
    CHECK(radar.axes.range_step_m * samples >= sensor.range.maximum_m());
    CHECK(radar.detection.transform.kept_range_cells < samples);
  }
}
