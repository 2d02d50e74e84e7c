#include "scenes/new_scene/scene_draft.h"

#include <algorithm>
#include <string_view>

#include "core/units.h"
#include "scenes/new_scene/words.h"

namespace fanbeam::scenes {
namespace {

using core::VerticalDatum;

constexpr std::size_t kCommentColumn = 42;

std::string name_of(VerticalDatum datum) {
  return datum == VerticalDatum::egm96 ? "egm96" : "ellipsoid";
}

// Lines of TOML with comments in one column.
class Lines {
 public:
  void text(const std::string& line) { text_ += line + "\n"; }
  // Whole sentences, as many lines as they take.
  void remark(const std::string& words) {
    constexpr std::size_t kWidth = 98;
    std::string line = "#";
    for (std::size_t from = 0; from < words.size();) {
      const std::size_t blank = std::min(words.find(' ', from), words.size());
      if (line.size() + 1 + blank - from > kWidth && line != "#") {
        text(line);
        line = "#";
      }
      line += " " + words.substr(from, blank - from);
      from = blank + 1;
    }
    text(line);
  }
  void table(const std::string& header, const std::string& comment = "") {
    text_ += "\n";
    line(header, comment);
  }
  void key(std::string_view name, const std::string& value, const std::string& comment) {
    line(std::string(name) + " = " + value, comment);
  }
  // A key to try, switched off.
  void idea(const std::string& line) { text_ += "# " + line + "\n"; }

  const std::string& all() const { return text_; }

 private:
  void line(std::string text, const std::string& comment) {
    if (!comment.empty()) {
      text.resize(std::max(text.size() + 2, kCommentColumn), ' ');
      text += "# " + comment;
    }
    text_ += text + "\n";
  }

