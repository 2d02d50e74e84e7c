#include "session/signal/record.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/machine.h"
#include "renderer/plan/effect_catalogue.h"
#include "sensors/receiver/point_response.h"
#include "session/records/record_json.h"
#include "session/signal/receive.h"
#include "session/signal/signal_bscope.h"
#include "session/signal/waveform_figures.h"
#include "session/version.h"
#include "signal/fourier/window_figures.h"
#include "signal/scan/column_sweep.h"

namespace fanbeam::session {
namespace {

using Json = nlohmann::ordered_json;

Json named_waveform_json(const FmcwRadar& radar) {
  Json json = {{"name", radar.waveform_name}};
  json.update(Json::parse(waveform_json(radar.waveform)));
  return json;
}

Json array_json(const FmcwRadar& radar) {
  Json elements = Json::array(), places = Json::array();
  for (const glm::dvec3& element : signal::virtual_elements_m(radar.array))
    (radar.line ? elements : places)
        .push_back(radar.line ? Json(element.y) : Json{element.x, element.y, element.z});
  const bool in_turn = radar.array.multiplex == signal::Multiplex::time_division;
  Json json = {{"transmitters", radar.array.transmitters_m.size()},
               {"receivers", radar.array.receivers_m.size()},
               {"multiplex", in_turn ? "time-division" : "simultaneous"},
               {"pitch_m", radar.pitch_m}};
  json[radar.line ? "virtual_elements_right_m" : "virtual_elements_forward_right_up_m"] =
      radar.line ? elements : places;
  return json;
}

// How the cells of maps and cube are numbered.
Json axes_json(const FmcwRadar& radar) {
  const signal::RangeDopplerAxes& axes = radar.axes;
  return {{"cube", {"azimuth", "radial_speed", "range"}},
          {"range_step_m", axes.range_step_m},
          {"range_cells", radar.detection.transform.kept_range_cells},
          {"speed_first_mps", axes.speed_mps(0.0)},
          {"speed_step_mps", axes.speed_mps(1.0) - axes.speed_mps(0.0)},
          {"speed_cells", axes.doppler_cells},
          {"range_read_long_m_per_mps", axes.range_per_Doppler_m_s * 2.0 / axes.wavelength_m},
          {"azimuths_rad", radar.azimuths_rad},
          {"noise_cell_W", radar.noise_cell_W}};
}

// What a window of that many weights takes of a tone and lets through beside it; null where it is too short.
Json window_json(const signal::Window& window, int length) {
  const std::vector<double> weights = signal::window_weights(window, length);
  if (weights.size() < 3) return nullptr;
  const signal::WindowFigures figures = signal::window_figures(weights);
  return {{"half_power_width_cells", figures.half_power_width_bins},
          {"peak_side_lobe_dB", signal::peak_side_lobe_dB(weights)},
          {"snr_loss_dB", figures.snr_loss_dB},
          {"scalloping_dB", figures.scalloping_dB}};
}

Json processing_json(const FmcwSettings& options, const FmcwRadar& radar) {
  return {{"range_window", signal::name(options.range_window)},
          {"range_window_figures",
           window_json(options.range_window, signal::samples_per_segment(radar.waveform, 0))},
          {"doppler_window", signal::name(options.doppler_window)},
          {"doppler_window_figures", window_json(options.doppler_window, radar.axes.doppler_cells)},
          {"angle_window", radar.line ? signal::name(options.angle_window) : "none"},
          {"mitigation", std::string(signal::name(options.mitigation))},
          {"angle_method", std::string(signal::name(options.angle_method))},
          {"clusters",
           {{"place_m", radar.clusters.place_m},
            {"speed_mps", radar.clusters.speed_mps},
            {"least_neighbours", radar.clusters.least_neighbours}}}};
}

// What the B-scope's columns are swept with: the same in all but its frequency.
Json scan_json(const sensors::Sensor& sensor) {
  return {{"sweep", Json::parse(waveform_json(signal::column_sweep(sensor, 0)))},
          {"window_assumed", sensor.waveform.window == sensors::Waveform::Window::none},
          {"window_cosines", sensors::window_coefficients(with_sweep_window(sensor).waveform)},
          {"doppler_compensated", sensor.waveform.doppler_compensated}};
}

// Of the scene's plan what the echoes hold; the others belong to pictures of powers alone.
core::EffectPlan plan_of_echoes(const core::EffectPlan& scene) {
  core::EffectPlan echoes;
  for (const renderer::Effect& effect : renderer::effect_catalogue())
    for (const core::EffectDecision& decision : scene.decisions)
      if (effect.in_echoes && decision.effect == effect.id) echoes.decisions.push_back(decision);
  return echoes;
}

Json scan_json(const FmcwScanCounts& scan) {
  return {{"looks", scan.looks},           {"rays", scan.rays},
          {"scatterers", scan.scatterers}, {"phase_noise_rad", scan.phase_noise_rad},
          {"clipped", scan.clipped},       {"plan", Json::parse(decisions_json(scan.plan))}};
}

Json frame_json(const FmcwFrameRecord& frame) {
  if (!frame.chain)
    return {{"index", frame.index},
            {"time_s", frame.time_s},
            {"events", frame.events},
            {"bscope", scan_json(*frame.scan)},
            {"files", frame.files}};
  Json targets = Json::array(), warnings = Json::array();
  for (const FmcwTruth& truth : frame.targets)
    targets.push_back({{"name", truth.name},
                       {"range_m", truth.echo.range_m},
                       {"radial_speed_mps", truth.echo.radial_speed_mps},
                       {"azimuth_rad", truth.echo.azimuth_rad},
                       {"elevation_rad", truth.echo.elevation_rad},
                       {"power_W", truth.echo.power_W}});
  for (const core::Problem& warning : frame.warnings) warnings.push_back(to_string(warning));
  Json json = {{"index", frame.index},
               {"time_s", frame.time_s},
               {"radar_speed_mps", frame.radar_speed_mps},
               {"radar_velocity_mps", frame.radar_velocity_mps},
               {"events", frame.events},
               {"rays", frame.rays},
               {"paths", frame.paths},
               {"received_W", frame.received_W},
               {"synthesis", frame.keystone ? "keystone" : "direct"},
               {"synthesis_error", frame.synthesis_error},
               {"phase_noise_rad", frame.phase_noise_rad},
               {"clipped", frame.clipped},
               {"crossed", frame.crossed},
               {"mended", frame.mended},
               {"plan", Json::parse(decisions_json(frame.plan))}};
  if (frame.found) {
    json["detections"] = frame.found->detections;
    json["clusters"] = frame.found->clusters;
  }
  if (frame.scan) json["bscope"] = scan_json(*frame.scan);
  json["warnings"] = warnings;
  json["targets"] = targets;
  json["files"] = frame.files;
  return json;
}

}  // namespace

FmcwFrameRecord fmcw_record(const scenes::Scene& scene, int index, const FmcwPaths& paths,
                            const FmcwFrame& frame) {
  FmcwFrameRecord record;
  record.chain = true;
  record.index = index;
  record.time_s =
      scene.trajectory->frame_time_s(index, scene.description.sensor.scan.frame_rate_Hz);
  record.radar_speed_mps = glm::length(scene.trajectory->at(record.time_s).v_N_mps);
  record.radar_velocity_mps = own_velocity_mps(scene, index);
  record.events = paths.events;
  record.rays = paths.rays;
  record.paths = paths.paths.size();
  for (const signal::ScatterPath& path : paths.paths)
    record.received_W += std::norm(path.amplitude_sqrtW);
  for (const core::Echo& echo : paths.targets)
    record.targets.push_back({scene.world.targets[echo.object_id].name, echo});
  if (frame.found) {
    record.found = FmcwCounts{frame.found->detections.size(), 0};
    for (const int cluster : frame.found->clusters)
      record.found->clusters = std::max(record.found->clusters, cluster + 1);
  }
  record.warnings = frame.warnings;
  record.keystone = frame.keystone;
  record.synthesis_error = frame.synthesis_error;
  record.phase_noise_rad = frame.phase_noise_rad;
  record.clipped = frame.clipped;
  record.crossed = frame.crossed;
  record.mended = frame.mended;
  record.plan = frame.plan;
  return record;
}

std::string fmcw_run_json(const scenes::Scene& scene, const FmcwSettings& options,
                          const FmcwRadar& radar, const std::vector<FmcwFrameRecord>& frames,
                          const std::set<std::string>& files) {
  Json json = {{"version", version_text()},
               {"commit", commit_text()},
               {"scene", scene.description.name},
               {"sensor", scene.description.sensor.name},
               {"seed", options.seed},
               {"rays_per_cell", options.rays_per_cell},
               {"noise_figure", noise_figure_of(options, scene.description.sensor)},
               {"line_width_Hz", options.line_width_Hz},
               {"adc_bits", options.adc_bits}};
  if (options.adc_full_scale_dBm) json["adc_full_scale_dBm"] = *options.adc_full_scale_dBm;
  if (!options.phase_noise.empty())
    json["phase_noise"] = {{"offsets_Hz", options.phase_noise.offsets_Hz},
                           {"dBc_per_Hz", options.phase_noise.levels_dBc_per_Hz}};
  if (const auto limit = core::instruction_limit()) json["isa"] = core::short_name_of(*limit);
  if (!files.empty()) json["files"] = files;
  if (!radar.waveform.segments.empty()) {  // the chain ran
    json["waveform"] = named_waveform_json(radar);
    json["array"] = array_json(radar);
  }
  if (radar.maps) {
    json["axes"] = axes_json(radar);
    json["cfar"] = {{"kind", std::string(signal::name(radar.detection.cfar.kind))},
                    {"false_alarm_probability", options.false_alarm_probability},
                    {"guard", {options.cfar_guard.range, options.cfar_guard.doppler}},
                    {"training", {options.cfar_training.range, options.cfar_training.doppler}}};
    if (const double design = radar.detection.cfar.design_probability; design > 0.0)
      json["cfar"]["design_probability"] = design;
    json["processing"] = processing_json(options, radar);
  }
  if (!frames.empty() && frames.front().scan) json["bscope"] = scan_json(scene.description.sensor);
  json["input"] = resolved_json<Json>(scene.description.resolved);
  json["accuracy_grey"] = scene.accuracy_grey;
  json["plan"] = Json::parse(decisions_json(plan_of_echoes(scene.plan)));
  json["frames"] = Json::array();
  for (const FmcwFrameRecord& frame : frames) json["frames"].push_back(frame_json(frame));
  return json.dump(1) + "\n";
}

std::string fmcw_timing_json(int threads, double scene_build_s,
                             const std::vector<FmcwFrameRecord>& frames) {
  Json json = {{"threads", threads},
               {"isa", core::name_of(core::instruction_level())},
               {"machine", core::processor_name()},
               {"scene_build_s", scene_build_s},
               {"frames", Json::array()}};
  for (const FmcwFrameRecord& frame : frames) {
    Json entry = {{"index", frame.index}};
    if (frame.scan) entry["bscope_ms"] = frame.scan->ms;
    if (frame.chain)
      entry.update(Json{{"echoes_ms", frame.echoes_ms},
                        {"signal_ms", frame.signal_ms},
                        {"writing_ms", frame.writing_ms}});
    json["frames"].push_back(entry);
  }
  return json.dump(1) + "\n";
}

}  // namespace fanbeam::session
