#include "session/records/run_record.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/machine.h"
#include "core/median.h"
#include "core/units.h"
#include "sensors/display/grey_scale.h"
#include "sensors/receiver/receiver_figures.h"
#include "session/records/fingerprint.h"
#include "session/records/record_json.h"
#include "session/version.h"

namespace fanbeam::session {
namespace {

using Json = nlohmann::ordered_json;

// `caster` is the scene's, which a reference does not ask.
Json caster_json(const renderer::CasterChoice& caster, const renderer::Sampling& sampling) {
  Json json = {{"chosen", renderer::name_of(sampling.caster)},
               {"wish", renderer::name_of(caster.wish)},
               {"reason", sampling.caster == caster.chosen ? caster.reason
                                                           : "a reference is always made of rays"}};
  if (sampling.caster == renderer::CasterKind::rays) {
    json["rays_per_cell_and_column"] = rays_per_cell_and_column(sampling);
    return json;
  }
  json["slices_per_column"] = slices_per_column(sampling);
  json["objects_left_to_rays"] = caster.others;
  return json;
}

Json refined_pictures_json(const renderer::Products& wanted) {
  Json json = Json::array({"bscope"});
  if (wanted.cscope || wanted.cscope_layers) json.push_back("cscope");
  return json;
}

// What the caster in use goes by. Slices may leave azimuths to rays, whose settings then stand in
// an object of their own.
Json sampling_json(const scenes::Scene& scene, const RunRecord& record) {
  // With a field more this does not compile: the fingerprint must not forget one.
  const auto& [caster, slices_per_sub_column, sub_columns, rays_per_cell, refinement_depth,
               gap_cells, largest_step_rad, largest_step_rows, bounce_share, deposit_intervals,
               jittered_passes, seed, target_grey, estimate_error] = record.choice.sampling;
  Json json = {{"sub_columns", sub_columns}};
  if (target_grey > 0.0) {
    json["refined_to_grey"] = target_grey;
    json["refined_pictures"] = refined_pictures_json(record.wanted);
  }
  if (estimate_error) json["error_estimated"] = true;
  if (bounce_share != 1.0) json["bounce_share"] = bounce_share;
  Json rays = {{"rays_per_cell_and_sub_column", rays_per_cell},
               {"refinement_depth", refinement_depth},
               {"gap_cells", gap_cells},
               {"largest_step_deg", core::degrees(largest_step_rad)},
               {"deposit", deposit_intervals ? "intervals" : "points"},
               {"jittered_passes", jittered_passes}};
  if (largest_step_rows != renderer::Sampling{}.largest_step_rows)
    rays["largest_step_rows"] = largest_step_rows;
  if (jittered_passes > 0) rays["jitter_seed"] = seed;
  if (caster == renderer::CasterKind::rays) {
    json.update(rays);
    return json;
  }
  json["slices_per_sub_column"] = slices_per_sub_column;
  if (scene.caster.others > 0) json["azimuths_left_to_rays"] = std::move(rays);
  return json;
}

Json sensor_json(const sensors::Sensor& sensor) {
  const sensors::GreyScale grey(sensor);
  return {{"name", sensor.name},
          {"frequency_Hz", sensor.waveform.frequency_Hz},
          {"transmit_power_W", sensor.waveform.transmit_power_W},
          {"peak_gain", sensor.antenna.peak_gain},
          {"azimuth_width_deg", core::degrees(sensor.antenna.azimuth.half_power_width_rad)},
          {"azimuth_cut_deg", core::degrees(sensor.antenna.azimuth.cut_rad)},
          {"elevation_width_deg", core::degrees(sensor.antenna.elevation.half_power_width_rad)},
          {"elevation_cut_deg", core::degrees(sensor.antenna.elevation.cut_rad)},
          {"boresight_elevation_deg", core::degrees(sensor.antenna.boresight_elevation_rad)},
          {"columns", sensor.scan.columns},
          {"field_of_view_deg", core::degrees(sensor.scan.field_of_view_rad)},
          {"frame_rate_Hz", sensor.scan.frame_rate_Hz},
          {"scan_surface", sensor.scan.surface == sensors::ScanSurface::cone ? "cone" : "plane"},
          {"stabilised", sensor.scan.stabilised},
          {"polarisation", core::name_of(sensor.waveform.polarisation)},
          {"range_minimum_m", sensor.range.minimum_m},
          {"range_cell_m", sensor.range.cell_m},
          {"range_cells", sensor.range.cells},
          {"noise_power_W", sensor.noise_power_W()},
          {"display_low_dB", grey.low_dB()},
          {"display_high_dB", grey.high_dB()},
          {"cscope_top_deg", core::degrees(sensor.display.cscope_top_rad)},
          {"cscope_span_deg", core::degrees(sensor.display.cscope_span_rad)},
          {"assumed", sensor.assumed}};
}

Json receiver_json(const scenes::Scene& scene) {
  const sensors::Sensor& sensor = scene.description.sensor;
  const sensors::ReceiverFigures figures = sensors::receiver_figures(sensor);
  const bool noisy =
      scene.plan.runs(core::EffectId::speckle) && scene.plan.runs(core::EffectId::thermal_noise);
  return {{"noise_W", figures.noise_W},
          {"threshold_W", figures.threshold_W},
          {"false_alarm_probability", sensor.receiver.false_alarm_probability},
          {"false_alarms_per_frame", noisy ? figures.false_alarms_per_frame : 0.0},
          {"looks", sensor.receiver.looks},
          {"detection_probability", sensors::kDetectionProbability},
          {"minimum_detectable_signal_W", figures.detectable_steady_W},
          {"minimum_detectable_signal_swerling1_W", figures.detectable_swerling1_W},
          {"minimum_detectable_signal_assumes",
           "mean signal of one cell and look, square-law detector, known noise, no clutter"}};
}

// Rows of a recorded flight that were left out; first and last by number.
Json rejected_json(const std::vector<scenes::RejectedRows>& rejected) {
  Json json = Json::array();
  for (const scenes::RejectedRows& rows : rejected)
    json.push_back({{"first_row", rows.first_row},
                    {"last_row", rows.last_row},
                    {"rows", rows.count},
                    {"first_line", rows.first_line},
                    {"first_time_s", rows.first_time_s},
                    {"why", rows.why}});
  return json;
}

Json header_json(const scenes::Scene& scene, const RunRecord& record) {
  Json json;
  json["version"] = version_text();
  json["commit"] = commit_text();
  json["scene"] = scene.description.name;
  json["sensor"] = scene.description.sensor.name;
  json["seed"] = record.seed;
  if (const auto limit = core::instruction_limit()) json["isa"] = core::short_name_of(*limit);
  json["caster"] = caster_json(scene.caster, record.choice.sampling);
  json["input"] = resolved_json<Json>(scene.description.resolved);
  if (!record.set.empty()) json["set"] = Json::parse(record.set);
  json["sensor_values"] = sensor_json(scene.description.sensor);
  json["receiver"] = receiver_json(scene);
  json["realisation"] = realisation_of(scene.plan);
  json["sampling"] = sampling_json(scene, record);
  json["plan_per_frame"] = record.plan_per_frame;
  if (!record.range_unit.empty()) json["range_unit"] = record.range_unit;
  json["plan"] = Json::parse(decisions_json(scene.plan));
  json["surface_state"] = name_of(scene.description.surface_state);
  json["materials"] = Json::array();
  json["extrapolations"] = Json::array();
  for (const scenes::SurfaceRecord& surface : scene.surfaces) {
    json["materials"].push_back({{"material", surface.material},
                                 {"shown_as", surface.shown_as},
                                 {"model", surface.model},
                                 {"confidence", surface.confidence},
                                 {"source_covers_grazing_deg",
                                  {core::rounded_degrees(surface.grazing_rad.low),
                                   core::rounded_degrees(surface.grazing_rad.high)}}});
    for (const materials::Extrapolation& outside : surface.extrapolations)
      json["extrapolations"].push_back({{"material", surface.shown_as},
                                        {"quantity", outside.quantity},
                                        {"asked", outside.asked},
                                        {"known", outside.known}});
  }
  json["attitude_derived"] = scene.trajectory->attitude_derived;
  if (scene.description.trajectory.columns.outliers == scenes::OutlierPolicy::reject)
    json["trajectory_rows_rejected"] = rejected_json(scene.trajectory->rejected);
  return json;
}

// Beside the header, which must not tell a sampling that was chosen from one that was asked for.
Json budget_json(const SamplingChoice& choice) {
  return {{"budget_ms", choice.budget_ms},
          {"rays_per_cell", choice.samples},
          {"estimated_error_grey", choice.estimated_error_grey},
          {"fits", choice.fits}};
}

}  // namespace

std::string realisation_of(const core::EffectPlan& plan) {
  return plan.runs(core::EffectId::speckle) || plan.runs(core::EffectId::swerling) ? "sample"
                                                                                   : "mean";
}

std::string caster_text(const renderer::Sampling& sampling) {
  if (sampling.target_grey > 0.0)
    return fmt::format("{}, refined to {} grey RMS", renderer::name_of(sampling.caster),
                       core::number_text(sampling.target_grey));
  if (sampling.caster == renderer::CasterKind::profile) {
    const auto slices = slices_per_column(sampling);
    const std::string fewer = sampling.bounce_share < 1.0
                                  ? fmt::format(", {:g} of its bounces", sampling.bounce_share)
                                  : "";
    return fmt::format("profile, {} {} per column{}", slices, slices == 1 ? "slice" : "slices",
                       fewer);
  }
  return fmt::format("rays, {} per range cell and column",
                     core::number_text(rays_per_cell_and_column(sampling)));
}

std::string run_json(const scenes::Scene& scene, const RunRecord& record) {
  Json json = header_json(scene, record);
  if (record.choice.budget_ms > 0.0) json["time_budget"] = budget_json(record.choice);
  if (!record.films.empty()) json["files"] = record.films;
  json["frames"] = Json::array();
  for (const FrameRecord& frame : record.frames) {
    Json entry = {{"index", frame.index},
                  {"time_s", frame.time_s},
                  {"pose", Json::parse(pose_json(frame.pose))},
                  {"rays", frame.rays},
                  {"slices", frame.slices},
                  {"blanked", frame.blanked},
                  {"unprojected", frame.unprojected}};
    if (frame.error) {
      entry["estimated_error_grey"] = frame.error->rms_grey;
      entry["estimated_error_cscope_grey"] = frame.error->cscope_rms_grey;
      entry["levels"] = frame.error->levels;
    } else {
      entry["estimated_error_grey"] = nullptr;
    }
    if (record.plan_per_frame) entry["left_out"] = frame.left_out.names();
    entry["events"] = frame.events;
    entry["files"] = frame.files;
    json["frames"].push_back(std::move(entry));
  }
  return json.dump(1) + "\n";
}

std::string timing_json(const RunRecord& record) {
  Json json;
  json["threads"] = record.threads;
  json["isa"] = core::name_of(core::instruction_level());
  json["machine"] = core::processor_name();
  json["frames"] = Json::array();
  std::vector<double> times_ms;
  double total_ms = 0.0;
  double rays = 0.0;
  double slices = 0.0;
  for (const FrameRecord& frame : record.frames) {
    if (frame.resumed) continue;
    json["frames"].push_back({{"index", frame.index}, {"frame_ms", frame.frame_ms}});
    times_ms.push_back(frame.frame_ms);
    total_ms += frame.frame_ms;
    rays += static_cast<double>(frame.rays);
    slices += static_cast<double>(frame.slices);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double median_ms = core::median(times_ms);
  json["summary"] = {
      {"frame_ms_median", median_ms},
      {"frames_per_s", median_ms > 0.0 ? 1000.0 / median_ms : 0.0},
      {"frames_per_s_written",
       record.wall_s > 0.0 ? static_cast<double>(times_ms.size()) / record.wall_s : 0.0},
      {"rays_per_s", total_ms > 0.0 ? rays / total_ms * 1000.0 : 0.0},
      {"slices_per_s", total_ms > 0.0 ? slices / total_ms * 1000.0 : 0.0},
      {"scene_build_s", record.scene_build_s},
      {"peak_memory_bytes", static_cast<std::int64_t>(usage.ru_maxrss) * 1024}};
  return json.dump(1) + "\n";
}

// Of the plan what runs: reasons and bounds hang on what else is asked for, and change no picture but
// of frames with plans of their own.
std::string input_fingerprint(const scenes::Scene& scene, const RunRecord& record) {
  Json header = header_json(scene, record);
  if (!record.plan_per_frame)
    for (Json& decision : header["plan"])
      decision = {{"effect", decision["effect"]}, {"on", decision["on"]}};
  return fingerprint_of(header.dump(), scene.description.files);
}

}  // namespace fanbeam::session
