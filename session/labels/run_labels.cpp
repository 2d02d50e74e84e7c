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

constexpr const char* kLardHead =
    "image;height;width;type;original_dataset;scenario;airport;runway;time_to_landing;weather;"
    "night;"
    "time;slant_distance;along_track_distance;height_above_runway;lateral_path_angle;"
    "vertical_path_angle;yaw;pitch;roll;watermark_height;x_A;y_A;x_B;y_B;x_C;y_C;x_D;y_D\n";

// 0 at south, to 180 at north by west and -180 at north by east.
double lard_yaw_deg(double heading_deg) { return core::wrap_360_deg(heading_deg) - 180.0; }

// The corners by rising y, then x; nothing unless all are inside.
std::optional<std::string> lard_corners(const Json& runway, const std::string& scope) {
  std::vector<std::array<double, 2>> yx;
  for (const char* name : kCorners) {
    const Json& spot = runway.at("corners").at(name).at(scope);
    if (spot.is_null() || !spot.at("inside").get<bool>()) return std::nullopt;
    yx.push_back({spot.at("y"), spot.at("x")});
  }
  std::sort(yx.begin(), yx.end());
  std::string text;
  for (const auto& [y, x] : yx) text += fmt::format(";{:.4f};{:.4f}", x, y);
  return text;
}

std::string seconds_to_landing(const Json& frame, const Json& runway, double along_m) {
  const Json &near = runway.at("thresholds").at("near"), &far = runway.at("thresholds").at("far");
  const auto degrees_on = [&](const char* angle) {
    return far.at(angle).get<double>() - near.at(angle).get<double>();
  };
  // The shorter way round: a runway may lie across the date line.
  const double east_deg = std::remainder(degrees_on("longitude_deg"), 360.0);
  const double bearing_rad =
      std::atan2(east_deg * std::cos(core::radians(near.at("latitude_deg").get<double>())),
                 degrees_on("latitude_deg"));
  const double closing_mps =
      frame.at("pose").at("north_mps").get<double>() * std::cos(bearing_rad) +
      frame.at("pose").at("east_mps").get<double>() * std::sin(bearing_rad);
  if (!(closing_mps > 1.0) || along_m < 0.0) return "";
  return fmt::format("{:.2f}", along_m / closing_mps);
}

std::string lard_rows(const Json& frame, const std::string& scope, const std::string& file,
                      std::size_t frames, const std::string& weather) {
  constexpr double kNauticalMile_m = 1852.0;
  // LARD's path angles are seen from these places on the centre line, so far behind the threshold.
  constexpr double kLateralReference_m = 3050.0, kVerticalReference_m = 305.0;
  std::string rows;
  for (const Json& runway : frame.at("runways")) {
    const auto corners = lard_corners(runway, scope);
    if (!corners) continue;
    const std::string airport = frame.at("scene"), end = runway.at("near_end");
    const Json& at = runway.at("aircraft");
    const double along_m = at.at("along_track_m"), cross_m = at.at("cross_track_m"),
                 above_m = at.at("above_threshold_m");
    const double slant_m = runway.at("thresholds").at("near").at("range_m");
    const Json& pose = frame.at("pose");
    rows += fmt::format(
        "{};{};{};synthetic;fanbeam;{}_{}_{};{};{};{};{};;;{:.2f};{:.2f};{:.2f};{:.2f};{:.2f};{:."
        "4f};"
        "{:.4f};{:.4f};0{}\n",
        file, frame.at(scope).at("rows").get<int>(), frame.at(scope).at("columns").get<int>(),
        airport, end, frames, airport, end, seconds_to_landing(frame, runway, along_m), weather,
        slant_m / kNauticalMile_m, along_m / kNauticalMile_m, above_m / core::kFoot_m,
        core::degrees(std::atan2(cross_m, along_m + kLateralReference_m)),
        core::degrees(std::atan2(above_m, along_m + kVerticalReference_m)),
        lard_yaw_deg(pose.at("heading_deg")), 90.0 + pose.at("pitch_deg").get<double>(),
        -pose.at("roll_deg").get<double>(), *corners);
  }
  return rows;
}

const char* weather_word(const Json& weather) {
  // Labels of earlier versions say nothing of rain cells.
  if (weather.value("rain", weather.at("rain_rate_mm_per_h") > 0.0)) return "rain";
  if (weather.at("snow_rate_mm_per_h") > 0.0) return "snow";
  return weather.at("fog").get<bool>() ? "fog" : "";
}

