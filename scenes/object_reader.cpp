#include "scenes/object_reader.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "core/decibel.h"
#include "core/files.h"
#include "core/spelling.h"
#include "core/units.h"
#include "scenes/airport_objects.h"
#include "scenes/target_reader.h"

namespace fanbeam::scenes {
namespace {

using core::ConfigTable;
using core::radians;

constexpr core::NumberRange kDistance_m{-100000.0, 100000.0};
constexpr std::size_t kMostAirports = 8;
constexpr std::size_t kMostInterferers = 1000;
constexpr std::size_t kMostRunways = 64;  // each flattens its strip of the terrain

void read_runway_end(ConfigTable& runway, const char* key, RunwayEndDescription& end) {
  ConfigTable table = runway.table(key);
  if (!table.present()) {
    runway.error(core::ErrorClass::ref, key, "missing",
                 "a table { name, latitude_deg, longitude_deg, elevation_m, displaced_m }");
    return;
  }
  end.name = table.required_text("name");
  end.pavement_end.latitude_rad = radians(table.required_number("latitude_deg", {-90, 90}));
  end.pavement_end.longitude_rad = radians(table.required_number("longitude_deg", {-180, 180}));
  end.pavement_end.height_m = table.required_number("elevation_m", {-500, 6000});
  end.displaced_m = table.number("displaced_m", {0, 3000}, 0.0);
  end.displaced_place = table.place("displaced_m");
}

RunwayDescription read_runway(ConfigTable& table) {
  RunwayDescription runway;
  runway.place = table.place("");
  read_runway_end(table, "first", runway.ends[0]);
  read_runway_end(table, "second", runway.ends[1]);
  runway.width_m = table.number("width_m", {5, 200}, runway.width_m);
  runway.shoulder_m = table.number("shoulder_m", {0, 100}, runway.shoulder_m);
  runway.surface = table.text("surface", runway.surface);
  runway.shoulder_material = table.text("shoulder", runway.shoulder_material);
  runway.marking_material = table.text("marking", runway.marking_material);
  runway.markings = table.boolean("markings", true);
  runway.strip_half_width_m =
      table.number("strip_half_width_m", {0, 1000}, runway.strip_half_width_m);
  runway.blend_m = table.number("blend_m", {1, 5000}, runway.blend_m);
  runway.edge_lights = table.boolean("edge_lights", true);
  if (const std::string end = table.text("approach_lights", ""); !end.empty())
    runway.approach_lights.push_back(end);
  runway.approach_light_slope = table.number("approach_light_slope", {0, 0.1}, 0.0);
  runway.light_rcs_m2 = rcs_m2_from(table, "light_rcs_dBsm", -10.0);
  ConfigTable fence = table.table("fence");
  if (fence.present()) {
    runway.fence_beyond_m = fence.number("beyond_m", {1, 5000}, 60.0);
    runway.fence_height_m = fence.number("height_m", {0.1, 20}, 2.4);
    runway.fence_spacing_m = fence.number("spacing_m", {0.5, 100}, 3.0);
    runway.fence_post_rcs_m2 = rcs_m2_from(fence, "post_rcs_dBsm", 0.0);
  }
  return runway;
}

SurfaceDescription read_surface(ConfigTable& table) {
  SurfaceDescription surface;
  surface.place = table.place("");
  surface.runway_end = table.required_text("runway");
  surface.material = table.required_text("material");
  const auto pair = [&](std::string_view key, double& from, double& to) {
    const std::vector<double> values = table.numbers(key, kDistance_m, 2, 2);
    if (!table.has(key)) table.error(core::ErrorClass::ref, key, "missing", "[from, to] in metres");
    if (values.size() != 2) return;
    from = values[0];
    to = values[1];
    if (!(to > from))
      table.error(core::ErrorClass::range, key, core::number_text(to),
                  "an end above its beginning");
  };
  pair("behind_threshold_m", surface.from_behind_m, surface.to_behind_m);
  pair("left_m", surface.from_left_m, surface.to_left_m);
  return surface;
}

void read_open_material(ConfigTable& table, const DataSearch& search, ModelDescription& model) {
  const std::string name = table.text("open_material", "");
  if (name.empty() || model.file.empty()) return;
  if (name != "auto") {
    model.open_material = search.find(table, "open_material");
    if (!model.open_material.empty())
      model.open_material_root = search.root_of(model.open_material);
    return;
  }
  std::filesystem::path beside = model.file;
  beside.replace_extension(".xoma");
  model.open_material_root = model.root;
  if (!core::lies_inside(model.root, beside))
    table.error(core::ErrorClass::path, "open_material", beside.filename().string(),
                "a file beside the model, and no link out of its folder");
  else if (std::filesystem::is_regular_file(beside))
    model.open_material = beside;
  else
    table.error(core::ErrorClass::io, "open_material", "\"auto\"",
                "the file " + beside.string() + " beside the model");
}

ModelDescription read_model(ConfigTable& table, const DataSearch& search) {
  ModelDescription model;
  model.place = table.place("");
  model.file = search.find(table, "file");
  if (!model.file.empty()) model.root = search.root_of(model.file);
  model.name = table.text("name", model.file.stem().string());
  model.at = read_spot(table, "at");
  if (table.has("height_m")) model.height_m = table.number("height_m", {-1000, 20000}, 0.0);
  model.above_ground_m = table.number("above_ground_m", {-100, 10000}, 0.0);
  if (model.height_m && table.has("above_ground_m"))
    table.error(core::ErrorClass::ref, "height_m", "beside above_ground_m",
                "one of the two: above the scene's datum, or above the ground");
  model.heading_rad = radians(table.number("heading_deg", kHeading_deg, 0.0));
  model.default_material = table.text("default_material", model.default_material);
  ConfigTable materials = table.table("materials");
  for (const std::string& key : materials.keys()) model.materials[key] = materials.text(key, "");
  read_open_material(table, search, model);
  return model;
}

BoxDescription read_box(ConfigTable& table) {
  BoxDescription box;
  box.place = table.place("");
  box.name = table.text("name", "box");
  box.at = read_spot(table, "at");
  box.length_m = table.required_number("length_m", {0.01, 5000});
  box.width_m = table.required_number("width_m", {0.01, 5000});
  box.height_m = table.required_number("height_m", {0.01, 1000});
  box.heading_rad = radians(table.number("heading_deg", kHeading_deg, 0.0));
  box.wall_material = table.text("wall", box.wall_material);
  box.roof_material = table.text("roof", box.roof_material);
  return box;
}

BuildingsDescription read_buildings(ConfigTable& table, const DataSearch& search) {
  BuildingsDescription buildings;
  buildings.place = table.place("");
  buildings.file = search.find(table, "file");
  buildings.height_property = table.text("height_property", buildings.height_property);
  buildings.min_height_property = table.text("min_height_property", buildings.min_height_property);
  buildings.base_is_mean = table.choice("base", {"lowest", "mean"}, 0) == 1;
  buildings.wall_material = table.text("wall", buildings.wall_material);
  buildings.roof_material = table.text("roof", buildings.roof_material);
  buildings.crs = table.text("crs", "");
  buildings.heights_as_filed = table.choice("heights", {"on_ground", "as_filed"}, 0) == 1;
  ConfigTable surfaces = table.table("surfaces");
  for (const std::string& key : surfaces.keys())
    buildings.surface_materials[key] = surfaces.text(key, "");
  const auto given = [&](std::initializer_list<const char*> keys) {
    std::vector<BuildingsDescription::Key> found;
    for (const char* key : keys)
      if (table.has(key)) found.push_back({table.path(key), table.place(key)});
    return found;
  };
  buildings.footprint_keys = given({"height_property", "min_height_property", "base"});
  buildings.city_keys = given({"crs", "heights", "surfaces"});
  return buildings;
}

// A slip in the name of a table of runways: those in it are not read.
bool is_misspelt_runway(const std::string& key) {
  constexpr std::size_t kSlip = 2;  // edits
  for (const std::string meant : {"runway", "airport"})
    if (key != meant && key.size() <= meant.size() + kSlip &&
        core::edit_distance(key, meant) <= kSlip)
      return true;
  return false;
}

void read_runways(ConfigTable& root, const DataSearch& search, ObjectNames& objects,
                  SceneDescription& scene) {
  std::set<std::string> ends;
  const auto check_ends = [&](ConfigTable& table, std::size_t first) {
    for (std::size_t i = first; i < scene.runways.size(); ++i)
      for (const RunwayEndDescription& end : scene.runways[i].ends) {
        scene.runways_known = scene.runways_known && !end.name.empty();
        if (!end.name.empty() && !ends.insert(end.name).second)
          table.error(core::ErrorClass::ref, "", "name \"" + end.name + "\" given twice",
                      "a name of its own for every runway end");
      }
  };
  std::vector<ConfigTable> runways = root.tables("runway", kMostRunways);
  for (ConfigTable& table : runways) {
    scene.runways.push_back(read_runway(table));
    check_ends(table, scene.runways.size() - 1);
  }
  std::vector<ConfigTable> airports = root.tables("airport", kMostAirports);
  const std::vector<std::string> keys = root.keys();
  if ((root.has("runway") && runways.empty()) || (root.has("airport") && airports.empty()) ||
      std::any_of(keys.begin(), keys.end(), is_misspelt_runway))
    scene.runways_known = false;
  for (ConfigTable& table : airports) {
    const std::size_t before = scene.runways.size(), told = root.problems().all().size();
    read_airport_table(table, search, objects, scene);
    scene.runways_known = scene.runways_known && root.problems().all().size() == told;
    check_ends(table, before);
  }
  if (scene.runways.size() > kMostRunways)
    root.error(core::ErrorClass::limit, "airport",
               std::to_string(scene.runways.size()) + " runways",
               "at most " + std::to_string(kMostRunways));
}

}  // namespace

Spot read_spot(ConfigTable& parent, std::string_view key) {
  ConfigTable table = parent.table(key);
  Spot spot;
  spot.field = parent.path(key);
  spot.place = parent.place(key);
  if (!table.present()) {
    if (!parent.has(key))
      parent.error(core::ErrorClass::ref, key, "missing",
                   "{ latitude_deg, longitude_deg } or { runway, behind_threshold_m, left_m }");
    return spot;
  }
  spot.on_runway = table.has("runway");
  if (spot.on_runway) {
    spot.runway_end = table.required_text("runway");
    spot.behind_threshold_m = table.required_number("behind_threshold_m", kDistance_m);
    spot.left_m = table.number("left_m", kDistance_m, 0.0);
  } else {
    spot.latitude_rad = radians(table.required_number("latitude_deg", {-90, 90}));
    spot.longitude_rad = radians(table.required_number("longitude_deg", {-180, 180}));
  }
  return spot;
}

void read_objects(ConfigTable& root, const DataSearch& search, ObjectNames& objects,
                  SceneDescription& scene) {
  read_runways(root, search, objects, scene);
  for (ConfigTable& table : root.tables("surface")) scene.surfaces.push_back(read_surface(table));
  for (ConfigTable& table : root.tables("model")) scene.models.push_back(read_model(table, search));
  for (ConfigTable& table : root.tables("box")) scene.boxes.push_back(read_box(table));
  for (ConfigTable& table : root.tables("buildings"))
    scene.buildings.push_back(read_buildings(table, search));
  HighwayPaths highway(search);
  WaypointBudget waypoints;
  std::size_t unnamed = 0;  // what has one name is one object in labels
  std::vector<ConfigTable> targets = root.tables("target");
  bool all_named = !root.has("target") || !targets.empty();  // or left without a name, but read
  for (ConfigTable& table : targets) {
    if (!table.has("name")) ++unnamed;
    all_named = all_named && (!table.has("name") || table.is_text("name"));
    const std::string usual_name =
        unnamed > 1 ? "target " + std::to_string(unnamed) : std::string("target");
    scene.targets.push_back(read_target(table, usual_name, objects, highway, waypoints,
                                        scene.sensor.waveform.polarisation));
  }
  for (const std::filesystem::path& file : highway.files()) scene.files.push_back(file);
  std::vector<std::string> names;
  for (const TargetDescription& target : scene.targets) names.push_back(target.name);
  for (ConfigTable& table : root.tables("interferer", kMostInterferers)) {
    scene.interferers.push_back(read_interferer(table, scene.sensor.waveform));
    const std::string& carrier = scene.interferers.back().target;
    const bool was_told = (carrier.empty() && !table.is_text("target")) ||
                          (root.problems().has_errors() && !all_named);
    if (std::find(names.begin(), names.end(), carrier) == names.end() && !was_told &&
        !root.problems().is_full())
      table.error(
          core::ErrorClass::ref, "target", "\"" + carrier + "\"",
          "the name of a [[target]] that carries it" + core::names_there_text(carrier, names));
  }
  for (ConfigTable& table : root.tables("line")) scene.lines.push_back(read_line(table, objects));
}

}  // namespace fanbeam::scenes
