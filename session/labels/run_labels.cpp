#include "session/labels/run_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/files.h"
#include "core/units.h"
#include "session/version.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kCorners = {"near_left", "near_right", "far_right",
                                                 "far_left"};
constexpr std::array<const char*, 6> kCategories = {"runway", "building", "box",
                                                    "model",  "lights",   "target"};

int category_of(const std::string& group) {
  return static_cast<int>(std::find(kCategories.begin(), kCategories.end(), group) -
                          kCategories.begin()) +
         1;
}

class Coco {
 public:
  Coco() {
    json_ = {{"info", {{"description", "radar pictures by fanbeam " + version_text()}}},
             {"licenses", Json::array()},
             {"images", Json::array()},
             {"annotations", Json::array()},
             {"categories", Json::array()}};
    for (const char* name : kCategories)
      json_["categories"].push_back(
          {{"id", category_of(name)},
           {"name", name},
           {"supercategory", std::string(name) == "runway" ? "runway" : "object"}});
    Json& runway = json_["categories"][0];
    runway["keypoints"] = kCorners;
    runway["skeleton"] = {{1, 2}, {2, 3}, {3, 4}, {4, 1}};
  }

  void add(const Json& frame, const std::string& scope, const std::string& file) {
    const int columns = frame[scope]["columns"], rows = frame[scope]["rows"];
    const std::size_t image = json_["images"].size() + 1;
    json_["images"].push_back({{"id", image},
                               {"file_name", file},
                               {"width", columns},
                               {"height", rows},
                               {"frame", frame["frame"]},
                               {"time_s", frame["time_s"]}});
    for (const Json& runway : frame["runways"]) {
      Json points = Json::array();
      int seen = 0;
      for (const char* name : kCorners) {
        const Json& corner = runway["corners"][name];
        const Json& spot = corner[scope];
        const bool inside = !spot.is_null() && spot["inside"].get<bool>();
        points.push_back(inside ? spot["x"] : Json(0));
        points.push_back(inside ? spot["y"] : Json(0));
        points.push_back(inside ? (corner["in_sight"].get<bool>() ? 2 : 1) : 0);
        if (inside) ++seen;
      }
      if (seen == 0 && runway[scope]["cells"] == 0) continue;
      Json& made = annotate(runway[scope], image, "runway", columns, rows);
      made["keypoints"] = std::move(points);
      made["num_keypoints"] = seen;
      made["attributes"] = {{"near_end", runway["near_end"]},
                            {"in_sight_share", runway["in_sight_share"]},
                            {"in_view_share", runway["in_view_share"]}};
    }
    for (const Json& object : frame["objects"]) {
      if (object[scope]["cells"] == 0) continue;
      Json& made = annotate(object[scope], image, object["group"], columns, rows);
      made["attributes"] = {{"name", object["name"]},
                            {"placement", object["placement"]},
                            {"in_sight_share", object["in_sight_share"]},
                            {"signal_to_clutter_dB", object["signal_to_clutter_dB"]}};
    }
  }

  std::string text() const { return json_.dump() + "\n"; }

 private:
  Json& annotate(const Json& mask, std::size_t image, const std::string& category, int columns,
                 int rows) {
    json_["annotations"].push_back({{"id", json_["annotations"].size() + 1},
                                    {"image_id", image},
                                    {"category_id", category_of(category)},
                                    {"bbox", mask["box"]},
                                    {"area", mask["cells"]},
                                    {"iscrowd", 0},
                                    {"segmentation",
                                     {{"size", {rows, columns}}, {"counts", mask["runs"]}}}});
    return json_["annotations"].back();
  }

  Json json_;
};

constexpr const char* kLardHead =
    "image;height;width;type;original_dataset;scenario;airport;runway;time_to_landing;weather;night;"
    "time;slant_distance;along_track_distance;height_above_runway;lateral_path_angle;"
    "vertical_path_angle;yaw;pitch;roll;watermark_height;x_A;y_A;x_B;y_B;x_C;y_C;x_D;y_D\n";

// 0 at south, to 180 at north by west and -180 at north by east.
double lard_yaw_deg(double heading_deg) {
  return core::wrap_360_deg(heading_deg) - 180.0;
}

// The corners by rising y, then x; nothing unless all are inside.
std::optional<std::string> lard_corners(const Json& runway, const std::string& scope) {
  std::vector<std::array<double, 2>> yx;
  for (const char* name : kCorners) {
    const Json& spot = runway["corners"][name][scope];
    if (spot.is_null() || !spot["inside"].get<bool>()) return std::nullopt;
    yx.push_back({spot["y"], spot["x"]});
  }
  std::sort(yx.begin(), yx.end());
  std::string text;
  for (const auto& [y, x] : yx) text += fmt::format(";{:.4f};{:.4f}", x, y);
  return text;
}

