// The exact phase of a beat, and what the triangle makes of it.
#include "signal/synthesis/beat_phase.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/pairing/triangle.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/reference.h"
#include "signal/waveform/factories.h"
#include "signal/waveform/figures.h"
#include "tests/signal/slot_phase.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

constexpr double c_mps = core::kSpeedOfLight_mps;

ScatterPath path_at(double range_m, double speed_mps) {
  ScatterPath path;
  path.range_m = range_m;
  path.radial_speed_mps = speed_mps;
  path.amplitude_sqrtW = 1.0;
  return path;
}

// Instantaneous beat at mid segment by a central difference of the exact phase.
double measured_beat_Hz(const Segment& segment, const ScatterPath& path) {
  const double step_s = 1e-5 * segment.duration_s;
  const auto turns = [&](double t_s) {
    const long double range_m =
        path.range_m + static_cast<long double>(path.radial_speed_mps) * (segment.start_s + t_s);
    const long double delay_s = 2.0L * range_m / c_mps;
    return segment.start_frequency_Hz * delay_s +
           segment.slope_Hz_per_s * delay_s * (t_s - 0.5L * delay_s);
  };
  const double middle_s = 0.5 * segment.duration_s;
  return static_cast<double>((turns(middle_s + step_s) - turns(middle_s - step_s)) /
                             (2.0L * step_s));
}

}  // namespace

TEST_CASE("The beat's phase agrees with extended precision to 1e-9 rad", "[beat]") {
  for (const Waveform& waveform : {chirp_sequence({}), triangle({})})
    for (const ScatterPath& path : {path_at(100.0, -27.78), path_at(60.0, 33.3)}) {
      const Segment& segment = waveform.segments.back();
      for (const double t_s : {0.0, 0.3 * segment.duration_s, segment.duration_s}) {
        const double delay_s =
            PathGeometry(path, {}, {}).at(segment.start_s + t_s).length_m / c_mps;
        const long double tau = 2.0L *
                                (static_cast<long double>(path.range_m) +
                                 static_cast<long double>(path.radial_speed_mps) *
                                     (static_cast<long double>(segment.start_s) + t_s)) /
                                c_mps;
        const long double exact =
            segment.start_frequency_Hz * tau + segment.slope_Hz_per_s * tau * (t_s - 0.5L * tau);
        const double turns = beat_turns(waveform, segment, t_s, delay_s);
        CHECK(2.0 * core::kPi * std::abs(static_cast<double>(turns - exact)) < 1e-9);
      }
    }
}

TEST_CASE("G01: a tenth of a millimetre at 3.7 km is 0.1467092 rad", "[beat]") {
  ContinuousParameters parameters;
  parameters.frequency_Hz = 35e9;
  const Waveform waveform = continuous(parameters);
  const auto phase_rad = [&](double range_m) {
    const double delay_s = PathGeometry(path_at(range_m, 0.0), {}, {}).at(0.0).length_m / c_mps;
    return 2.0 * core::kPi * beat_turns(waveform, waveform.segments[0], 0.0, delay_s);
  };
  CHECK(phase_rad(3700.0001) - phase_rad(3700.0) == Approx(0.1467092).margin(1e-6).epsilon(0.0));
  const std::complex<double> ratio =
      reference_beat(waveform, 0, {}, {path_at(3700.0001, 0.0)}).values[0] /
      reference_beat(waveform, 0, {}, {path_at(3700.0, 0.0)}).values[0];
  CHECK(std::arg(ratio) == Approx(0.1467092).margin(1e-6).epsilon(0.0));
}

TEST_CASE("Instantaneous beats follow the closed form at mid ramp and drift by 4 B v / c",
          "[beat]") {
  for (const double ramp_s : {2e-3, 20e-3}) {
    TriangleParameters parameters;
    parameters.ramp_s = ramp_s;
    const Waveform waveform = triangle(parameters);
    for (const Segment& segment : waveform.segments) {
      const ScatterPath path = path_at(100.0, -27.7777777777);
      const double range_m = 100.0 - 27.7777777777 * segment.middle_s();
      CHECK(measured_beat_Hz(segment, path) ==
            Approx(beat_Hz(segment, range_m, -27.7777777777)).margin(2e-3).epsilon(0.0));
    }
  }
}

