#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "live/answers_private.h"
#include "sensors/display/grey_scale.h"
#include "session/records/record_json.h"

namespace fanbeam::live {

Json errors_json(const std::optional<PictureErrors>& errors) {
  if (!errors) return nullptr;
  return {{"bscope_grey", errors->bscope_grey}, {"cscope_grey", errors->cscope_grey}};
}

Json status_json(const Status& status) {
  Json bad = Json::object(), unused = Json::object();
  for (const auto& [reason, count] : status.bad_packets) bad[reason] = count;
  for (const auto& [name, count] : status.unused_packets) unused[name] = count;
  return {
      {"start", status.start},
      {"scene", status.scene},
      {"source", status.source},
      {"caster", status.caster},
      {"frames", status.frames},
      {"late", status.late},
      {"late_by_processor", status.late_by_processor},
      {"refused", status.refused},
      {"refusal", status.refusal},
      {"weather_refusal", status.weather_refusal},
      {"wanted_Hz", status.wanted_Hz},
      {"rate_Hz", status.rate_Hz},
      {"frame_ms", status.frame_ms},
      {"processor_ms", status.processor_ms},
      {"slowest_ms", status.slowest_ms},
      {"pose_age_ms", status.pose_age_ms},
      {"samples", status.samples},
      {"errors", errors_json(status.errors)},
      {"waiting", status.waiting},
      {"stale", status.stale},
      {"packets", status.packets},
      {"bad_packets", bad},
      {"unused_packets", unused},
      {"host_time", status.host_time.empty() ? Json(nullptr) : Json(status.host_time)},
      {"height_offset_m", status.height_offset_m ? Json(*status.height_offset_m) : Json(nullptr)}};
}

std::string metrics_text(const Status& status) {
  std::string text;
  const auto add = [&](const char* name, const char* type, const char* help, double value) {
    text += std::string("# HELP fanbeam_") + name + " " + help + "\n# TYPE fanbeam_" + name + " " +
            type + "\nfanbeam_" + name + " " + core::number_text(value) + "\n";
  };
  std::uint64_t bad = 0;
  for (const auto& [reason, count] : status.bad_packets) bad += count;
  add("frames_total", "counter", "Frames rendered.", static_cast<double>(status.frames));
  add("late_total", "counter", "Ticks left out because a frame took longer than a period.",
      static_cast<double>(status.late));
  add("late_by_processor_total", "counter",
      "Frames that took more processor time than a period has on all threads.",
      static_cast<double>(status.late_by_processor));
  add("refused_total", "counter", "Poses that nothing can be rendered at.",
      static_cast<double>(status.refused));
  add("packets_total", "counter", "Datagrams of the source.", static_cast<double>(status.packets));
  add("bad_packets_total", "counter", "Datagrams of no use.", static_cast<double>(bad));
  if (!status.bad_packets.empty())
    text +=
        "# HELP fanbeam_bad_packets_by_reason_total Datagrams of no use, by reason.\n"
        "# TYPE fanbeam_bad_packets_by_reason_total counter\n";
  for (const auto& [reason, count] : status.bad_packets)
    text += "fanbeam_bad_packets_by_reason_total{reason=\"" + reason + "\"} " +
            core::number_text(static_cast<double>(count)) + "\n";
  add("rate_hertz", "gauge", "Frames a second, over two seconds.", status.rate_Hz);
  add("frame_seconds", "gauge", "Time that the last frame took.", 1e-3 * status.frame_ms);
  add("slowest_frame_seconds", "gauge", "Slowest frame of two seconds.", 1e-3 * status.slowest_ms);
  add("pose_age_seconds", "gauge", "Age of the newest pose.", 1e-3 * status.pose_age_ms);
  add("waiting", "gauge", "1 before the first pose.", status.waiting ? 1.0 : 0.0);
  add("stale", "gauge", "1 where no pose of the last second could be rendered: the picture stands.",
      status.stale ? 1.0 : 0.0);
  if (status.height_offset_m)
    add("height_offset_metres", "gauge", "The source's height above ground less the scene's.",
        *status.height_offset_m);
  add("samples", "gauge", "Rays per range cell and column, or slices per column.", status.samples);
  if (status.errors) {
    add("bscope_error_grey_levels", "gauge", "RMS error of the B-scope with this sampling.",
        status.errors->bscope_grey);
    add("cscope_error_grey_levels", "gauge", "RMS error of the C-scope with this sampling.",
        status.errors->cscope_grey);
  }
  return text;
}

Json plan_json(const scenes::Scene& scene) {
  return {{"scene", scene.description.name},
          {"accuracy_grey", scene.accuracy_grey},
          {"plan", Json::parse(session::decisions_json(scene.plan))}};
}

Json sensor_json(const sensors::Sensor& sensor) {
  const sensors::Display& display = sensor.display;
  const sensors::GreyScale grey(sensor);
  return {{"name", sensor.name},
          {"columns", sensor.scan.columns},
          {"field_of_view_deg", core::degrees(sensor.scan.field_of_view_rad)},
          {"range_minimum_m", sensor.range.minimum_m},
          {"range_cell_m", sensor.range.cell_m},
          {"range_cells", sensor.range.cells},
          {"cscope_rows", display.cscope_rows},
          {"cscope_top_deg", core::degrees(display.cscope_top_rad)},
          {"cscope_span_deg", core::degrees(display.cscope_span_rad)},
          {"tilt_deg", core::degrees(sensor.antenna.boresight_elevation_rad)},
          {"mounting_yaw_deg", core::degrees(sensor.mounting.yaw_rad)},
          {"low_dB", grey.low_dB()},
          {"high_dB", grey.high_dB()}};
}

std::optional<double> told_visibility_m(const atmosphere::Weather& weather) {
  if (weather.visibility_m || !(weather.liquid_water_g_per_m3.value_or(0.0) > 0.0))
    return weather.visibility_m;
  return atmosphere::visibility_m(weather.fog_water_model, *weather.liquid_water_g_per_m3);
}

Json weather_json(const atmosphere::Weather& weather) {
  const std::optional<double> visibility_m = told_visibility_m(weather);
  return {{"rain_rate_mm_per_h", weather.rain_rate_mm_per_h},
          {"snow_rate_mm_per_h", weather.snow_rate_mm_per_h},
          {"visibility_m", visibility_m ? Json(*visibility_m) : Json(nullptr)},
          {"melting_layer", atmosphere::precipitation_layers(weather).melting}};
}

Json truth_json(const CellTruth& cell) {
  Json told{{"seen", cell.seen}};
  if (!cell.seen) return told;
  told["object"] = cell.object;
  told["material"] = cell.material.empty() ? Json(nullptr) : Json(cell.material);
  told["visibility"] = cell.visibility;
  told["double_bounce"] = cell.double_bounce;
  told["grazing_deg"] = core::degrees(cell.grazing_rad);
  if (cell.elevation_rad) told["elevation_deg"] = core::degrees(*cell.elevation_rad);
  if (cell.range_m) told["range_m"] = *cell.range_m;
  told["nrcs_dB"] = cell.nrcs > 0.0 ? Json(10.0 * std::log10(cell.nrcs)) : Json(nullptr);
  return told;
}

// Left and right of the first end, right and left of the other, as seen from the first.
Json map_json(const scenes::Scene& scene) {
  Json runways = Json::array();
  for (const scenes::RunwayDescription& runway : scene.description.runways) {
    const glm::dvec3 from_m = scene.frame.to_local_m(runway.ends[0].pavement_end);
    const glm::dvec3 to_m = scene.frame.to_local_m(runway.ends[1].pavement_end);
    const glm::dvec2 along = glm::normalize(glm::dvec2(to_m - from_m));
    const glm::dvec3 left_m = 0.5 * runway.width_m * glm::dvec3(-along.y, along.x, 0.0);
    Json corners = Json::array();
    for (const glm::dvec3& corner_m :
         {from_m + left_m, from_m - left_m, to_m - left_m, to_m + left_m}) {
      const core::Geodetic corner = scene.frame.to_geodetic(corner_m);
      corners.push_back({core::degrees(corner.latitude_rad), core::degrees(corner.longitude_rad)});
    }
    runways.push_back(
        {{"name", runway.ends[0].name + "/" + runway.ends[1].name}, {"corners", corners}});
  }
  return {{"runways", runways}};
}

}  // namespace fanbeam::live