std::string seconds_to_landing(const Json& frame, const Json& runway, double along_m) {
  const Json &near = runway["thresholds"]["near"], &far = runway["thresholds"]["far"];
  const double bearing_rad = std::atan2(
      (far["longitude_deg"].get<double>() - near["longitude_deg"].get<double>()) *
          std::cos(core::radians(near["latitude_deg"].get<double>())),
      far["latitude_deg"].get<double>() - near["latitude_deg"].get<double>());
  const double closing_mps =
      frame["pose"]["north_mps"].get<double>() * std::cos(bearing_rad) +
      frame["pose"]["east_mps"].get<double>() * std::sin(bearing_rad);
  if (!(closing_mps > 1.0) || along_m < 0.0) return "";
  return fmt::format("{:.2f}", along_m / closing_mps);
}

std::string lard_rows(const Json& frame, const std::string& scope, const std::string& file,
                      std::size_t frames, const std::string& weather) {
  constexpr double kNauticalMile_m = 1852.0;
  // LARD's path angles are seen from these places on the centre line, so far behind the threshold.
  constexpr double kLateralReference_m = 3050.0, kVerticalReference_m = 305.0;
  std::string rows;
  for (const Json& runway : frame["runways"]) {
    const auto corners = lard_corners(runway, scope);
    if (!corners) continue;
    const std::string airport = frame["scene"], end = runway["near_end"];
    const Json& at = runway["aircraft"];
    const double along_m = at["along_track_m"], cross_m = at["cross_track_m"],
                 above_m = at["above_threshold_m"];
    const double slant_m = runway["thresholds"]["near"]["range_m"];
    const Json& pose = frame["pose"];
    rows += fmt::format(
        "{};{};{};synthetic;fanbeam;{}_{}_{};{};{};{};{};;;{:.2f};{:.2f};{:.2f};{:.2f};{:.2f};{:.4f};"
        "{:.4f};{:.4f};0{}\n",
        file, frame[scope]["rows"].get<int>(), frame[scope]["columns"].get<int>(), airport, end,
        frames, airport, end, seconds_to_landing(frame, runway, along_m), weather,
        slant_m / kNauticalMile_m, along_m / kNauticalMile_m, above_m / core::kFoot_m,
        core::degrees(std::atan2(cross_m, along_m + kLateralReference_m)),
        core::degrees(std::atan2(above_m, along_m + kVerticalReference_m)),
        lard_yaw_deg(pose["heading_deg"]), 90.0 + pose["pitch_deg"].get<double>(),
        -pose["roll_deg"].get<double>(), *corners);
  }
  return rows;
}

std::string weather_word(const atmosphere::Weather& weather) {
  if (atmosphere::has_rain(weather)) return "rain";
  if (atmosphere::has_snow(weather)) return "snow";
  return atmosphere::has_fog(weather) ? "fog" : "";
}

std::string name_in(const FrameRecord& frame, const std::string& product) {
  for (const std::string& file : frame.files)
    if (file.starts_with(product + "/")) return file;
  return {};
}

}  // namespace

void write_run_labels(const fs::path& folder, const scenes::Scene& scene,
                      const std::vector<FrameRecord>& frames) {
  constexpr std::uint64_t kLargest_bytes = 1ULL << 28U;
  Coco coco;
  std::string all, lard = kLardHead;
  for (const FrameRecord& frame : frames) {
    const std::string name = name_in(frame, "labels");
    if (name.empty()) continue;
    const std::string text = core::read_file(folder / name, kLargest_bytes);
    all += (all.empty() ? "" : ",\n") + text.substr(0, text.find_last_not_of('\n') + 1);
    const Json json = Json::parse(text);
    for (const char* scope : {"bscope", "cscope"}) {
      const std::string file = name_in(frame, scope);
      if (file.empty()) continue;
      coco.add(json, scope, file);
      lard += lard_rows(json, scope, file, frames.size(), weather_word(scene.weather));
    }
  }
  core::write_file_atomically(folder / kRunLabelFiles[0],
                              "{\"fanbeam_labels\": 1, \"frames\": [\n" + all + "\n]}\n");
  core::write_file_atomically(folder / kRunLabelFiles[1], coco.text());
  core::write_file_atomically(folder / kRunLabelFiles[2], lard);
}

}  // namespace fanbeam::session
