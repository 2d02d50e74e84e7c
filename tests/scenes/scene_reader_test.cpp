// What scene.toml says arrives in the description, in SI.
#include "scenes/scene_reader.h"

#include <catch2/catch.hpp>
#include <map>

#include "core/decibel.h"
#include "core/files.h"
#include "core/units.h"
#include "tests/scenes/full_scene.h"

using namespace fanbeam;
using namespace fanbeam::scenes;
using core::radians;
using tests::read;
using tests::TemporaryFolder;

TEST_CASE("Scene, terrain and runway arrive in SI", "[scene_reader]") {
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
  const SceneDescription scene = read(folder.path());
  CHECK(scene.name == "full");
  CHECK(scene.title == "Everything at once");
  CHECK(scene.origin.latitude_rad == radians(-33.9));
  CHECK(scene.origin.height_m == 42.0);
  CHECK(scene.datum == core::VerticalDatum::egm96);
  CHECK(scene.earth == terrain::EarthModel::plane);
  CHECK(scene.rays_per_cell == 4.0);
  CHECK(scene.caster == renderer::CasterWish::automatic);
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
  CHECK(runway.approach_lights == std::vector<std::string>{"19"});
  CHECK(runway.light_rcs_m2 == Approx(0.01));
  CHECK(runway.fence_beyond_m == 80.0);
  CHECK(runway.fence_post_rcs_m2 == Approx(core::power_from_dB(-3.0)));
}

TEST_CASE("An accuracy in dB is in the grey levels of the sensor in use", "[scene_reader]") {
  const TemporaryFolder folder;
  folder.write(
      "wide.toml",
      tests::replaced(core::read_file(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", 1U << 20U),
                      "high_dB = 5.0", "high_dB = 35.0"));
  core::ProblemList problems;
  const auto accuracy_grey = [&](const std::string& keys,
                                 const std::filesystem::path& sensor = {}) {
    folder.write("scene.toml", tests::kSmallScene + keys);
    problems = {};
    return read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, sensor}, problems).accuracy_grey;
  };
  const std::string one_dB = "[accuracy]\npower_dB = 1.0\n";
  CHECK(accuracy_grey(one_dB) == Approx(255.0 / 60.0));  // HiVision: -55 to 5 dB
  CHECK(accuracy_grey(one_dB, folder.path() / "wide.toml") == Approx(255.0 / 90.0));
  CHECK(accuracy_grey(one_dB + "[display]\nlow_dB = -25.0\n") == Approx(255.0 / 30.0));
  CHECK(problems.all().empty());
  CHECK(accuracy_grey("[accuracy]\ngrey_levels = 2.0\n") == 2.0);
  CHECK(accuracy_grey("") == 0.0);
  CHECK(problems.all().empty());

  accuracy_grey("[accuracy]\npower_dB = 1.0\ngrey_levels = 2.0\n");
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-REF");
  CHECK(problems.all()[0].field == "accuracy.power_dB");
  for (const char* beyond : {"0.0", "24.0", "-1.0"}) {  // 0.01 to 100 grey levels
    INFO(beyond);
    accuracy_grey("[accuracy]\npower_dB = " + std::string(beyond) + "\n");
    REQUIRE(problems.all().size() == 1);
    CHECK(problems.all()[0].code == "E-RANGE");
  }
  accuracy_grey("[accuracy]\npower_dB = nan\n");
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-NONFINITE");
}

TEST_CASE("Objects, weather, sensor and display arrive in SI", "[scene_reader]") {
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
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

TEST_CASE("Trajectories: columns, windows and transplant; the ILS keys; a fixed pose",
          "[scene_reader]") {
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
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

  const std::string head = tests::kFullScene.substr(0, tests::kFullScene.find("[trajectory]"));
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

TEST_CASE("Databases have numbers of their own and names of folders; all that is wrong is told",
          "[scene_reader]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", tests::kSmallScene +
                                 "[[database]]\nnumber = 2\nscene = \"innsbruck-26\"\n"
                                 "[[database]]\nnumber = 127\nscene = \"obstacle-field\"\n");
  const auto scene = read(folder.path());
  REQUIRE(scene.databases.size() == 2);
  CHECK(scene.databases[1].number == 127);
  CHECK(scene.databases[1].scene == "obstacle-field");
  folder.write("scene.toml", tests::kSmallScene +
                                 "[[database]]\nnumber = 1\nscene = \"innsbruck-26\"\n"
                                 "[[database]]\nscene = \"../../etc\"\n"
                                 "[[database]]\nnumber = 9\n"
                                 "[[database]]\nnumber = 9\nscene = \"obstacle-field\"\n");
  core::ProblemList problems;
  scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  std::vector<std::string> fields;
  for (const core::Problem& problem : problems.all()) fields.push_back(problem.field);
  CHECK(fields == std::vector<std::string>{"database[0].number", "database[1].number",
                                           "database[1].scene", "database[2].scene",
                                           "database[3].number"});
}
