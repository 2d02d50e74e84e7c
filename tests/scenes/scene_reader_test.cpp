// What scene.toml says arrives in the description, wherever the scene lies and whatever the machine's locale (F18).
#include "scenes/scene_reader.h"

#include <catch2/catch.hpp>
#include <clocale>
#include <fstream>
#include <locale>
#include <sstream>

#include "core/decibel.h"
#include "core/units.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using namespace fanbeam::scenes;
using core::radians;
using tests::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

// Every table and nearly every key, with values that are no default.
const std::string kFullScene = R"(material_library = "mine.toml"
data_folders = ["more data", "even more"]

[scene]
name = "full"
title = "Everything at once"
origin = { latitude_deg = -33.9, longitude_deg = 18.6, height_m = 42.0 }
vertical_datum = "egm96"
earth = "plane"

[terrain]
west_m = 1000.0
east_m = 2000.0
south_m = 3000.0
north_m = 4000.0
spacing_m = 25.0
material = "dirt"
elevation = "dem.asc"
voids = "fill"
quantisation_step_m = 0.5
land_cover = { file = "cover.asc", classes = { 0 = "dirt", 255 = "lawn" } }

[[runway]]
first = { name = "01", latitude_deg = -33.91, longitude_deg = 18.6, elevation_m = 40.0, displaced_m = 120.0 }
second = { name = "19", latitude_deg = -33.89, longitude_deg = 18.61, elevation_m = 46.0 }
width_m = 60.0
shoulder_m = 5.0
surface = "lawn"
shoulder = "dirt"
marking = "chalk"
markings = false
strip_half_width_m = 140.0
blend_m = 50.0
edge_lights = false
approach_lights = "19"
approach_light_slope = 0.01
light_rcs_dBsm = -20.0
fence = { beyond_m = 80.0, height_m = 1.8, spacing_m = 2.0, post_rcs_dBsm = -3.0 }

[[surface]]
runway = "01"
material = "dirt"
behind_threshold_m = [10.0, 200.0]
left_m = [-90.0, -60.0]

[[model]]
name = "van"
file = "van.gltf"
at = { latitude_deg = -33.9, longitude_deg = 18.601 }
above_ground_m = 0.5
heading_deg = 30.0
default_material = "dirt"
materials = { Glass = "chalk" }

[[box]]
name = "shed"
at = { runway = "01", behind_threshold_m = 300.0, left_m = -70.0 }
length_m = 20.0
width_m = 10.0
height_m = 5.0
heading_deg = 45.0
wall = "chalk"
roof = "lawn"

[[buildings]]
file = "town.geojson"
height_property = "h"
min_height_property = "h0"
base = "mean"
wall = "chalk"
roof = "lawn"

[[target]]
name = "corner"
at = { runway = "19", behind_threshold_m = 0.0 }
above_ground_m = 2.0
heading_deg = 10.0
tilt_deg = 5.0
rcs = { shape = "plate", width_m = 0.4, height_m = 0.3 }

[[target]]
rcs = { shape = "cylinder", radius_m = 0.1, length_m = 2.0 }
waypoint = [
  { time_s = 1.0, at = { runway = "19", behind_threshold_m = 0.0 }, above_ground_m = 1.0 },
  { time_s = 2.5, at = { runway = "19", behind_threshold_m = 50.0 } },
]

[[line]]
name = "wire"
from = { runway = "19", behind_threshold_m = -300.0, left_m = 50.0 }
to = { runway = "19", behind_threshold_m = -300.0, left_m = -50.0 }
from_above_m = 20.0
to_above_m = 22.0
rcs_dBsm_per_m = -17.0
spacing_m = 0.5

[weather]
liquid_water_g_per_m3 = 0.1
fog_top_m = 60.0
fog_law = "itu-p840"
rain_rate_mm_per_h = 8.0
rain_law = "itu-p838"
rain_top_m = 2500.0
polarisation_tilt_deg = 90.0
origin_height_m = 30.0
temperature_C = 12.0
pressure_hPa = 1000.0
humidity = 0.9

[sensor]
file = "hivision.toml"
forward_m = 3.0
right_m = 0.1
down_m = 1.0
yaw_deg = 1.0
pitch_deg = -2.0
roll_deg = 3.0
stabilised = false

[display]
mapping = "log"
low_dB = -150.0
high_dB = -90.0
cscope_mode = "flat_earth"

[accuracy]
rays_per_cell = 4.0