TEST_CASE("The triangle gives range and speed without the bias of the centre frequency",
          "[beat][pairing]") {
  for (const double ramp_s : {2e-3, 20e-3})
    for (const bool down_first : {false, true})
      for (const ScatterPath& path :
           {path_at(100.0, -27.7777777777), path_at(60.0, -0.833), path_at(150.0, 30.0)}) {
        TriangleParameters parameters;
        parameters.ramp_s = ramp_s;
        parameters.down_first = down_first;
        const Waveform waveform = triangle(parameters);
        const Segment& up = waveform.segments[down_first ? 1 : 0];
        const Segment& down = waveform.segments[down_first ? 0 : 1];
        const BeatPair beats{measured_beat_Hz(up, path), measured_beat_Hz(down, path)};
        const RangeSpeed found = solve(triangle_model(waveform, 0), beats);
        // The difference quotient of the phase is good to some 1e-4 Hz, 1e-7 m/s.
        CHECK(std::abs(found.range_m - path.range_m) < 2e-6);
        CHECK(std::abs(found.radial_speed_mps - path.radial_speed_mps) < 1e-6);
        const double naive_mps = c_mps * (beats.up_Hz + beats.down_Hz) / (4.0 * 76e9);
        CHECK(std::abs(naive_mps - path.radial_speed_mps) ==
              Approx(125e6 / 76e9 * std::abs(path.radial_speed_mps)).epsilon(0.01));
      }
}

TEST_CASE("Prediction and solution of a pair are inverse, with a flat stretch too", "[pairing]") {
  for (const Waveform& waveform : {triangle({}), coded_triangle({})})
    for (const double speed_mps : {-60.0, 0.0, 41.0}) {
      const TriangleModel model = triangle_model(waveform, 0);
      const RangeSpeed back = solve(model, predict(model, {187.3, speed_mps}));
      CHECK(std::abs(back.range_m - 187.3) < 1e-9);
      CHECK(std::abs(back.radial_speed_mps - speed_mps) < 1e-9);
    }
  CHECK_THROWS_AS(triangle_model(chirp_sequence({}), 0), core::InputError);
}

TEST_CASE("Magnitudes of a slow ramp's beats give a wrong target", "[pairing]") {
  TriangleParameters parameters;
  parameters.ramp_s = 20e-3;
  const TriangleModel model = triangle_model(triangle(parameters), 0);
  const RangeSpeed wrong = solve(model, {5744.71, -22422.92});
  CHECK(wrong.range_m == Approx(168.89).margin(0.01).epsilon(0.0));
  CHECK(std::abs(wrong.radial_speed_mps) * 3.6 == Approx(59.2).margin(0.2).epsilon(0.0));
  const RangeSpeed right = solve(model, {-5744.71, -22422.92});
  CHECK(right.range_m == Approx(100.0).margin(0.01).epsilon(0.0));
  CHECK(right.radial_speed_mps * 3.6 == Approx(-100.0).margin(0.2).epsilon(0.0));
}

TEST_CASE("Time division turns the phase by 3.6505 degrees per m/s and 20 us slot", "[beat]") {
  const double wavelength_m = c_mps / 76e9;
  CHECK(tests::slot_phase_rad(1.0, 20e-6, wavelength_m) * 180.0 / core::kPi ==
        Approx(3.6505).margin(1e-4).epsilon(0.0));
  CHECK(tests::slot_phase_rad(100.0 / 3.6, 20e-6, wavelength_m) * 180.0 / core::kPi ==
        Approx(101.40).margin(0.005).epsilon(0.0));

  ChirpSequenceParameters parameters;
  parameters.slots = 2;
  parameters.chirps = 1;
  Array array;  // two transmitters in one place: only the slot differs
  array.transmitters_m = {glm::dvec3(0.0), glm::dvec3(0.0)};
  const DoubleCube cube = reference_beat(chirp_sequence(parameters), 0, array, {path_at(50, 5.0)});
  const double turn_rad = std::arg(cube.at(1, 0, 200) / cube.at(0, 0, 200));
  CHECK(turn_rad == Approx(tests::slot_phase_rad(5.0, 20e-6, wavelength_m)).epsilon(1e-3));
}

