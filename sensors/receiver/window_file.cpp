#include "sensors/receiver/window_file.h"

#include "core/decibel.h"

namespace fanbeam::sensors {

void read_window(core::ConfigTable& table, Waveform& waveform) {
  using Window = Waveform::Window;
  waveform.window = static_cast<Window>(
      table.choice("window", {"none", "rectangular", "hann", "hamming", "taylor"}, 0));
  if (waveform.window != Window::taylor) return;
  waveform.taylor_side_lobe =
      core::power_from_dB(table.number("taylor_side_lobe_dB", {-80.0, -15.0}, -35.0));
  waveform.taylor_equal_lobes =
      static_cast<int>(table.integer("taylor_equal_lobes", 2, 20, waveform.taylor_equal_lobes));
}

}  // namespace fanbeam::sensors
