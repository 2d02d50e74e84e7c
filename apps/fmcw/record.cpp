#include "apps/fmcw/record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/machine.h"
#include "signal/waveform/figures.h"

namespace fanbeam::apps {
namespace {

using Json = nlohmann::ordered_json;

Json waveform_json(const FmcwRadar& radar) {
  const signal::Waveform& waveform = radar.waveform;
  Json json = {{"name", radar.waveform_name},
               {"kind", std::string(signal::name(waveform.kind))},
               {"centre_frequency_Hz", waveform.centre_frequency_Hz},
               {"wavelength_m", waveform.wavelength_m()},
               {"bandwidth_Hz", waveform.bandwidth_Hz},
               {"duration_s", waveform.duration_s()},
               {"complex_baseband", waveform.complex_baseband}};
  const auto stages = signal::figures(waveform);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const signal::StageFigures& stage = stages[i];
    Json entry = {{"sample_rate_Hz", waveform.sample_rate_Hz[i]},
                  {"segments", stage.segments},
                  {"segment_s", stage.segment_s},
                  {"samples", stage.samples},
                  {"slope_Hz_per_s", stage.slope_Hz_per_s}};
    const auto put = [&](const char* key, const std::optional<double>& value) {
      if (value) entry[key] = *value;
    };
    put("range_cell_m", stage.range_cell_m);
    put("taylor_width_m", stage.taylor_width_m);
    put("unambiguous_range_m", stage.unambiguous_range_m);
    put("speed_cell_mps", stage.speed_cell_mps);
    put("unambiguous_speed_mps", stage.unambiguous_speed_mps);
    put("coupling_m_per_mps", stage.coupling_m_per_mps);
    json["stages"].push_back(entry);
  }
  return json;
}

Json array_json(const FmcwRadar& radar) {
  Json elements = Json::array();
  for (const glm::dvec3& element : signal::virtual_elements_m(radar.array))
    elements.push_back(element.y);
  const bool in_turn = radar.array.multiplex == signal::Multiplex::time_division;
  return {{"transmitters", radar.array.transmitters_m.size()},
          {"receivers", radar.array.receivers_m.size()},
          {"multiplex", in_turn ? "time-division" : "simultaneous"},
          {"pitch_m", radar.pitch_m},
          {"virtual_elements_right_m", elements}};
}

// How the cells of maps and cube are numbered.
Json axes_json(const FmcwRadar& radar, const std::vector<double>& azimuths_rad) {
  const signal::RangeDopplerAxes& axes = radar.axes;
  return {{"cube", {"azimuth", "radial_speed", "range"}},
          {"range_step_m", axes.range_step_m},
          {"range_cells", radar.detection.transform.kept_range_cells},
          {"speed_first_mps", axes.speed_mps(0.0)},
          {"speed_step_mps", axes.speed_mps(1.0) - axes.speed_mps(0.0)},
          {"speed_cells", axes.doppler_cells},
          {"range_read_long_m_per_mps", axes.range_per_Doppler_m_s * 2.0 / axes.wavelength_m},
          {"azimuths_rad", azimuths_rad},
          {"noise_cell_W", radar.noise_cell_W}};
}

Json frame_json(const FmcwFrameRecord& frame) {
  Json targets = Json::array(), warnings = Json::array();
  for (const FmcwTruth& truth : frame.targets)
    targets.push_back({{"name", truth.name},
                       {"range_m", truth.echo.range_m},
                       {"radial_speed_mps", truth.echo.radial_speed_mps},
                       {"azimuth_rad", truth.echo.azimuth_rad},
                       {"elevation_rad", truth.echo.elevation_rad},
                       {"power_W", truth.echo.power_W}});
  for (const core::Problem& warning : frame.warnings) warnings.push_back(to_string(warning));
  return {{"index", frame.index},
          {"time_s", frame.time_s},
          {"rays", frame.rays},
          {"paths", frame.paths},
          {"received_W", frame.received_W},
          {"synthesis", frame.keystone ? "keystone" : "direct"},
          {"synthesis_error", frame.synthesis_error},
          {"phase_noise_rad", frame.phase_noise_rad},
          {"clipped", frame.clipped},
          {"detections", frame.detections},
          {"clusters", frame.clusters},
          {"warnings", warnings},
          {"targets", targets}};
}

}  // namespace

FmcwFrameRecord fmcw_record(const scenes::Scene& scene, int index, const FmcwPaths& paths,
                            const FmcwFrame& frame) {
  FmcwFrameRecord record;
  record.index = index;
  record.time_s = scene.trajectory.frame_time_s(index, scene.description.sensor.scan.frame_rate_Hz);
  record.rays = paths.echoes.rays;
  record.paths = paths.paths.size();
  for (const signal::ScatterPath& path : paths.paths)
    record.received_W += std::norm(path.amplitude_sqrtW);
  for (std::size_t i = paths.echoes.first_target; i < paths.echoes.echoes.size(); ++i) {
    const core::Echo& echo = paths.echoes.echoes[i];
    record.targets.push_back({scene.world.targets[echo.object_id].name, echo});
  }
  record.detections = frame.detections.size();
  for (const int cluster : frame.clusters) record.clusters = std::max(record.clusters, cluster + 1);
  record.warnings = frame.warnings;
  record.keystone = frame.keystone;
  record.synthesis_error = frame.synthesis_error;
  record.phase_noise_rad = frame.phase_noise_rad;
  record.clipped = frame.clipped;
  return record;
}

std::string fmcw_run_json(const scenes::Scene& scene, const FmcwOptions& options,
                          const FmcwRadar& radar, const std::vector<double>& azimuths_rad,
                          const std::vector<FmcwFrameRecord>& frames) {
  Json json = {{"version", version_text()},
               {"commit", commit_text()},
               {"scene", scene.description.name},
               {"sensor", scene.description.sensor.name},
               {"seed", options.seed},
               {"rays_per_cell", options.rays_per_cell},
               {"waveform", waveform_json(radar)},
               {"array", array_json(radar)},
               {"noise_figure", scene.description.sensor.receiver.noise_figure},
               {"line_width_Hz", options.line_width_Hz},
               {"adc_bits", options.adc_bits}};
  if (radar.maps) {
    json["axes"] = axes_json(radar, azimuths_rad);
    json["cfar"] = {{"kind", std::string(signal::name(radar.detection.cfar.kind))},
                    {"false_alarm_probability", options.false_alarm_probability},
                    {"design_probability", radar.detection.cfar.design_probability}};
  }
  Json input = Json::object();
  for (const auto& [path, value] : scene.description.resolved)
    std::visit([&, &key = path](const auto& v) { input[key] = v; }, value);
  json["input"] = input;
  json["frames"] = Json::array();
  for (const FmcwFrameRecord& frame : frames) json["frames"].push_back(frame_json(frame));
  return json.dump(1) + "\n";
}

std::string fmcw_timing_json(int threads, double scene_build_s,
                             const std::vector<FmcwFrameRecord>& frames) {
  Json json = {{"threads", threads},
               {"isa", core::instruction_level()},
               {"machine", core::processor_name()},
               {"scene_build_s", scene_build_s},
               {"frames", Json::array()}};
  for (const FmcwFrameRecord& frame : frames)
    json["frames"].push_back({{"index", frame.index},
                              {"echoes_ms", frame.echoes_ms},
                              {"signal_ms", frame.signal_ms},
                              {"writing_ms", frame.writing_ms}});
  return json.dump(1) + "\n";
}

}  // namespace fanbeam::apps
