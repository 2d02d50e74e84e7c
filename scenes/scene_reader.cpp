#include "scenes/scene_reader.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "core/files.h"
#include "core/text.h"
#include "core/units.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/plan.h"
#include "scenes/data_search.h"
#include "scenes/object_reader.h"
#include "scenes/scene_surfaces.h"
#include "scenes/trajectory/trajectory_reader.h"
#include "scenes/weather_reader.h"
#include "sensors/display/grey_reader.h"
#include "sensors/display/grey_scale.h"
#include "sensors/sensor_file.h"
#include "terrain/raster/land_cover_raster.h"

namespace fanbeam::scenes {
namespace {

namespace fs = std::filesystem;
using core::ConfigTable;
using core::radians;

constexpr core::NumberRange kExtent_m{10.0, 200000.0};

// A scene may not open the rest of the machine to itself: its own data folders lie inside it.
std::vector<fs::path> read_data_folders(ConfigTable& root, const fs::path& scene_folder) {
  constexpr std::size_t kMostFolders = 64;
  std::vector<fs::path> folders;
  const std::vector<std::string> names = root.texts("data_folders");
  if (names.size() > kMostFolders) {
    root.error(core::ErrorClass::limit, "data_folders", std::to_string(names.size()),
               "at most " + std::to_string(kMostFolders));
    return folders;
  }
  for (const std::string& name : names) {
    try {
      folders.push_back(
          core::path_inside(scene_folder, name, root.place("data_folders"), "data_folders"));
    } catch (const core::InputError& error) {
      root.problems().append(error.problems());
    }
  }
  return folders;
}

void read_scene_table(ConfigTable& root, SceneDescription& scene) {
  ConfigTable table = root.table("scene");
  if (!table.present())
    root.error(core::ErrorClass::ref, "scene", "missing", "a table [scene] with name and origin");
  // The name becomes the folder that pictures are written to.
  scene.name = table.text("name", core::safe_word(scene.folder.filename().string()));
  if (!core::is_safe_word(scene.name)) {
    table.error(core::ErrorClass::range, "name", "\"" + scene.name + "\"",
                "1 to 64 letters, digits, '.', '-' and '_', the first a letter or digit (title "
                "takes any text)");
    scene.name = core::safe_word(scene.name);
  }
  scene.title = table.text("title", scene.name);
  ConfigTable origin = table.table("origin");
  if (table.present() && !origin.present())
    table.error(core::ErrorClass::ref, "origin", "missing",
                "{ latitude_deg, longitude_deg, height_m }");
  scene.origin.latitude_rad = radians(origin.number("latitude_deg", {-90, 90}, 0.0));
  scene.origin.longitude_rad = radians(origin.number("longitude_deg", {-180, 180}, 0.0));
  scene.origin.height_m = origin.number("height_m", {-1000, 9000}, 0.0);
  scene.datum = static_cast<core::VerticalDatum>(
      table.choice("vertical_datum", {"ellipsoid", "egm96", "scene"}, 0));
  if (table.present() && !table.has("vertical_datum"))
    table.error(core::ErrorClass::ref, "vertical_datum", "missing",
                "what heights count from: \"ellipsoid\", \"egm96\" or \"scene\"");
  scene.earth = table.choice("earth", {"wgs84", "plane"}, 0) == 0 ? terrain::EarthModel::wgs84
                                                                  : terrain::EarthModel::plane;
}

void read_land_cover(ConfigTable& table, const DataSearch& search, TerrainDescription& terrain) {
  ConfigTable cover = table.table("land_cover");
  if (!cover.present()) return;
  terrain.land_cover = search.find(cover, "file");
  terrain.land_cover_place = cover.place("file");
  ConfigTable classes = cover.table("classes");
  for (const std::string& key : classes.keys()) {
    const bool whole =
        !key.empty() && key.size() <= 5 &&
        std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::string material = classes.text(key, "");
    if (!whole)
      classes.error(core::ErrorClass::parse, key, "\"" + key + "\"", "a class number as the key");
    else if (std::stoi(key) > terrain::kLargestLandCoverClass)
      classes.error(core::ErrorClass::range, key, key,
                    "a class from 0 to " + std::to_string(terrain::kLargestLandCoverClass));
    else if (!terrain.classes.emplace(std::stoi(key), material).second)
      classes.error(core::ErrorClass::ref, key, key, "each class once");
  }
}

constexpr const char* kRolling = "generator = \"rolling\"";
constexpr std::array<std::string_view, 9> kOfRollingGround = {
    "relief_m", "field_size_m",  "wood_share",        "canopy_m",         "seed",
    "fields",   "wood_material", "airfield_material", "airfield_beyond_m"};

void read_terrain(ConfigTable& root, const DataSearch& search, TerrainDescription& terrain) {
  ConfigTable table = root.table("terrain");
  terrain.place = table.place("");
  const double half_m = table.number("half_extent_m", kExtent_m, 5000.0);
  terrain.west_m = -table.number("west_m", kExtent_m, half_m);
  terrain.south_m = -table.number("south_m", kExtent_m, half_m);
  terrain.east_m = table.number("east_m", kExtent_m, half_m);
  terrain.north_m = table.number("north_m", kExtent_m, half_m);
  terrain.spacing_m = table.number("spacing_m", {0.5, 1000.0}, 10.0);
  terrain.material = table.text("material", terrain.material);
  read_land_cover(table, search, terrain);
  if (table.has("elevation")) {
    terrain.source = TerrainDescription::Source::raster;
    terrain.elevation = search.find(table, "elevation");
    terrain.elevation_place = table.place("elevation");
    terrain.fill_voids = table.choice("voids", {"refuse", "fill"}, 0) == 1;
    terrain.quantisation_step_m = table.number("quantisation_step_m", {0.0, 100.0}, 0.0);
    if (table.optional_text("generator"))
      table.error(core::ErrorClass::range, "generator", "given beside elevation",
                  "either elevation or generator");
    table.only_with(kOfRollingGround, kRolling);
    return;
  }
  table.only_with({"voids", "quantisation_step_m"}, "elevation");
  const bool rolling = table.choice("generator", {"plane", "rolling"}, 0) == 1;
  if (!rolling) return table.only_with(kOfRollingGround, kRolling);
  terrain.source = TerrainDescription::Source::rolling;
  terrain.relief_m = table.number("relief_m", {0.0, 500.0}, terrain.relief_m);
  terrain.field_size_m = table.number("field_size_m", {20.0, 5000.0}, terrain.field_size_m);
  terrain.wood_share = table.number("wood_share", {0.0, 0.5}, terrain.wood_share);
  terrain.canopy_m = table.number("canopy_m", {0.0, 60.0}, terrain.canopy_m);
  terrain.seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  terrain.fields = table.texts("fields");
  if (terrain.fields.empty()) terrain.fields = {"crops", "tall_grass", "bare_soil"};
  terrain.wood_material = table.text("wood_material", terrain.wood_material);
  terrain.airfield_material = table.text("airfield_material", terrain.airfield_material);
  terrain.airfield_beyond_m =
      table.number("airfield_beyond_m", {0.0, 5000.0}, terrain.airfield_beyond_m);
}

// The file that [sensor] names: in the scene's folder, else shipped. Empty after reporting.
fs::path find_sensor(ConfigTable& table, const SceneOptions& options, const fs::path& folder) {
  const std::string name = table.text("file", "hivision.toml");
  if (!options.sensor.empty()) {
    if (fs::is_regular_file(options.sensor)) return options.sensor;
    table.problems().error(core::ErrorClass::io, {}, "--sensor",
                           options.sensor.string() + " not found", "a sensor file");
    return {};
  }
  try {
    const fs::path own = core::path_inside(folder, name, table.place("file"), table.path("file"));
    if (fs::is_regular_file(own)) return own;
    const fs::path shipped = core::path_inside(options.shipped / "sensors", name,
                                               table.place("file"), table.path("file"));
    if (fs::is_regular_file(shipped)) return shipped;
  } catch (const core::InputError& error) {
    table.problems().append(error.problems());
    return {};
  }
  table.error(core::ErrorClass::io, "file", "\"" + name + "\" not found",
              "a sensor file in the scene's folder or " + (options.shipped / "sensors").string());
  return {};
}

// The radar file of the signal level, which only a sensor of the scene's own goes with.
void find_signal_file(ConfigTable& table, const SceneOptions& options, SceneDescription& scene) {
  const auto name = table.optional_text("signal");
  if (!name || !options.sensor.empty()) return;
  try {
    const fs::path file =
        core::path_inside(scene.folder, *name, table.place("signal"), table.path("signal"));
    if (fs::is_regular_file(file)) {
      scene.signal_file = file;
      scene.files.push_back(file);
    } else {
      table.error(core::ErrorClass::io, "signal", "\"" + *name + "\" not found",
                  "a radar file in the scene's folder");
    }
  } catch (const core::InputError& error) {
    table.problems().append(error.problems());
  }
}

void read_sensor_table(ConfigTable& root, const SceneOptions& options, const fs::path& folder,
                       SceneDescription& scene) {
  ConfigTable table = root.table("sensor");
  const fs::path file = find_sensor(table, options, folder);
  if (!file.empty()) {
    scene.sensor = sensors::read_sensor(file, root.problems());
    scene.files.push_back(file);
    for (const std::string& pattern : scene.sensor.antenna.pattern_files)
      scene.files.emplace_back(pattern);
  }
  find_signal_file(table, options, scene);
  sensors::Mounting& mounting = scene.sensor.mounting;
  mounting.forward_m = table.number("forward_m", {-100, 100}, mounting.forward_m);
  mounting.right_m = table.number("right_m", {-100, 100}, mounting.right_m);
  mounting.down_m = table.number("down_m", {-100, 100}, mounting.down_m);
  mounting.yaw_rad = radians(table.number("yaw_deg", {-180, 180}, core::degrees(mounting.yaw_rad)));
  mounting.pitch_rad =
      radians(table.number("pitch_deg", {-90, 90}, core::degrees(mounting.pitch_rad)));
  mounting.roll_rad =
      radians(table.number("roll_deg", {-180, 180}, core::degrees(mounting.roll_rad)));
  scene.sensor.scan.stabilised = table.boolean("stabilised", scene.sensor.scan.stabilised);
}

void read_display(ConfigTable& root, const sensors::RangeGate& range, sensors::Display& display) {
  ConfigTable table = root.table("display");
  sensors::read_grey_mapping(table, range, display);
  display.cscope_mode = static_cast<sensors::Display::CScopeMode>(
      table.choice("cscope_mode", sensors::Display::kCScopeModes,
                   static_cast<std::size_t>(display.cscope_mode)));
}

// The error allowed, in grey levels: stated so, or in dB of the power that the sensor's display
// shows. 0 when the scene does not say.
double read_accuracy_grey(ConfigTable& accuracy, const sensors::Sensor& sensor) {
  const auto grey = accuracy.optional_number("grey_levels", renderer::kAccuracies_grey);
  if (accuracy.has("power_dB") && accuracy.has("grey_levels"))
    accuracy.error(core::ErrorClass::ref, "power_dB", "beside grey_levels", "one of the two");
  core::NumberRange range_dB{0.0, 400.0, true};
  double dB_per_grey = 1.0;
  if (!accuracy.problems().has_errors()) {  // else the sensor may have no display
    dB_per_grey = sensors::GreyScale(sensor).dB_per_grey();
    range_dB = {renderer::kAccuracies_grey.low * dB_per_grey,
                renderer::kAccuracies_grey.high * dB_per_grey};
  }
  const auto power_dB = accuracy.optional_number("power_dB", range_dB);
  return power_dB ? *power_dB / dB_per_grey : grey.value_or(0.0);
}

void read_accuracy(ConfigTable accuracy, SceneDescription& scene) {
  scene.rays_per_cell = accuracy.number("rays_per_cell", renderer::kSamplesOrDefault, 0.0);
  scene.accuracy_grey = read_accuracy_grey(accuracy, scene.sensor);
  scene.time_budget_ms =
      accuracy.optional_number("time_budget_ms", renderer::kTimeBudgets_ms).value_or(0.0);
  if (accuracy.has("time_budget_ms") && accuracy.has("rays_per_cell"))
    accuracy.error(core::ErrorClass::ref, "time_budget_ms", "beside rays_per_cell",
                   "one of the two: how finely, or how long");
  scene.caster = static_cast<renderer::CasterWish>(accuracy.choice(
      "caster",
      {renderer::kCasterWishes[0], renderer::kCasterWishes[1], renderer::kCasterWishes[2]},
      static_cast<int>(renderer::CasterWish::automatic)));
  scene.caster_place = accuracy.place("caster");
  scene.sample = accuracy.choice("realisation", {"mean", "sample"}, 0) == 1;
}

void list_files(SceneDescription& scene) {
  scene.files.push_back(scene.material_library);
  for (const fs::path& file :
       {scene.terrain.elevation, scene.terrain.land_cover, scene.trajectory.file})
    if (!file.empty()) scene.files.push_back(file);
}

void read_databases(ConfigTable& root, SceneDescription& scene) {
  constexpr std::size_t kMost = 126;
  for (ConfigTable& table : root.tables("database", kMost)) {
    const int number = static_cast<int>(table.integer("number", 2, 127, 2));
    if (!table.has("number"))
      table.error(core::ErrorClass::ref, "number", "missing", "2 to 127; this scene is number 1");
    const std::string name = table.required_text("scene");
    if (!name.empty() && !core::is_safe_word(name))
      table.error(core::ErrorClass::range, "scene", "\"" + name + "\"",
                  "the name of a folder beside this scene's, or of a shipped scene");
    const auto same = [&](const DatabaseDescription& one) { return one.number == number; };
    if (table.has("number") && std::any_of(scene.databases.begin(), scene.databases.end(), same))
      table.error(core::ErrorClass::ref, "number", std::to_string(number), "a number of its own");
    scene.databases.push_back({number, name});
  }
}

}  // namespace

SceneDescription read_scene(const fs::path& path, const SceneOptions& options,
                            core::ProblemList& problems) {
  std::error_code unreadable;  // told where the file is read
  const fs::path file = fs::is_directory(path, unreadable) ? path / "scene.toml" : path;
  SceneDescription scene;
  scene.folder = fs::weakly_canonical(file, unreadable).parent_path();
  ConfigTable root = ConfigTable::from_file(file, problems);
  if (!root.present()) return scene;
  std::vector<fs::path> data = options.data_folders;
  const std::vector<fs::path> own = read_data_folders(root, scene.folder);
  data.insert(data.begin(), own.begin(), own.end());
  const DataSearch search(scene.folder, data);
  read_scene_table(root, scene);
  read_sensor_table(root, options, scene.folder, scene);
  read_terrain(root, search, scene.terrain);
  ObjectNames objects(root.has("object_library") ? search.find(root, "object_library")
                                                 : options.shipped / "materials" / "objects.toml",
                      scene.sensor.waveform.frequency_Hz);
  read_objects(root, search, objects, scene);
  read_weather(root, scene);
  read_surfaces(root, scene);
  read_trajectory(root, search, scene);
  read_display(root, scene.sensor.range, scene.sensor.display);
  read_accuracy(root.table("accuracy"), scene);
  read_databases(root, scene);
  scene.material_library = root.has("material_library")
                               ? search.find(root, "material_library")
                               : options.shipped / "materials" / "library.toml";
  root.report_unknown_keys();
  scene.resolved = root.resolved();
  scene.place_of_key = root.key_places();
  list_files(scene);
  if (objects.used()) scene.files.push_back(objects.file());
  return scene;
}

}  // namespace fanbeam::scenes
