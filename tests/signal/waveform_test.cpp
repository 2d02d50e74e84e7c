// Figures of waveforms against section 1 of the FMCW formulas: reference radar 76 GHz, 250 MHz.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/waveform/doppler.h"
#include "signal/waveform/factories.h"
#include "signal/waveform/figures.h"
#include "signal/waveform/folding.h"
#include "signal/waveform/m_sequence.h"
#include "tests/signal/default_waveform.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

constexpr double kHundredKmh_mps = 100.0 / 3.6;

struct RampRow {
  double ramp_s, slope, bin_Hz, Hz_per_m, beat_100_Hz, beat_200_Hz, doppler_bins, as_m, up_Hz,
      down_Hz;
};
// 100 m and 200 m at rest; then 100 m closing at 100 km/h, all at mid ramp.
constexpr RampRow kRampRows[] = {
    {22.0 / 3.0 * 1e-6, 3.409091e13, 136363.6, 227430.08, 22.743008e6, 45.486015e6, 0.1033, 0.0619,
     22.728924e6, 22.757091e6},
    {2e-3, 1.25e11, 500.0, 833.910238, 83391.024, 166782.048, 28.168, 16.889, 69307.21, 97474.84},
    {20e-3, 1.25e10, 50.0, 83.391024, 8339.102, 16678.205, 281.68, 168.889, -5744.71, 22422.92}};

}  // namespace

TEST_CASE("Beats of the reference radar have their sign and size", "[waveform]") {
  for (const RampRow& row : kRampRows) {
    TriangleParameters parameters;
    parameters.ramp_s = row.ramp_s;
    parameters.sample_rate_Hz = 2.5 * row.beat_200_Hz;
    const Waveform waveform = triangle(parameters);
    const StageFigures stage = figures(waveform)[0];
    const Segment& up = waveform.segments[0];
    const Segment& down = waveform.segments[1];
    INFO("ramp " << row.ramp_s);
    CHECK(stage.slope_Hz_per_s == Approx(row.slope).epsilon(1e-7));
    CHECK(stage.frequency_bin_Hz == Approx(row.bin_Hz).epsilon(1e-6));
    CHECK(stage.beat_Hz_per_m == Approx(row.Hz_per_m).epsilon(1e-7));
    CHECK(beat_Hz(up, 100.0, 0.0) == Approx(row.beat_100_Hz).epsilon(1e-7));
    CHECK(beat_Hz(up, 200.0, 0.0) == Approx(row.beat_200_Hz).epsilon(1e-7));
    const double doppler_Hz = 2.0 * kHundredKmh_mps / waveform.wavelength_m();
    CHECK(doppler_Hz * row.ramp_s == Approx(row.doppler_bins).epsilon(1e-3));
    CHECK(*stage.coupling_m_per_mps * kHundredKmh_mps == Approx(row.as_m).epsilon(1e-3));
    CHECK(beat_Hz(up, 100.0, -kHundredKmh_mps) == Approx(row.up_Hz).epsilon(3e-6));
    CHECK(-beat_Hz(down, 100.0, -kHundredKmh_mps) == Approx(row.down_Hz).epsilon(3e-6));
  }
}

TEST_CASE("Range cell and half-power width are told apart", "[waveform]") {
  const StageFigures stage = figures(chirp_sequence({}))[0];
  CHECK(*stage.range_cell_m == Approx(0.599585).epsilon(1e-6));
  CHECK(*stage.rectangular_width_m == Approx(0.5311).epsilon(1e-4));
  CHECK(*stage.taylor_width_m == Approx(0.7117).epsilon(1e-4));
}

TEST_CASE("A chirp sequence of 256 x 20 us has the figures of the two-stage radar", "[waveform]") {
  const StageFigures stage = figures(two_stage({}))[0];
  CHECK(*stage.speed_cell_mps == Approx(0.38522).epsilon(2e-5));
  CHECK(*stage.unambiguous_speed_mps == Approx(49.308).epsilon(1e-5));
  CHECK(*stage.unambiguous_range_m == Approx(239.8).epsilon(1e-3));
  CHECK(stage.beat_Hz_per_m * 200.0 == Approx(16.678e6).epsilon(1e-4));
  ChirpSequenceParameters real;
  real.complex_baseband = false;
  CHECK(*figures(chirp_sequence(real))[0].unambiguous_range_m ==
        Approx(0.5 * *stage.unambiguous_range_m));
  ChirpSequenceParameters three;
  three.slots = 3;
  CHECK(*figures(chirp_sequence(three))[0].unambiguous_speed_mps ==
        Approx(49.308 / 3).epsilon(1e-5));
}