TEST_CASE("Virtual elements are half a wavelength apart and a target to the right turns them back",
          "[array]") {
  const double wavelength_m = c_mps / 76e9;
  const Array array = line_array(3, 4, 0.5 * wavelength_m);
  const std::vector<glm::dvec3> elements_m = virtual_elements_m(array);
  REQUIRE(elements_m.size() == 12);
  for (std::size_t i = 1; i < 12; ++i)
    CHECK(elements_m[i].y - elements_m[i - 1].y == Approx(0.5 * wavelength_m));
  Array together = array;
  together.multiplex = Multiplex::simultaneous;
  ScatterPath path = path_at(2000.0, 0.0);
  path.azimuth_rad = 0.2;
  ContinuousParameters parameters;
  parameters.frequency_Hz = 76e9;
  parameters.duration_s = 1e-5;
  const DoubleCube cube = reference_beat(continuous(parameters), 0, together, {path});
  for (int i = 1; i < 12; ++i)
    CHECK(std::arg(cube.at(i, 0, 0) / cube.at(i - 1, 0, 0)) ==
          Approx(-core::kPi * std::sin(0.2)).margin(1e-4).epsilon(0.0));
  CHECK_THROWS_AS(line_array(0, 4, 1e-3), core::InputError);
  CHECK_THROWS_AS(line_array(3, 4, 0.0), core::InputError);
}

TEST_CASE("Paths that are no numbers or reach the array are refused", "[beat]") {
  const Waveform waveform = chirp_sequence({});
  CHECK_THROWS_AS(reference_beat(waveform, 0, {}, {path_at(std::nan(""), 0.0)}), core::InputError);
  CHECK_THROWS_AS(reference_beat(waveform, 0, {}, {path_at(0.1, -60.0)}), core::InputError);
  CHECK_THROWS_AS(reference_beat(waveform, 0, {}, {path_at(10.0, 1e6)}), core::InputError);
  CHECK_THROWS_AS(reference_beat(waveform, 0, line_array(3, 4, 2e-3), {}), core::InputError);
}

TEST_CASE("Samples of all channels together are limited before anything holds them", "[beat]") {
  ContinuousParameters parameters;
  parameters.duration_s = 250.0;  // 2.5e7 samples
  const Waveform waveform = continuous(parameters);
  Array array = line_array(1, 4, 2e-3);
  CHECK_NOTHROW(check_size(waveform, array));
  CHECK(make_frame(waveform, 0, array).shape.count() == 100'000'000);
  array = line_array(1, 5, 2e-3);
  CHECK_THROWS_WITH(check_size(waveform, array), Catch::Contains("E-LIMIT"));
  CHECK_THROWS_WITH(make_frame(waveform, 0, array), Catch::Contains("E-LIMIT"));
  CHECK_THROWS_WITH(reference_beat(waveform, 0, array, {}), Catch::Contains("E-LIMIT"));
}

// The chirps of two stages begin before 0, where starts are rounded: they were taken for uneven, and every path summed
// for every sample.
TEST_CASE("Thousands of chirps before a triangle are as even as a few", "[beat]") {
  TwoStageParameters parameters;
  const auto uniform = [&](int chirps, double ramp_s) {
    parameters.coarse.chirps = chirps;
    parameters.coarse.ramp_s = parameters.coarse.interval_s = ramp_s;
    return make_frame(two_stage(parameters), 0, {}).uniform;
  };
  CHECK(uniform(256, 20e-6));
  CHECK(uniform(2048, 20e-6));
  CHECK(uniform(1000, 50e-6));
  CHECK(uniform(65536, 20e-6));
  Waveform waveform = chirp_sequence({});
  waveform.segments.back().start_s += 1e-9;
  CHECK_FALSE(make_frame(waveform, 0, {}).uniform);
}

TEST_CASE("A pulse's echo from beyond the interval comes in the next one, as in a radar",
          "[beat]") {
  PulsedParameters parameters;  // 10 us: 1499 m
  const Waveform waveform = pulsed(parameters);
  const double interval_m = 0.5 * c_mps * parameters.interval_s;
  const DoubleCube near = reference_beat(waveform, 0, {}, {path_at(2000.0 - interval_m, 0.0)});
  const DoubleCube far = reference_beat(waveform, 0, {}, {path_at(2000.0, 0.0)});
  int lit = 0;
  for (std::size_t i = 0; i < near.values.size(); ++i) {
    CHECK(std::abs(near.values[i]) == Approx(std::abs(far.values[i])));
    lit += std::abs(far.values[i]) > 0.5 ? 1 : 0;
  }
  CHECK(lit == 2 * parameters.pulses);  // 10 ns at 200 MHz
}
