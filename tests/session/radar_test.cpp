// What is wrong with a radar: all of it, in the words of its options.
#include "session/signal/radar.h"

#include <catch2/catch.hpp>

#include "core/errors.h"
#include "sensors/sensor_file.h"
#include "session/signal/chain.h"
#include "session/signal/radar_file.h"
#include "signal/waveform/factories.h"

using namespace fanbeam;
using Catch::Contains;

namespace {

session::FmcwRadar street_radar(const session::FmcwSettings& options) {
  core::ProblemList problems;
  return session::fmcw_radar(
      options, sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/automotive-76.toml", problems));
}

}  // namespace

TEST_CASE("What is wrong with receiver, array, methods and detector is told together", "[radar]") {
  session::FmcwSettings options;
  options.adc_full_scale_dBm = -30.0;
  options.transmitters = 1;
  options.receivers = 2;
  options.gain_errors_dB = {0.0};
  options.angle_method = signal::AngleMethod::music;
  options.unfold = true;
  options.cfar_training = {0, 0};
  CHECK_THROWS_WITH(street_radar(options),
                    Contains("--adc-bits = 0") && Contains("channel errors = 1") &&
                        Contains("angle method = music") && Contains("--unfold") &&
                        Contains("--cfar-training = 0,0"));
}

TEST_CASE("Training cells are refused by the options that make them", "[radar]") {
  session::FmcwSettings options;
  options.cfar_guard = options.cfar_training = {64, 64};
  CHECK_THROWS_WITH(street_radar(options), Contains("E-RANGE --cfar-training = 64,64") &&
                                               Contains("--cfar-guard") && Contains("2000"));
}

TEST_CASE("A line width of 0 beside a table of phase noise is refused in a radar file", "[radar]") {
  core::ProblemList problems;
  session::FmcwSettings settings;
  session::read_radar_text(
      "[receiver]\nline_width_Hz = 0\nphase_noise_offsets_kHz = [100]\n"
      "phase_noise_dBc_per_Hz = [-90]\n",
      "radar.toml", settings, problems);
  REQUIRE(problems.errors() == 1);
  CHECK_THAT(to_string(problems.all()[0]), Contains("receiver.line_width_Hz = 0"));
}

// The whole synthesis came before.
TEST_CASE("Waveforms that hear no other radars are refused before any work", "[radar]") {
  session::FmcwSettings options;
  options.waveform = "sinusoidal";
  const session::FmcwRadar radar = street_radar(options);
  // A path that the synthesis would refuse, were it reached.
  CHECK_THROWS_WITH(
      session::fmcw_frame(radar, {signal::ScatterPath{}}, 0, options, {"beat"}, {}, {{}}),
      Contains("beside interferers"));
}