TEST_CASE("The coded flat stretch measures speed and an unambiguous phase range", "[waveform]") {
  const Waveform waveform = coded_triangle({});
  REQUIRE(waveform.stages() == 3);
  const StageFigures flat = figures(waveform)[1];
  CHECK(flat.segments == 127);
  CHECK(*flat.speed_cell_mps == Approx(0.986).epsilon(1e-3));
  CHECK(*flat.unambiguous_range_m == Approx(214.137).epsilon(3e-6));
  CHECK(360.0 / *flat.unambiguous_range_m == Approx(1.68116).epsilon(1e-5));
}

TEST_CASE("Every off-peak correlation of an m-sequence is -1", "[waveform]") {
  for (const int degree : {3, 7, 10, 12}) {
    const std::vector<int> code = m_sequence(degree);
    const std::size_t length = code.size();
    REQUIRE(length == (std::size_t{1} << degree) - 1);
    for (std::size_t lag = 1; lag < length; lag += length / 7) {
      int sum = 0;
      for (std::size_t i = 0; i < length; ++i) sum += code[i] * code[(i + lag) % length];
      CHECK(sum == -1);
      if (degree == 7)
        CHECK(20.0 * std::log10(std::abs(sum) / static_cast<double>(length)) ==
              Approx(-42.08).margin(0.005).epsilon(0.0));
    }
  }
  CHECK_THROWS_AS(m_sequence(2), core::InputError);
  CHECK_THROWS_AS(m_sequence(13), core::InputError);
}

TEST_CASE("Time of flight of a microsecond is 149.896229 m", "[waveform]") {
  PulsedParameters parameters;
  parameters.interval_s = 1e-6;
  const StageFigures stage = figures(pulsed(parameters))[0];
  CHECK(*stage.unambiguous_range_m == Approx(149.896229).epsilon(1e-12));
  CHECK(*stage.range_cell_m == Approx(1.49896229).epsilon(1e-12));
}

TEST_CASE("Doppler is exact and keeps its sign", "[waveform]") {
  // 100 km/h as the figure has it, rounded to 27.7777778 m/s.
  CHECK(doppler_shift_Hz(-27.7777778, 76e9) == Approx(14083.818669).margin(1e-6).epsilon(0.0));
  CHECK(doppler_shift_Hz(-3.0 / 3.6, 76e9) == Approx(422.514522).margin(2e-6).epsilon(0.0));
  // 1 km/h, and the 3.6 m/s that a source text takes for it.
  CHECK(doppler_shift_Hz(-1.0 / 3.6, 76e9) == Approx(140.84).margin(0.005).epsilon(0.0));
  CHECK(doppler_shift_Hz(-3.6, 76e9) == Approx(1825.26).margin(0.005).epsilon(0.0));
  CHECK(doppler_shift_Hz(kHundredKmh_mps, 76e9) < 0.0);
}

TEST_CASE("G08: Doppler at approach speed, and half the pulse rate goes to the negative border",
          "[waveform]") {
  CHECK(doppler_shift_Hz(-70.0, 35e9) == Approx(16344.64).margin(0.01).epsilon(0.0));
  const double half_Hz = 5000.0;
  CHECK(fold(half_Hz, half_Hz) == -half_Hz);
  CHECK(fold(-half_Hz, half_Hz) == -half_Hz);
  CHECK(fold(3.0 * half_Hz, half_Hz) == -half_Hz);
  CHECK(fold(std::nextafter(half_Hz, 0.0), half_Hz) > 0.0);
  CHECK(fold_positive(-1e-320, 1.0) < 1.0);
}