  std::string text_;
};

void add_scene(Lines& lines, const SceneDraft& draft) {
  lines.text("# " + safe_words(draft.title) + ".");
  lines.remark("Written by fanbeam init; runway from " + safe_words(draft.source) +
               ". Every key: docs/scene-format.md.");
  lines.text("# Lengths are metres, angles degrees. Not for navigation.");
  lines.text("#   fanbeam validate FOLDER             is it right?");
  lines.text("#   fanbeam render FOLDER --frames 0    the first picture");
  lines.table("[scene]");
  lines.key("name", toml_text(draft.name), "names the output folder");
  lines.key("title", toml_text(draft.title), "one line for people");
  const core::Geodetic& origin = draft.origin;
  lines.text("# Of the local frame: the threshold that is landed on.");
  lines.text("origin = { latitude_deg = " + rounded(core::degrees(origin.latitude_rad), 7) +
             ", longitude_deg = " + rounded(core::degrees(origin.longitude_rad), 7) +
             ", height_m = " + rounded(origin.height_m, 2) + " }");
  lines.remark(
      "Heights of terrain and runway count from " +
      std::string(draft.datum == VerticalDatum::egm96 ? "mean sea level" : "the ellipsoid") + ": " +
      draft.datum_why + ".");
  lines.key("vertical_datum", toml_text(name_of(draft.datum)),
            "egm96 is mean sea level, the other \"ellipsoid\"");
}

void add_terrain(Lines& lines, const SceneDraft& draft) {
  lines.table("[terrain]");
  lines.key("elevation", toml_text(draft.elevation), "in this folder or a data folder");
  if (draft.fill_voids)
    lines.key("voids", toml_text("fill"), "posts without a height, filled from around");
  if (draft.quantisation_step_m > 0.0)
    lines.key("quantisation_step_m", rounded(draft.quantisation_step_m, 2),
              "whole metres in the file: smooths their terraces");
  const double west_m = draft.west_m;
  if (west_m == draft.east_m && west_m == draft.south_m && west_m == draft.north_m) {
    lines.key("half_extent_m", rounded(west_m, 0), "from the origin to each side");
  } else {
    lines.key("west_m", rounded(west_m, 0), "from the origin to each side, cut to the file");
    lines.key("east_m", rounded(draft.east_m, 0), "");
    lines.key("south_m", rounded(draft.south_m, 0), "");
    lines.key("north_m", rounded(draft.north_m, 0), "");
  }
  lines.key("spacing_m", rounded(draft.spacing_m, 1), "between posts");
  lines.key("material", toml_text("short_grass"), "of all ground: try \"crops\", or land cover:");
  lines.idea(
      "land_cover = { file = \"classes.tif\", classes = { 1 = \"forest\", 2 = \"crops\" } }");
}

std::string end_text(const SceneDraft& draft, int end) {
  const AirportRunwayEnd& at = draft.landing.runway.ends[end];
  return "{ name = " + toml_text(at.name) +
         ", latitude_deg = " + rounded(core::degrees(at.pavement_end.latitude_rad), 7) +
         ", longitude_deg = " + rounded(core::degrees(at.pavement_end.longitude_rad), 7) +
         ", elevation_m = " + rounded(draft.end_height_m[end], 2) +
         (at.displaced_m > 0.0 ? ", displaced_m = " + rounded(at.displaced_m, 1) : "") + " }";
}

void add_lights(Lines& lines, const SceneDraft& draft) {
  const AirportRunway& runway = draft.landing.runway;
  const AirportRunwayEnd& landing = draft.landing.threshold_end();
  lines.key("edge_lights", runway.edge_lights.value_or(true) ? "true" : "false",
            runway.edge_lights ? "fixtures reflect" : "assumed: the data do not say");
  if (landing.approach_lights.value_or(false))
    lines.key("approach_lights", toml_text(landing.name), "900 m of them before this threshold");
  else
    lines.idea("approach_lights = " + toml_text(landing.name) + "  # " +
               (landing.approach_lights ? "none in the data" : "the data do not say"));
}

void add_runway(Lines& lines, const SceneDraft& draft) {
  const AirportRunway& runway = draft.landing.runway;
  lines.table("[[runway]]", "ends of the pavement; the ground is flattened between them");
  const bool all_known = draft.end_height_known[0] && draft.end_height_known[1];
  if (!all_known) lines.text("# An elevation that the runway data lack is that of the terrain.");
  lines.text("first = " + end_text(draft, 0));
  lines.text("second = " + end_text(draft, 1));
  lines.key("width_m", rounded(draft.width_m, 1),
            runway.width_m > 0.0 ? "of the pavement" : "assumed: the data do not say");
  const bool shoulders = runway.shoulders.value_or(runway.surface.paved);
  lines.key("shoulder_m", shoulders ? "7.5" : "0.0",
            runway.shoulders ? "on each side" : "on each side, assumed");
  lines.key("surface", toml_text(runway.surface.material),
            runway.surface.known ? "the data say " + safe_words(runway.surface.as_found)
                                 : "assumed: the data do not say");
  lines.key("markings", runway.markings.value_or(runway.surface.paved) ? "true" : "false",
            runway.markings ? "painted as ICAO Annex 14 has it" : "painted, assumed");
  add_lights(lines, draft);
}

void add_buildings(Lines& lines, const SceneDraft& draft) {
  if (draft.buildings_file.empty()) {
    lines.text("");
    lines.idea("[[buildings]]  # GeoJSON footprints: try fanbeam init --buildings FILE");
    return;
  }
  lines.table("[[buildings]]");
  lines.key("file", toml_text(draft.buildings_file), "GeoJSON footprints");
  if (!draft.buildings.height_property.empty())
    lines.key("height_property", toml_text(draft.buildings.height_property), "metres over ground");
  if (const auto& underside = draft.buildings.min_height_property)
    lines.key("min_height_property", toml_text(*underside),
              underside->empty() ? "none: all stand on the ground" : "of the underside");
  lines.key("wall", toml_text("wall"), "a material: brick, metal, concrete");
  lines.key("roof", toml_text("roof"), "");
}

void add_weather(Lines& lines) {
  lines.table("[weather]", "remove it for clear air");
  lines.key("visibility_m", "300.0", "fog that eyes see this far in");
  lines.key("fog_type", toml_text("kunkel"), "turns visibility into liquid water");
  lines.key("fog_top_m", "120.0", "above the origin");
  lines.key("temperature_C", "8.0", "at the origin");
  lines.idea("rain_rate_mm_per_h = 10.0             # try rain; effects: fanbeam plan FOLDER");
  lines.table("[sensor]");
  lines.key("file", toml_text("hivision.toml"), "a shipped radar, or a file in this folder");
}

void add_ils(Lines& lines, const SceneDraft& draft) {
  lines.table("[trajectory.ils]", "an instrument approach that nobody recorded");
  lines.key("runway", toml_text(draft.landing.threshold_end().name), "the end that is landed on");
  lines.key("glide_path_deg", rounded(draft.glide_path_deg, 2), "");
  lines.key("threshold_crossing_height_m", rounded(draft.threshold_crossing_height_m, 1),
            "above the threshold");
  lines.key("start_distance_m", rounded(draft.start_distance_m, 0), "before the threshold");
  lines.key("speed_mps", "70.0", "through the air");
  lines.key("end", toml_text("touchdown"), "or decision_height, full_stop");
  lines.idea("wind_speed_mps = 8.0                  # try crab: wind from the side");
  lines.idea("wind_from_deg = " +
             rounded(core::wrap_360_deg(core::degrees(draft.landing.bearing_rad) + 90.0), 0) +
             "                 # true, from the right");
  lines.idea("turbulence_wind_20ft_mps = 7.7        # light gusts");
}

void add_track(Lines& lines, const SceneDraft& draft) {
  const TrackGuess& track = draft.track;
  const TrajectoryColumns& columns = track.columns;
  lines.table("[trajectory]");
  lines.key("file", toml_text(draft.track_file), "the recorded flight");
  lines.key("vertical_datum", toml_text(name_of(track.datum)), "what its heights count from");
  if (columns.height_offset_m != 0.0)
    lines.key("height_offset_m", rounded(columns.height_offset_m, 1), "added to every height");
  lines.key("from_time_s", rounded(columns.from_time_s.value_or(0.0), 3),
            "the approach, of the file's clock");
  lines.key("to_time_s", rounded(columns.to_time_s.value_or(0.0), 3), "while above the runway");
  lines.table("[trajectory.columns]", "which of the file's columns is what, and its unit");
  const auto add = [&](const char* key, const TrajectoryColumn& column) {
    if (column.name.empty()) return;
    lines.key(key, toml_text(column.name), "");
    lines.key(std::string(key) + "_unit", toml_text(column.unit), "");
  };
  add("time", columns.time);
  add("latitude", columns.latitude);
  add("longitude", columns.longitude);
  add("height", columns.height);
  add("roll", columns.roll);
  add("pitch", columns.pitch);
  add("heading", columns.heading);
}

}  // namespace

std::string scene_text(const SceneDraft& draft) {
  Lines lines;
  add_scene(lines, draft);
  add_terrain(lines, draft);
  add_runway(lines, draft);
  add_buildings(lines, draft);
  add_weather(lines);
  if (draft.track_file.empty())
    add_ils(lines, draft);
  else
    add_track(lines, draft);
  return lines.all();
}

}  // namespace fanbeam::scenes
