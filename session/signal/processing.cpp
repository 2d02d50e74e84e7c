#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "core/errors.h"
#include "session/signal/chain.h"
#include "signal/detection/clusters.h"
#include "signal/fourier/window.h"
#include "signal/transform/angle_transform.h"
#include "signal/transform/capon_map.h"
#include "signal/transform/slot_compensation.h"

namespace fanbeam::session {
namespace {

signal::TopViewGrid grid_of(const FmcwRadar& radar) {
  const double reach_m = radar.axes.range_step_m * (radar.detection.transform.kept_range_cells - 1);
  signal::TopViewGrid grid;
  grid.step_m = reach_m / 240.0;
  grid.rows = 241;
  grid.columns = 2 * 120 + 1;  // half as far to either side
  grid.leftmost_m = -120.0 * grid.step_m;
  return grid;
}

constexpr double kMostBeamCells = 1e9;  // 8 GB

// Beams even in the sine of azimuth, at elevation 0.
void form_beams(const FmcwRadar& radar, const ProcessingSettings& settings,
                const signal::FloatCube& range_speed, signal::FloatCube& cube) {
  const double cells = static_cast<double>(range_speed.shape.samples) * range_speed.shape.chirps *
                       static_cast<double>(radar.azimuths_rad.size());
  if (cells > kMostBeamCells)
    core::throw_input_error(core::ErrorClass::limit, "azimuths x speeds x ranges", cells,
                            "at most 1e9: fewer samples or chirps, or no product with azimuths");
  if (radar.line) {
    signal::angle_transform(range_speed, settings.angle_window,
                            static_cast<int>(radar.azimuths_rad.size()), cube);
    return;
  }
  signal::beam_transform(range_speed, signal::virtual_elements_m(radar.array),
                         radar.waveform.wavelength_m(), {radar.azimuths_rad}, {}, cube);
}

signal::PowerMap capon_map(const FmcwRadar& radar, const signal::FloatCube& range_speed) {
  const auto weights =
      signal::window_weights(radar.detection.transform.doppler_window, range_speed.shape.chirps);
  return signal::capon_range_azimuth(range_speed, signal::virtual_elements_m(radar.array),
                                     radar.waveform.wavelength_m(), radar.azimuths_rad,
                                     range_speed.shape.chirps * signal::noise_gain(weights));
}

bool holds_any(const std::set<std::string>& products, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return products.contains(name); });
}

bool need_detections(const std::set<std::string>& products) {
  return holds_any(products,
                   {"range-doppler", "range-azimuth", "top-view", "detections", "spectrogram"});
}

}  // namespace

void check_processing(const FmcwRadar& radar, const std::set<std::string>& products) {
  if (radar.maps && need_detections(products)) check_detects(radar);
}

void process_samples(const FmcwRadar& radar, const ProcessingSettings& settings,
                     const std::set<std::string>& products, FmcwFrame& frame) {
  const auto wants = [&](std::initializer_list<const char*> names) {
    return holds_any(products, names);
  };
  const bool detections = need_detections(products);
  const bool angles = wants({"cube", "range-azimuth", "top-view"});
  if (!radar.maps || !(detections || angles)) return;
  check_processing(radar, products);
  signal::FloatCube changed;
  const bool mends = settings.mitigation != signal::Mitigation::none;
  if (mends || radar.power_scale != 1.0) changed = frame.beats[0];
  if (mends)
    frame.mended = signal::mitigate(settings.mitigation, settings.mitigation_threshold,
                                    radar.waveform, radar.array, changed);
  if (radar.power_scale != 1.0) {
    const auto scale = static_cast<float>(std::sqrt(radar.power_scale));
    for (std::complex<float>& sample : changed.values) sample *= scale;
  }
  const signal::FloatCube& beat = changed.values.empty() ? frame.beats[0] : changed;
  signal::FloatCube range_speed;
  signal::range_doppler(beat, radar.detection.transform, range_speed);
  if (detections) {
    frame.range_doppler = signal::range_doppler_map(range_speed, signal::Projection::sum);
    FmcwDetections found;
    found.detections =
        signal::detect(beat, frame.range_doppler, radar.array, radar.timing, radar.detection);
    found.clusters = signal::detection_clusters(found.detections, radar.clusters);
    frame.found = std::move(found);
  }
  if (!angles) return;
  signal::compensate_slots(range_speed, radar.array);
  if (wants({"cube"}) || settings.angle_method != signal::AngleMethod::capon)
    form_beams(radar, settings, range_speed, frame.cube);
  if (!wants({"range-azimuth", "top-view"})) return;
  frame.range_azimuth = settings.angle_method == signal::AngleMethod::capon
                            ? capon_map(radar, range_speed)
                            : signal::range_azimuth_map(frame.cube, signal::Projection::max);
  if (!wants({"top-view"})) return;
  frame.grid = grid_of(radar);
  frame.top_view = signal::top_view(frame.range_azimuth, radar.azimuths_rad,
                                    radar.axes.range_step_m, frame.grid);
}

}  // namespace fanbeam::session