[trajectory]
file = "flight.csv"
vertical_datum = "ellipsoid"
height_offset_m = -1.5
from_time_s = 10.0
to_time_s = 20.0
from_row = 2
to_row = 300
angle_of_attack_deg = 3.0

[trajectory.columns]
time = "t"
time_unit = "ms"
latitude = "lat"
latitude_unit = "rad"
height = "alt_ft"
heading = "hdg_deg"

[trajectory.transplant]
from_latitude_deg = 50.0
from_longitude_deg = 8.5
from_elevation_m = 100.0
from_bearing_deg = 250.0
onto_runway = "01"
)";

void write_full_scene(const TemporaryFolder& folder) {
  folder.write("scene.toml", kFullScene);
  fs::create_directories(folder.path() / "even more");
  fs::create_directories(folder.path() / "more data");
  for (const char* name : {"mine.toml", "dem.asc", "cover.asc", "van.gltf", "flight.csv", "even more/town.geojson",
                           "more data/town.geojson"})
    folder.write(name, "");
}

SceneDescription read(const fs::path& path, const std::vector<fs::path>& data = {}) {
  core::ProblemList problems;
  const SceneDescription scene = read_scene(path, {FANBEAM_SOURCE_DIR, data, {}}, problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  CHECK_FALSE(problems.has_errors());
  return scene;
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("Scene, terrain and runway arrive in SI", "[scene_reader]") {
  const TemporaryFolder folder;
  write_full_scene(folder);
  const SceneDescription scene = read(folder.path());
  CHECK(scene.name == "full");
  CHECK(scene.title == "Everything at once");
  CHECK(scene.origin.latitude_rad == radians(-33.9));
  CHECK(scene.origin.height_m == 42.0);
  CHECK(scene.datum == core::VerticalDatum::egm96);
  CHECK(scene.earth == terrain::EarthModel::plane);
  CHECK(scene.rays_per_cell == 4.0);
  CHECK(scene.material_library.filename() == "mine.toml");

  const TerrainDescription& terrain = scene.terrain;
  CHECK(terrain.source == TerrainDescription::Source::raster);
  CHECK(terrain.west_m == -1000.0);
  CHECK(terrain.north_m == 4000.0);
  CHECK(terrain.fill_voids);
  CHECK(terrain.quantisation_step_m == 0.5);
  CHECK(terrain.classes == std::map<int, std::string>{{0, "dirt"}, {255, "lawn"}});

  REQUIRE(scene.runways.size() == 1);
  const RunwayDescription& runway = scene.runways[0];
  CHECK(runway.ends[0].name == "01");
  CHECK(runway.ends[0].displaced_m == 120.0);
  CHECK(runway.ends[1].pavement_end.height_m == 46.0);
  CHECK(runway.width_m == 60.0);
  CHECK_FALSE(runway.markings);
  CHECK_FALSE(runway.edge_lights);
  CHECK(runway.approach_lights == "19");
  CHECK(runway.light_rcs_m2 == Approx(0.01));
  CHECK(runway.fence_beyond_m == 80.0);
  CHECK(runway.fence_post_rcs_m2 == Approx(core::power_from_dB(-3.0)));
}

TEST_CASE("Objects, weather, sensor and display arrive in SI", "[scene_reader]") {
  const TemporaryFolder folder;
  write_full_scene(folder);
  const SceneDescription scene = read(folder.path());
  REQUIRE(scene.surfaces.size() == 1);
  CHECK(scene.surfaces[0].to_behind_m == 200.0);
  CHECK(scene.surfaces[0].from_left_m == -90.0);
  REQUIRE(scene.models.size() == 1);
  CHECK_FALSE(scene.models[0].at.on_runway);
  CHECK(scene.models[0].at.longitude_rad == radians(18.601));
  CHECK(scene.models[0].heading_rad == radians(30.0));
  CHECK(scene.models[0].materials == std::map<std::string, std::string>{{"Glass", "chalk"}});
  REQUIRE(scene.boxes.size() == 1);
  CHECK(scene.boxes[0].at.on_runway);
  CHECK(scene.boxes[0].at.left_m == -70.0);
  REQUIRE(scene.buildings.size() == 1);
  CHECK(scene.buildings[0].base_is_mean);
  CHECK(scene.buildings[0].height_property == "h");
  REQUIRE(scene.targets.size() == 2);
  CHECK(std::get<materials::RectangularPlate>(scene.targets[0].rcs).width_m == 0.4);
  CHECK(scene.targets[0].tilt_rad == radians(5.0));
  REQUIRE(scene.targets[1].path.size() == 2);
  CHECK(scene.targets[1].path[1].time_s == 2.5);
  REQUIRE(scene.lines.size() == 1);
  CHECK(scene.lines[0].rcs_m2_per_m == Approx(core::power_from_dB(-17.0)));

  CHECK(scene.weather.liquid_water_g_per_m3 == 0.1);
  CHECK_FALSE(scene.weather.visibility_m.has_value());
  CHECK(scene.weather.rain_rate_mm_per_h == 8.0);
  CHECK(scene.weather.polarisation_tilt_rad == radians(90.0));
  CHECK(scene.weather.origin_height_m == 30.0);
  CHECK(scene.weather.humidity == 0.9);
  CHECK(scene.sensor.name == "HiVision");
  CHECK(scene.sensor.mounting.forward_m == 3.0);
  CHECK(scene.sensor.mounting.pitch_rad == radians(-2.0));
  CHECK_FALSE(scene.sensor.scan.stabilised);
  CHECK(scene.sensor.display.mapping == sensors::Display::Mapping::log);
  CHECK(scene.sensor.display.low_dB == -150.0);
  CHECK(scene.sensor.display.cscope_mode == sensors::Display::CScopeMode::flat_earth);
}

TEST_CASE("Trajectories: columns, windows and transplant; the ILS keys; a fixed pose", "[scene_reader]") {
  const TemporaryFolder folder;
  write_full_scene(folder);
  const TrajectoryDescription file = read(folder.path()).trajectory;
  CHECK(file.kind == TrajectoryDescription::Kind::file);
  CHECK(file.datum == core::VerticalDatum::ellipsoid);
  CHECK(file.columns.time.name == "t");
  CHECK(file.columns.time.unit == "ms");
  CHECK(file.columns.latitude.unit == "rad");
  CHECK(file.columns.longitude.name == "longitude_deg");
  CHECK(file.columns.height.name == "alt_ft");
  CHECK(file.columns.height_offset_m == -1.5);
  CHECK(file.columns.from_time_s == 10.0);
  CHECK(file.columns.last_row == 300);
  CHECK(file.assumptions.angle_of_attack_rad == radians(3.0));
  CHECK(file.transplanted);
  CHECK(file.source_bearing_rad == radians(250.0));
  CHECK(file.onto_end == "01");

  const std::string head = kFullScene.substr(0, kFullScene.find("[trajectory]"));
  folder.write("scene.toml", head + R"([trajectory.ils]
runway = "19"
localiser_course_deg = 190.0
crossing_distance_m = 900.0
glide_path_deg = 3.5
threshold_crossing_height_m = 16.0
start_distance_m = 4000.0
speed_mps = 60.0
speed_kind = "ground"
wind_speed_mps = 8.0
wind_from_deg = 220.0
turbulence_wind_20ft_mps = 7.0
seed = 12
angle_of_attack_deg = 2.0
end = "full_stop"
decision_height_m = 50.0
flare_height_m = 10.0
touchdown_sink_mps = 0.5
height_on_ground_m = 4.0
)");
  const TrajectoryDescription ils = read(folder.path()).trajectory;
  CHECK(ils.kind == TrajectoryDescription::Kind::ils);
  CHECK(ils.ils_end == "19");
  CHECK(ils.ils.localiser_course_rad == radians(190.0));
  CHECK(ils.ils.speed_kind == SpeedKind::ground);
  CHECK(ils.ils.end == ApproachEnd::full_stop);
  CHECK(ils.ils.wind_from_rad == radians(220.0));
  CHECK(ils.ils.seed == 12);

  folder.write("scene.toml", head + R"([trajectory.fixed]
at = { runway = "01", behind_threshold_m = -500.0 }
above_ground_m = 60.0
heading_deg = 12.0
pitch_deg = -1.0
roll_deg = 2.0
)");
  const TrajectoryDescription fixed = read(folder.path()).trajectory;
  CHECK(fixed.kind == TrajectoryDescription::Kind::fixed);
  CHECK(fixed.at.behind_threshold_m == -500.0);
  CHECK(fixed.roll_rad == radians(2.0));
}

TEST_CASE("Files are looked for in the scene's folder, its data folders in order, then those of the command line",
          "[scene_reader]") {
  const TemporaryFolder folder;
  const TemporaryFolder other;
  write_full_scene(folder);
  fs::create_directories(other.path() / "even more");
  for (const char* name : {"dem.asc", "town.geojson", "cover.asc"}) other.write(name, "");
  CHECK(read(folder.path(), {other.path()}).buildings[0].file == folder.path() / "more data/town.geojson");
  fs::remove(folder.path() / "more data/town.geojson");
  CHECK(read(folder.path(), {other.path()}).buildings[0].file == folder.path() / "even more/town.geojson");
  fs::remove(folder.path() / "even more/town.geojson");
  fs::remove(folder.path() / "dem.asc");
  const SceneDescription scene = read(folder.path(), {"/nowhere", other.path()});
  CHECK(scene.buildings[0].file == other.path() / "town.geojson");
  CHECK(scene.terrain.elevation == other.path() / "dem.asc");
  CHECK(scene.terrain.land_cover == folder.path() / "cover.asc");
}

TEST_CASE("F18 a folder with blanks and letters beyond ASCII, read from anywhere", "[scene_reader]") {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "Anflug Zürich 14 – 東";
  fs::create_directories(scene);
  folder.write("Anflug Zürich 14 – 東/scene.toml",
               tests::replaced(tests::kSmallScene, "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0",
                               "[trajectory]\nfile = \"Flug Nº 1.csv\"\nvertical_datum = \"scene\""));
  folder.write("Anflug Zürich 14 – 東/Flug Nº 1.csv", "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n");
  const tests::Outcome whole = tests::build(scene);
  REQUIRE(whole.scene != nullptr);

  const fs::path before = fs::current_path();
  fs::current_path(scene);
  const SceneDescription here = read(".");
  const SceneDescription by_file = read("scene.toml");
  fs::current_path(folder.path());
  const SceneDescription relative = read("Anflug Zürich 14 – 東");
  fs::current_path(before);
  for (const SceneDescription* read_elsewhere : {&here, &by_file, &relative}) {
    CHECK((read_elsewhere->resolved == whole.scene->description.resolved));
    CHECK(read_elsewhere->folder == whole.scene->description.folder);
    CHECK(read_elsewhere->trajectory.file == whole.scene->description.trajectory.file);
  }
}

TEST_CASE("F18 a locale with a decimal comma changes nothing", "[scene_reader]") {
  const TemporaryFolder folder;
  write_full_scene(folder);
  const fs::path braunschweig = fs::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26";
  const SceneDescription plain = read(folder.path());
  const std::unique_ptr<Scene> plain_scene = tests::build(braunschweig).scene;
  REQUIRE(plain_scene != nullptr);

  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "pt_BR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  std::ostringstream proof;
  proof << 1234.5;
  const SceneDescription comma = read(folder.path());
  const std::unique_ptr<Scene> comma_scene = tests::build(braunschweig).scene;
  std::locale::global(before);
  std::setlocale(LC_ALL, c_before.c_str());

  CHECK(proof.str() == "1.234,5");
  CHECK((comma.resolved == plain.resolved));
  REQUIRE(comma_scene != nullptr);
  CHECK(comma_scene->world.surfaces->terrain()->height_m == plain_scene->world.surfaces->terrain()->height_m);
  CHECK(comma_scene->world.surfaces->triangle_count() == plain_scene->world.surfaces->triangle_count());
  const core::Pose a = plain_scene->trajectory.at(10.0);
  const core::Pose b = comma_scene->trajectory.at(10.0);
  CHECK(a.position.latitude_rad == b.position.latitude_rad);
  CHECK(a.position.height_m == b.position.height_m);
}

TEST_CASE("docs/scene-format.md names every key that a scene can have", "[scene_reader]") {
  const TemporaryFolder folder;
  write_full_scene(folder);
  std::ifstream stream(fs::path(FANBEAM_SOURCE_DIR) / "docs/scene-format.md");
  std::ostringstream document;
  document << stream.rdbuf();
  const std::string text = document.str();
  const SceneDescription full = read(folder.path());
  const SceneDescription rolling = read(fs::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
  const SceneDescription flat = read(fs::path(FANBEAM_SOURCE_DIR) / "scenes/flat-grass");
  std::vector<std::string> missing;
  for (const SceneDescription* scene : {&full, &rolling, &flat}) {
    for (const auto& entry : scene->resolved) {
      std::string key = entry.first.substr(entry.first.rfind('.') + 1);
      key = key.substr(0, key.find('['));
      const bool free_form =
          entry.first.find(".classes.") != std::string::npos || entry.first.find(".materials.") != std::string::npos;
      if (!free_form && text.find("`" + key + "`") == std::string::npos) missing.push_back(entry.first);
    }
  }
  CHECK(missing.empty());
}
