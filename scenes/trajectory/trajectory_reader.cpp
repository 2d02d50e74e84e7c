#include "scenes/trajectory/trajectory_reader.h"

#include "core/units.h"
#include "scenes/object_reader.h"

namespace fanbeam::scenes {
namespace {

using core::ConfigTable;
using core::degrees;
using core::radians;

void read_column(ConfigTable& columns, std::string_view key, TrajectoryColumn& column) {
  // Who names a column counts on it.
  if (columns.has(key)) column.may_be_missing = false;
  column.name = columns.text(key, column.name);
  column.unit = columns.text(std::string(key) + "_unit", column.unit);
}

// Which simulator's packets the file holds, if it holds any.
void read_packets(ConfigTable& table, const std::filesystem::path& file, TrackPackets& packets) {
  const bool capture = file.extension() == ".pcap" || file.extension() == ".pcapng";
  if (!table.has("protocol")) {
    if (capture)
      table.error(core::ErrorClass::ref, "protocol", "missing",
                  "\"native-fdm\", \"fg-generic\" or \"xplane\": whose packets the capture holds");
    if (table.has("port"))
      table.error(core::ErrorClass::ref, "port", "without a protocol", "protocol beside it");
    return;
  }
  static_assert(feeds::kProtocols.size() == 3, "all of them are named here");
  packets.protocol = &feeds::kProtocols[table.choice(
      "protocol", {feeds::kProtocols[0].name, feeds::kProtocols[1].name, feeds::kProtocols[2].name},
      0)];
  if (table.has("port"))
    packets.port = static_cast<std::uint16_t>(table.integer("port", 1, 65535, 1));
  if (table.has("columns"))
    table.error(core::ErrorClass::ref, "columns", "beside protocol",
                "one of them: packets have no columns");
}

void read_columns(ConfigTable& table, TrajectoryColumns& columns) {
  ConfigTable names = table.table("columns");
  read_column(names, "time", columns.time);
  read_column(names, "latitude", columns.latitude);
  read_column(names, "longitude", columns.longitude);
  read_column(names, "height", columns.height);
  read_column(names, "roll", columns.roll);
  read_column(names, "pitch", columns.pitch);
  read_column(names, "heading", columns.heading);
  columns.height_offset_m = table.number("height_offset_m", {-20000, 20000}, 0.0);
  columns.from_time_s = table.optional_number("from_time_s", {});
  columns.to_time_s = table.optional_number("to_time_s", {});
  if (table.has("from_row")) columns.first_row = table.integer("from_row", 1, 1'000'000'000, 1);
  columns.outliers =
      static_cast<OutlierPolicy>(table.choice("outliers", {"error", "reject", "keep"}, 0));
  if (table.has("to_row")) columns.last_row = table.integer("to_row", 1, 1'000'000'000, 1);
}

void read_file_trajectory(ConfigTable& table, const DataSearch& search,
                          core::VerticalDatum scene_datum, TrajectoryDescription& trajectory) {
  trajectory.kind = TrajectoryDescription::Kind::file;
  trajectory.file = search.find(table, "file");
  read_packets(table, trajectory.file, trajectory.packets);
  read_columns(table, trajectory.columns);
  if (!table.has("vertical_datum"))
    table.error(core::ErrorClass::ref, "vertical_datum", "missing",
                "what the file's heights count from: \"ellipsoid\", \"egm96\" or \"scene\"");
  trajectory.datum = static_cast<core::VerticalDatum>(
      table.choice("vertical_datum", {"ellipsoid", "egm96", "scene"}, 2));
  if (scene_datum == core::VerticalDatum::scene && trajectory.datum != scene_datum &&
      !table.has("transplant"))
    table.error(core::ErrorClass::range, "vertical_datum", "a datum of its own",
                "\"scene\": the scene's heights count from an unknown level");
  trajectory.assumptions.angle_of_attack_rad = radians(table.number(
      "angle_of_attack_deg", {-10, 20}, degrees(trajectory.assumptions.angle_of_attack_rad)));
  ConfigTable from = table.table("transplant");
  if (!from.present()) return;
  trajectory.transplanted = true;
  trajectory.source_threshold.latitude_rad =
      radians(from.required_number("from_latitude_deg", {-90, 90}));
  trajectory.source_threshold.longitude_rad =
      radians(from.required_number("from_longitude_deg", {-180, 180}));
  trajectory.source_threshold.height_m = from.required_number("from_elevation_m", {-500, 6000});
  trajectory.source_bearing_rad = radians(from.required_number("from_bearing_deg", {-360, 360}));
  trajectory.onto_end = from.required_text("onto_runway");
}

void read_ils(ConfigTable& table, TrajectoryDescription& trajectory) {
  trajectory.kind = TrajectoryDescription::Kind::ils;
  ConfigTable ils = table.table("ils");
  IlsApproach& approach = trajectory.ils;
  trajectory.ils_end = ils.required_text("runway");
  const auto angle = [&](const char* key, core::NumberRange range_deg, double& value_rad) {
    value_rad = radians(ils.number(key, range_deg, degrees(value_rad)));
  };
  angle("glide_path_deg", {1, 10}, approach.glide_path_rad);
  approach.threshold_crossing_height_m =
      ils.number("threshold_crossing_height_m", {5, 50}, approach.threshold_crossing_height_m);
  if (const auto course_deg = ils.optional_number("localiser_course_deg", {0, 360}))
    approach.localiser_course_rad = radians(*course_deg);
  approach.crossing_distance_m = ils.optional_number("crossing_distance_m", {0, 20000});
  approach.start_distance_m =
      ils.number("start_distance_m", {50, 100000}, approach.start_distance_m);
  approach.speed_mps = ils.number("speed_mps", {15, 150}, approach.speed_mps);
  approach.speed_kind = ils.choice("speed_kind", {"true_air", "ground"}, 0) == 0
                            ? SpeedKind::true_air
                            : SpeedKind::ground;
  approach.wind_speed_mps = ils.number("wind_speed_mps", {0, 40}, 0.0);
  angle("wind_from_deg", {0, 360}, approach.wind_from_rad);
  approach.turbulence_wind_20ft_mps = ils.number("turbulence_wind_20ft_mps", {0, 60}, 0.0);
  approach.seed = static_cast<std::uint64_t>(ils.integer("seed", 0, 1'000'000'000, 1));
  angle("angle_of_attack_deg", {-10, 20}, approach.angle_of_attack_rad);
  approach.end =
      static_cast<ApproachEnd>(ils.choice("end", {"decision_height", "touchdown", "full_stop"}, 1));
  approach.decision_height_m =
      ils.number("decision_height_m", {20, 300}, approach.decision_height_m);
  approach.flare_height_m = ils.number("flare_height_m", {1, 50}, approach.flare_height_m);
  approach.touchdown_sink_mps =
      ils.number("touchdown_sink_mps", {0.1, 3}, approach.touchdown_sink_mps);
  approach.height_on_ground_m =
      ils.number("height_on_ground_m", {0, 15}, approach.height_on_ground_m);
}

void read_fixed(ConfigTable& table, TrajectoryDescription& trajectory) {
  trajectory.kind = TrajectoryDescription::Kind::fixed;
  ConfigTable fixed = table.table("fixed");
  trajectory.at = read_spot(fixed, "at");
  trajectory.above_ground_m = fixed.required_number("above_ground_m", {-1000, 20000});
  trajectory.heading_rad = radians(fixed.number("heading_deg", {-360, 360}, 0.0));
  trajectory.pitch_rad = radians(fixed.number("pitch_deg", {-90, 90}, 0.0));
  trajectory.roll_rad = radians(fixed.number("roll_deg", {-180, 180}, 0.0));
}

void read_flight_volume(ConfigTable& root, FlightHeights& heights) {
  constexpr core::NumberRange kFlightHeight_m{-1000, 50000};
  ConfigTable table = root.table("flight_volume");
  heights.stated = table.present();
  heights.place = table.place("");
  heights.lowest_m = table.optional_number("lowest_m", kFlightHeight_m);
  heights.highest_m = table.optional_number("highest_m", kFlightHeight_m);
  if (heights.lowest_m && heights.highest_m && *heights.lowest_m > *heights.highest_m)
    table.error(core::ErrorClass::range, "highest_m", core::number_text(*heights.highest_m),
                "at least lowest_m, " + core::number_text(*heights.lowest_m));
}

}  // namespace

void read_trajectory(ConfigTable& root, const DataSearch& search, SceneDescription& scene) {
  ConfigTable table = root.table("trajectory");
  TrajectoryDescription& trajectory = scene.trajectory;
  trajectory.place = root.place("trajectory");
  read_flight_volume(root, scene.flight_heights);
  const int kinds =
      (table.has("file") ? 1 : 0) + (table.has("ils") ? 1 : 0) + (table.has("fixed") ? 1 : 0);
  if (!table.present()) return;  // poses come from elsewhere
  if (kinds != 1) {
    root.error(core::ErrorClass::ref, "trajectory", kinds == 0 ? "empty" : "more than one kind",
               "exactly one of: file = \"....csv\", [trajectory.ils], [trajectory.fixed]");
    return;
  }
  if (table.has("file")) read_file_trajectory(table, search, scene.datum, trajectory);
  if (table.has("ils")) read_ils(table, trajectory);
  if (table.has("fixed")) read_fixed(table, trajectory);
}

}  // namespace fanbeam::scenes