TEST_CASE("Ranges and speeds beyond the unambiguous are counted with what they read, or refused",
          "[waveform]") {
  const Waveform waveform = chirp_sequence({});
  const StageFigures stage = figures(waveform)[0];
  std::vector<ScatterPath> paths(3);
  paths[0].range_m = 100.0;
  paths[1].range_m = *stage.unambiguous_range_m + 10.0;
  paths[2].range_m = 50.0;
  paths[2].radial_speed_mps = *stage.unambiguous_speed_mps;
  const std::vector<StageFolding> folding = count_folding(waveform, paths);
  CHECK(folding[0].folded_ranges == 1);
  CHECK(folding[0].farthest_reads_m == Approx(10.0).epsilon(1e-9));
  CHECK(folding[0].folded_speeds == 1);
  CHECK(folding[0].fastest_reads_mps == Approx(-*stage.unambiguous_speed_mps));
  const std::vector<core::Problem> warnings = folding_warnings(folding);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0].code == "W-FOLDED");
  CHECK(warnings[0].expected.find("reads 10") != std::string::npos);
  CHECK_THROWS_AS(count_folding(waveform, paths, FoldingPolicy::refuse), core::InputError);
  const double wavelength_m = waveform.wavelength_m();
  const Array wide = line_array(3, 4, 2.0 * wavelength_m);
  CHECK(folded_azimuths(wide, wavelength_m, paths).empty());
  paths[1].azimuth_rad = std::asin(0.4);
  const std::vector<core::Problem> sideways = folded_azimuths(wide, wavelength_m, paths);
  REQUIRE(sideways.size() == 1);
  CHECK(sideways[0].code == "W-FOLDED");
  CHECK(sideways[0].field == "azimuth");
  CHECK(sideways[0].expected.find("reads -5.739") != std::string::npos);  // asin(0.4 - 0.5)
  CHECK(folded_azimuths(line_array(3, 4, 0.5 * wavelength_m), wavelength_m, paths).empty());
  CHECK_THROWS_AS(folded_azimuths(wide, wavelength_m, paths, FoldingPolicy::refuse),
                  core::InputError);
  paths.resize(1);
  CHECK(folding_warnings(count_folding(waveform, paths, FoldingPolicy::refuse)).empty());
}

TEST_CASE("Real samples cannot tell the negative beat of a slow ramp", "[waveform]") {
  TriangleParameters parameters;
  parameters.ramp_s = 20e-3;
  parameters.complex_baseband = false;
  ScatterPath path;
  path.range_m = 100.0;
  path.radial_speed_mps = -kHundredKmh_mps;
  CHECK(count_folding(triangle(parameters), {path})[0].negative_beats == 1);
  parameters.complex_baseband = true;
  CHECK(count_folding(triangle(parameters), {path})[0].negative_beats == 0);
}

TEST_CASE("Every kind has a name and valid defaults", "[waveform]") {
  for (const WaveformKind kind : all_waveform_kinds()) {
    CHECK(waveform_kind(name(kind)) == kind);
    const Waveform waveform = tests::default_waveform(kind);
    CHECK(waveform.kind == kind);
    CHECK(figures(waveform).size() == static_cast<std::size_t>(waveform.stages()));
  }
  CHECK_FALSE(waveform_kind("sawteeth"));
}

TEST_CASE("Parameters of waveforms are refused by name", "[waveform]") {
  const auto refused = [](const auto& make, const std::string& field) {
    try {
      make();
    } catch (const core::InputError& error) {
      return error.problems()[0].field.find(field) != std::string::npos;
    }
    return false;
  };
  ChirpSequenceParameters chirps;
  chirps.bandwidth_Hz = std::nan("");
  CHECK(refused([&] { chirp_sequence(chirps); }, "bandwidth_Hz"));
  chirps = {};
  chirps.interval_s = 10e-6;
  CHECK(refused([&] { chirp_sequence(chirps); }, "interval_s"));
  chirps = {};
  chirps.chirps = 0;
  CHECK(refused([&] { chirp_sequence(chirps); }, "chirps"));
  chirps = {};
  chirps.sample_rate_Hz = 1e3;
  CHECK(refused([&] { chirp_sequence(chirps); }, "sample_rate_Hz"));
  TwoSlopesParameters slopes;
  slopes.second_ramp_s = slopes.first.ramp_s;
  CHECK(refused([&] { two_slopes(slopes); }, "second_ramp_s"));
  Waveform waveform = triangle({});
  waveform.segments[1].start_s = waveform.segments[0].start_s;
  CHECK(refused([&] { check(waveform); }, "start_s"));
}

TEST_CASE("Two chirps of one slope are no triangle: one of each transmitter tells no speed",
          "[waveform]") {
  ChirpSequenceParameters once;
  once.chirps = 1;
  once.slots = 2;
  const StageFigures stage = figures(chirp_sequence(once)).at(0);
  CHECK_FALSE(stage.speed_cell_mps);
  CHECK_FALSE(stage.unambiguous_speed_mps);
  CHECK(figures(triangle({})).at(0).speed_cell_mps);
}

TEST_CASE("An echo at rest has no shift, and no sign of one", "[waveform]") {
  CHECK_FALSE(std::signbit(doppler_shift_Hz(0.0, 76e9)));
}

TEST_CASE("All that folds is refused together", "[waveform]") {
  ScatterPath far;
  far.range_m = 1e5;
  far.radial_speed_mps = 1e3;
  CHECK_THROWS_WITH(count_folding(chirp_sequence({}), {far}, FoldingPolicy::refuse),
                    Catch::Contains("stage 0 range") && Catch::Contains("stage 0 radial speed"));
}