std::string name_in(const std::set<std::string>& files, const std::string& product) {
  for (const std::string& file : files)
    if (file.starts_with(product + "/")) return file;
  return {};
}

}  // namespace

struct RunLabels::Coco {
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
    const int columns = frame.at(scope).at("columns"), rows = frame.at(scope).at("rows");
    const std::size_t image = json_["images"].size() + 1;
    json_["images"].push_back({{"id", image},
                               {"file_name", file},
                               {"width", columns},
                               {"height", rows},
                               {"frame", frame.at("frame")},
                               {"time_s", frame.at("time_s")}});
    for (const Json& runway : frame.at("runways")) {
      Json points = Json::array();
      int seen = 0;
      for (const char* name : kCorners) {
        const Json& corner = runway.at("corners").at(name);
        const Json& spot = corner.at(scope);
        const bool inside = !spot.is_null() && spot.at("inside").get<bool>();
        points.push_back(inside ? spot.at("x") : Json(0));
        points.push_back(inside ? spot.at("y") : Json(0));
        points.push_back(inside ? (corner.at("in_sight").get<bool>() ? 2 : 1) : 0);
        if (inside) ++seen;
      }
      if (runway.at(scope).at("cells") == 0) continue;
      Json& made = annotate(runway.at(scope), image, "runway", columns, rows);
      made["keypoints"] = std::move(points);
      made["num_keypoints"] = seen;
      made["attributes"] = {{"near_end", runway.at("near_end")},
                            {"in_sight_share", runway.at("in_sight_share")},
                            {"in_view_share", runway.at("in_view_share")}};
    }
    for (const Json& object : frame.at("objects")) {
      if (object.at(scope).at("cells") == 0) continue;
      Json& made = annotate(object.at(scope), image, object.at("group"), columns, rows);
      made["attributes"] = {{"name", object.at("name")},
                            {"placement", object.at("placement")},
                            {"in_sight_share", object.at("in_sight_share")},
                            {"signal_to_clutter_dB", object.at("signal_to_clutter_dB")}};
    }
  }

  std::string text() const { return json_.dump() + "\n"; }

  Json& annotate(const Json& mask, std::size_t image, const std::string& category, int columns,
                 int rows) {
    json_["annotations"].push_back(
        {{"id", json_["annotations"].size() + 1},
         {"image_id", image},
         {"category_id", category_of(category)},
         {"bbox", mask.at("box")},
         {"area", mask.at("cells")},
         {"iscrowd", 0},
         {"segmentation", {{"size", {rows, columns}}, {"counts", mask.at("runs")}}}});
    return json_["annotations"].back();
  }

  Json json_;
};

RunLabels::RunLabels() : coco_(std::make_unique<Coco>()), lard_(kLardHead) {}
RunLabels::~RunLabels() = default;

void RunLabels::add(const std::string& prefix, const std::set<std::string>& files,
                    std::size_t frames,
                    const std::function<std::string(const std::string& name)>& text_of) {
  const std::string name = name_in(files, "labels");
  if (name.empty()) return;
  const std::string text = text_of(name);
  try {
    const Json json = Json::parse(text);
    for (const char* scope : {"bscope", "cscope"}) {
      const std::string picture = name_in(files, scope);
      if (picture.empty()) continue;
      coco_->add(json, scope, prefix + picture);
      lard_ += lard_rows(json, scope, prefix + picture, frames, weather_word(json.at("weather")));
    }
  } catch (const nlohmann::json::exception& error) {
    core::throw_input_error(core::ErrorClass::parse, core::Place{prefix + name}, "labels",
                            error.what(), "a file of the product labels");
  }
  all_ += (all_.empty() ? "" : ",\n") + text.substr(0, text.find_last_not_of('\n') + 1);
  ++frames_;
}

std::string RunLabels::all() const {
  return "{\"fanbeam_labels\": 1, \"frames\": [\n" + all_ + "\n]}\n";
}
std::string RunLabels::coco() const { return coco_->text(); }
std::string RunLabels::lard() const { return lard_; }

void write_run_labels(const fs::path& folder, const std::vector<FrameRecord>& frames) {
  RunLabels labels;
  for (const FrameRecord& frame : frames)
    labels.add("", frame.files, frames.size(), [&](const std::string& name) {
      return core::read_file(folder / name, kLargestLabels_bytes);
    });
  core::write_file_atomically(folder / kRunLabelFiles[0], labels.all());
  core::write_file_atomically(folder / kRunLabelFiles[1], labels.coco());
  core::write_file_atomically(folder / kRunLabelFiles[2], labels.lard());
}

}  // namespace fanbeam::session
