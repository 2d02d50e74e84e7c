// Radar files, and the radars that are made of what is taken.
#include "session/signal/radar_file.h"

#include "session/signal/radar.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    session::FmcwSettings settings;
    session::read_radar_text(text, "radar.toml", settings, problems);
    if (problems.has_errors()) return;
    const auto window_holds = [](const signal::Window& window) {
      return signal::window_of(signal::name(window)).has_value();
    };
    fuzz::must(window_holds(settings.range_window) && window_holds(settings.angle_window),
               "windows that can be named");
    // A detector of many cells takes seconds to calibrate, many segments take memory: neither is the reader's.
    const int cells = (2 * (settings.cfar_guard.range + settings.cfar_training.range) + 1) *
                      (2 * (settings.cfar_guard.doppler + settings.cfar_training.doppler) + 1);
    settings.false_alarm_probability = 1e-3;
    if (cells > 9 || settings.transmitters * settings.receivers > 16 ||
        settings.transmitters_m.size() * settings.receivers_m.size() > 16)
      return;
    settings.numbers[11] = settings.numbers[11].value_or(1.0) > 8.0 ? 8.0 : settings.numbers[11];
    const session::FmcwRadar radar = session::fmcw_radar(settings);
    fuzz::must(radar.array.channels() >= 1, "a channel or more");
    fuzz::must(radar.noise_figure >= 1.0, "a noise figure");
  });
  return 0;
}
