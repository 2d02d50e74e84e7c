// Product "spectrum" of fanbeam fmcw against a lone scatterer and the receiver's noise.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "core/effect_plan.h"
#include "sensors/sensor_file.h"
#include "session/signal/receive.h"
#include "session/signal/spectrum.h"
#include "signal/synthesis/beat_synthesis.h"

using namespace fanbeam;

TEST_CASE("A beat spectrum holds a scatterer's power at its range, and the noise", "[fmcw]") {
  for (const bool real : {false, true}) {
    core::ProblemList problems;
    const sensors::Sensor sensor =
        sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/automotive-76.toml", problems);
    session::FmcwSettings options;
    options.numbers[static_cast<std::size_t>(
        std::find_if(
            session::kWaveformNumbers.begin(), session::kWaveformNumbers.end(),
            [](const auto& number) { return std::string_view(number.option) == "--chirps"; }) -
        session::kWaveformNumbers.begin())] = 64.0;
    options.real = real;
    const session::FmcwRadar radar = session::fmcw_radar(options, sensor);
    const double step_m = radar.axes.range_step_m, power_W = 1e-11;
    const signal::ScatterPath path{100.0 * step_m, 0.0, 0.0, 0.0, std::sqrt(power_W)};
    signal::Waveform waveform = radar.waveform;
    waveform.complex_baseband = true;  // the receiver makes them real
    signal::FloatCube beat = signal::synthesise_beat(waveform, 0, radar.array, {path});
    session::FmcwReceiver receiver;
    receiver.noise_figure = sensor.receiver.noise_figure;
    receiver.sample_rate_Hz = radar.waveform.sample_rate_Hz[0];
    receiver.complex_baseband = !real;
    core::EffectPlan plan;
    plan.decisions.push_back({core::EffectId::receiver_noise, true, "asked for"});
    session::receive(radar.array, receiver, plan, {1, 0, 0}, beat);
    const session::BeatSpectrum spectrum = session::beat_spectrum(radar, beat);
    CHECK(spectrum.range_step_m == step_m);
    const auto peak = std::max_element(spectrum.mean_W.begin(), spectrum.mean_W.end());
    CHECK(peak - spectrum.mean_W.begin() == 100);
    CHECK(*peak == Approx(power_W).epsilon(0.02));
    // 79 cells away from the peak, 64 chirps each: three sigma of the mean are some 5 %.
    REQUIRE(spectrum.mean_W.size() >= 199);
    const double mean_W =
        std::accumulate(spectrum.mean_W.begin() + 120, spectrum.mean_W.begin() + 199, 0.0) / 79.0;
    CHECK(mean_W == Approx(spectrum.noise_W).epsilon(0.06));
  }
}

TEST_CASE("A full scale in dBm is that of a tone that just fills the converter, real or complex",
          "[fmcw]") {
  for (const bool real : {false, true})
    for (const double above_dB : {-0.1, 0.1}) {
      const double power_dBm = -40.0;
      session::ReceiverSettings settings;
      settings.adc_bits = 12;
      settings.adc_full_scale_dBm = power_dBm + above_dB;
      const session::FmcwReceiver receiver = session::fmcw_receiver(settings, 1.0, 20e6, !real);
      signal::FloatCube beat({1000, 1, 1});
      const double amplitude = std::pow(10.0, 0.05 * (power_dBm - 30.0));
      for (int n = 0; n < 1000; ++n)
        beat.at(0, 0, n) = static_cast<std::complex<float>>(std::polar(amplitude, 0.777 * n));
      core::EffectPlan plan;
      plan.decisions.push_back({core::EffectId::quantiser, true, "asked for"});
      const std::size_t clipped = session::receive({}, receiver, plan, {1, 0, 0}, beat);
      INFO((real ? "real" : "complex") << ", full scale " << above_dB << " dB above the tone");
      CHECK((clipped > 0) == (above_dB < 0.0));
    }
}
