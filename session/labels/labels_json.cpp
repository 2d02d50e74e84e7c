#include "session/labels/labels_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/units.h"
#include "session/records/record_json.h"

namespace fanbeam::session {
namespace {

using Json = nlohmann::ordered_json;

// A ten-millionth: less than any of it is good for.
double rounded(double value) { return std::round(value * 1e7) / 1e7; }

Json spot_json(const std::optional<PictureSpot>& spot) {
  if (!spot) return nullptr;
  return {{"x", rounded(spot->at_px.x)}, {"y", rounded(spot->at_px.y)}, {"inside", spot->inside}};
}

Json degrees_json(const std::optional<double>& angle_rad) {
  if (!angle_rad) return nullptr;
  return rounded(core::degrees(*angle_rad));
}

Json place_json(const PlaceLabel& place) {
  return {{"latitude_deg", core::degrees(place.position.latitude_rad)},
          {"longitude_deg", core::degrees(place.position.longitude_rad)},
          {"height_m", rounded(place.position.height_m)},
          {"range_m", rounded(place.range_m)},
          {"bearing_deg", rounded(core::degrees(place.bearing_rad))},
          {"azimuth_deg", degrees_json(place.azimuth_rad)},
          {"elevation_deg", degrees_json(place.elevation_rad)},
          {"bscope", spot_json(place.bscope)},
          {"cscope", spot_json(place.cscope)},
          {"in_sight", place.in_sight}};
}

Json corners_json(const std::array<PlaceLabel, 4>& corners) {
  return {{"near_left", place_json(corners[0])},
          {"near_right", place_json(corners[1])},
          {"far_right", place_json(corners[2])},
          {"far_left", place_json(corners[3])}};
}

Json mask_json(const MaskLabel& mask, int columns, int rows) {
  return {{"cells", mask.cells.size()},
          {"box", {mask.left, mask.top, mask.columns, mask.rows}},
          {"runs", runs_of(mask, static_cast<std::uint32_t>(columns * rows))}};
}

const char* word(ObjectGroup group) {
  constexpr const char* kWords[] = {"building", "box", "model", "lights", "target"};
  return kWords[static_cast<std::size_t>(group)];
}

const char* word(Placement placement) {
  constexpr const char* kWords[] = {"on_runway", "beside_runway", "elsewhere"};
  return kWords[static_cast<std::size_t>(placement)];
}

// What has cells is in view with some of it, though no triangle's middle is.
const char* view_word(double share, const MaskLabel& bscope) {
  return share >= 1.0 ? "in_view" : share > 0.0 || !bscope.cells.empty() ? "cut" : "outside";
}

Json runway_json(const RunwayLabel& runway, const sensors::Sensor& sensor) {
  const int columns = sensor.scan.columns;
  return {{"near_end", runway.near_end},
          {"far_end", runway.far_end},
          {"length_m", rounded(runway.length_m)},
          {"width_m", runway.width_m},
          {"aircraft",
           {{"along_track_m", rounded(runway.along_track_m)},
            {"cross_track_m", rounded(runway.cross_track_m)},
            {"above_threshold_m", rounded(runway.above_m)}}},
          {"corners", corners_json(runway.corners)},
          {"thresholds",
           {{"near", place_json(runway.thresholds[0])}, {"far", place_json(runway.thresholds[1])}}},
          {"touchdown_zone", corners_json(runway.touchdown_zone)},
          {"in_sight_share", rounded(runway.in_sight_share)},
          {"in_view_share", rounded(runway.in_view_share)},
          {"view", view_word(runway.in_view_share, runway.bscope)},
          {"bscope", mask_json(runway.bscope, columns, sensor.range.cells)},
          {"cscope", mask_json(runway.cscope, columns, sensor.display.cscope_rows)}};
}

Json object_json(const ObjectLabel& object, const sensors::Sensor& sensor) {
  const int columns = sensor.scan.columns;
  Json json = {{"name", object.name},
               {"group", word(object.group)},
               {"placement", word(object.placement)},
               {"ids", object.ids},
               {"middle", place_json(object.middle)},
               {"height_m", rounded(object.height_m)},
               {"in_sight_share", rounded(object.in_sight_share)},
               {"in_view_share", rounded(object.in_view_share)},
               {"view", view_word(object.in_view_share, object.bscope)},
               {"signal_to_clutter_dB", nullptr},
               {"bscope", mask_json(object.bscope, columns, sensor.range.cells)},
               {"cscope", mask_json(object.cscope, columns, sensor.display.cscope_rows)}};
  if (object.signal_to_clutter_dB)
    json["signal_to_clutter_dB"] = rounded(*object.signal_to_clutter_dB);
  if (!object.points.empty()) {
    json["points"] = Json::array();
    for (const PlaceLabel& point : object.points) json["points"].push_back(place_json(point));
  }
  return json;
}

Json moving_pose_json(const core::Pose& pose) {
  Json json = Json::parse(pose_json(pose));
  json["north_mps"] = pose.v_N_mps.x;
  json["east_mps"] = pose.v_N_mps.y;
  json["down_mps"] = pose.v_N_mps.z;
  return json;
}

Json weather_json(const atmosphere::Weather& weather) {
  return {{"fog", atmosphere::has_fog(weather)},
          {"visibility_m", weather.visibility_m ? Json(*weather.visibility_m) : Json(nullptr)},
          {"rain", atmosphere::has_rain(weather)},
          {"rain_rate_mm_per_h", weather.rain_rate_mm_per_h},
          {"snow_rate_mm_per_h", weather.snow_rate_mm_per_h}};
}

}  // namespace

std::vector<std::uint32_t> runs_of(const MaskLabel& mask, std::uint32_t cells) {
  std::vector<std::uint32_t> runs = {0};
  std::uint32_t next = 0;  // the first cell that is not counted yet
  bool inside = false;
  for (const std::uint32_t cell : mask.cells) {
    if (cell > next || !inside) {
      if (inside) runs.push_back(0);
      runs.back() += cell - next;
      runs.push_back(0);
    }
    inside = true;
    ++runs.back();
    next = cell + 1;
  }
  if (next < cells) {
    if (inside) runs.push_back(0);
    runs.back() += cells - next;
  }
  return runs;
}

std::string labels_json(const FrameLabels& labels, const scenes::Scene& scene, std::uint64_t frame,
                        const core::Pose& pose, const core::Metadata& metadata) {
  const sensors::Sensor& sensor = scene.description.sensor;
  Json json = {
      {"fanbeam_labels", 1},
      {"scene", scene.description.name},
      {"frame", frame},
      {"time_s", pose.time_s},
      {"pose", moving_pose_json(pose)},
      {"weather", weather_json(scene.weather)},
      {"bscope", {{"columns", sensor.scan.columns}, {"rows", sensor.range.cells}}},
      {"cscope", {{"columns", sensor.scan.columns}, {"rows", sensor.display.cscope_rows}}}};
  json["runways"] = Json::array();
  for (const RunwayLabel& runway : labels.runways)
    json["runways"].push_back(runway_json(runway, sensor));
  json["objects"] = Json::array();
  for (const ObjectLabel& object : labels.objects)
    json["objects"].push_back(object_json(object, sensor));
  json["metadata"] = Json::object();
  for (const auto& [key, value] : metadata) json["metadata"][key] = value;
  return json.dump() + "\n";
}

core::Metadata labels_metadata(const std::string& text, const std::string& name) {
  core::Metadata metadata;
  try {
    const Json json = Json::parse(text);
    for (const auto& [key, value] : json.at("metadata").items())
      metadata.emplace_back(key, value.get<std::string>());
  } catch (const nlohmann::json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{name}, "labels", error.what(),
                            "a file of the product labels");
  }
  return metadata;
}

}  // namespace fanbeam::session
