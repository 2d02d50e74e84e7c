#include "session/signal/interferers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "sensors/antenna/beam_pattern.h"
#include "session/signal/spectrum.h"

namespace fanbeam::session {
namespace {

const core::Echo* echo_of(const scenes::Scene& scene, const std::vector<core::Echo>& targets,
                          const std::string& target) {
  for (const core::Echo& echo : targets)
    if (scene.world.targets[echo.object_id].name == target) return &echo;
  return nullptr;
}

bool near(const signal::RadarDetection& a, const signal::RadarDetection& b) {
  return std::abs(a.range_cell - b.range_cell) <= 1.0 &&
         std::abs(a.doppler_cell - b.doppler_cell) <= 1.0;
}

std::size_t count_near(const std::vector<signal::RadarDetection>& of,
                       const std::vector<signal::RadarDetection>& to) {
  return static_cast<std::size_t>(std::count_if(of.begin(), of.end(), [&](const auto& one) {
    return std::any_of(to.begin(), to.end(), [&](const auto& other) { return near(one, other); });
  }));
}

}  // namespace

std::vector<signal::Interferer> interferers_of(const scenes::Scene& scene, int frame,
                                               const std::vector<core::Echo>& targets) {
  const sensors::Sensor& sensor = scene.world.sensor;
  const double time_s =
      scene.trajectory->frame_time_s(frame, scene.description.sensor.scan.frame_rate_Hz);
  std::vector<signal::Interferer> result;
  for (const scenes::InterfererDescription& other : scene.description.interferers) {
    const core::Echo* echo = echo_of(scene, targets, other.target);
    if (echo == nullptr) continue;
    signal::Interferer one;
    const double half_Hz = (other.falling ? -0.5 : 0.5) * other.bandwidth_Hz;
    one.start_frequency_Hz = other.centre_frequency_Hz - half_Hz;
    one.slope_Hz_per_s = 2.0 * half_Hz / other.ramp_s;
    one.duration_s = other.ramp_s;
    one.interval_s = other.interval_s;
    one.start_s = std::fmod(other.start_s - time_s, other.interval_s);
    one.range_m = echo->range_m;
    one.radial_speed_mps = echo->radial_speed_mps;
    one.azimuth_rad = echo->azimuth_rad;
    one.elevation_rad = echo->elevation_rad;
    const double gain = sensor.antenna.peak_gain * element_gain(sensor, echo->azimuth_rad) *
                        sensors::one_way_gain_with_side_lobes(
                            sensor.antenna.elevation,
                            echo->elevation_rad - sensor.antenna.boresight_elevation_rad) /
                        sensor.receiver.loss;
    one.power_W = signal::interference_power_W(
        other.eirp_W, gain, core::kSpeedOfLight_mps / other.centre_frequency_Hz, echo->range_m);
    result.push_back(one);
  }
  return result;
}

std::vector<InterferenceCase> interference_study(const FmcwRadar& radar, const FmcwPaths& paths,
                                                 FmcwFrame heard, int frame,
                                                 const FmcwSettings& options,
                                                 const SignalBudget& budget) {
  const std::set<std::string> products = {"range-doppler", "detections"};
  std::vector<InterferenceCase> cases;
  std::vector<signal::RadarDetection> clean;
  const auto add = [&](const std::string& name, const FmcwFrame& found) {
    InterferenceCase one;
    one.name = name;
    const signal::PowerMap& map = found.range_doppler;
    one.floor_W = core::median(map.values_W);
    one.mended = found.mended;
    const auto& detections = found.found->detections;
    if (cases.empty()) clean = detections;
    one.detections = detections.size();
    one.recovered = count_near(clean, detections);
    one.false_ones = detections.size() - count_near(detections, clean);
    one.profile_W.assign(static_cast<std::size_t>(map.columns), 0.0);
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column)
        one.profile_W[static_cast<std::size_t>(column)] += map.at(row, column) / map.rows;
    cases.push_back(std::move(one));
  };
  FmcwSettings settings = options;
  settings.mitigation = signal::Mitigation::none;
  add("clean", fmcw_frame(radar, paths.paths, frame, settings, products, budget));
  for (const signal::Mitigation each :
       {signal::Mitigation::none, signal::Mitigation::zero, signal::Mitigation::interpolate}) {
    settings.mitigation = each;
    heard.mended = 0;
    process_samples(radar, settings, products, heard);
    add(std::string(signal::name(each)), heard);
  }
  return cases;
}

std::string interference_csv(const std::vector<InterferenceCase>& cases) {
  std::string text =
      "case,floor_dBm,rise_dB,mended_samples,detections,recovered,missed,false_detections\n";
  for (const InterferenceCase& one : cases)
    text += fmt::format("{},{:.2f},{:.2f},{},{},{},{},{}\n", one.name, dBm(one.floor_W),
                        dBm(one.floor_W) - dBm(cases.front().floor_W), one.mended, one.detections,
                        one.recovered, cases.front().detections - one.recovered, one.false_ones);
  return text;
}

Plot interference_plot(const std::vector<InterferenceCase>& cases, double range_step_m,
                       const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x = {"range, m", false, 0.0, {}};
  plot.y = {"mean power over speeds, dBm", false, {}, {}};
  plot.key_below = true;
  for (const InterferenceCase& one : cases) {
    PlotSeries series;
    series.title = one.name == "clean"  ? "without other radars"
                   : one.name == "none" ? "with them"
                                        : "crossed samples: " + one.name;
    for (std::size_t cell = 0; cell < one.profile_W.size(); ++cell) {
      series.x.push_back(static_cast<double>(cell) * range_step_m);
      series.y.push_back(dBm(one.profile_W[cell]));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace fanbeam::session
