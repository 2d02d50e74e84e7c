// Scenes without a flight, and poses that a plan was not made for.
#include <catch2/catch.hpp>

#include "core/units.h"
#include "scenes/frame_plan.h"
#include "session/session.h"
#include "tests/scenes/grey_difference.h"
#include "tests/scenes/problem_checks.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

// Without its approach.
std::string live() {
  return tests::kSmallScene.substr(0, tests::kSmallScene.find("[trajectory.ils]"));
}

std::unique_ptr<session::Session> session_of(const TemporaryFolder& folder,
                                             const std::string& text) {
  folder.write("scene.toml", text);
  core::ProblemList problems;
  return std::make_unique<session::Session>(
      folder.path(), session::Setup{.shipped = FANBEAM_SOURCE_DIR}, problems);
}

// South of the runway at 52 N, 10 E, seen along `heading_deg`.
core::Pose pose(double latitude_deg, double height_m, double heading_deg = 0.0) {
  core::Pose at;
  at.position = {core::radians(latitude_deg), core::radians(10.0), height_m};
  at.q_NB = core::quaternion_from({0.0, 0.0, core::radians(heading_deg)});
  return at;
}

bool is_outside(const renderer::Frame& frame) {
  return std::count(frame.events.begin(), frame.events.end(), "outside_volume") == 1;
}

}  // namespace

TEST_CASE("A scene without a trajectory is planned for the air over its terrain",
          "[flight_volume]") {
  const TemporaryFolder folder;
  const auto session = session_of(folder, live());
  const auto scene = session->scene();
  CHECK(scene->frame_count() == 0);
  CHECK_FALSE(scene->trajectory);
  const double window_m = scene->description.sensor.range.maximum_m();
  const auto [low, high] =
      std::pair(scene->site->parts().facts.lowest_m, scene->site->parts().facts.highest_ground_m);
  CHECK(scene->volume.lowest_m == low);
  CHECK(scene->volume.highest_m == high + window_m);
  CHECK(scene->facts.highest_m >= high + window_m);
  CHECK_FALSE(is_outside(session->render(pose(51.99, 150.0), 0)));
  CHECK(is_outside(session->render(pose(51.99, 5000.0), 0)));
  CHECK(is_outside(session->render(pose(51.9, 150.0), 0)));  // beside the terrain
}

TEST_CASE("A stated flight volume is what the plan counts on, with a trajectory beside it too",
          "[flight_volume]") {
  const TemporaryFolder folder;
  const std::string stated = "[flight_volume]\nlowest_m = 100.0\nhighest_m = 1000.0\n";
  const auto session = session_of(folder, live() + stated);
  // The scene's datum has its zero 50 m below the origin; the Earth falls away by 1 m to the rim.
  CHECK(session->scene()->volume.lowest_m == Approx(50.0).epsilon(0.0).margin(1.1));
  CHECK(session->scene()->volume.highest_m == Approx(950.0).epsilon(0.0).margin(1e-6));
  CHECK(is_outside(session->render(pose(51.99, 1200.0), 0)));
  CHECK(is_outside(session->render(pose(51.99, 80.0), 0)));
  CHECK_FALSE(is_outside(session->render(pose(51.99, 900.0), 0)));
  const TemporaryFolder both;
  const auto flown = session_of(both, tests::kSmallScene + "\n" + stated);
  CHECK(flown->scene()->frame_count() > 0);
  CHECK_FALSE(is_outside(flown->render(pose(52.005, 900.0, 180.0), 0)));
}

TEST_CASE("A pose that no frame of the flight is like is told, and rendered by a plan of its own",
          "[flight_volume]") {
  // A wall of metal behind the approach: no frame of it sees the wall.
  const std::string behind = R"(
[[box]]
name = "wall"
at = { runway = "36", behind_threshold_m = -8500.0, left_m = 0.0 }
length_m = 4.0
width_m = 300.0
height_m = 60.0
wall = "metal"
roof = "metal"
)";
  const std::string open = tests::replaced(
      tests::replaced(tests::kSmallScene, "half_extent_m = 2500.0", "half_extent_m = 9000.0"),
      "elevation_m = 60.0", "elevation_m = 50.0");
  const std::size_t box = open.find("[[box]]"), weather = open.find("[weather]");
  const std::string text =
      open.substr(0, box) + behind + open.substr(weather) + "end = \"decision_height\"\n";
  const TemporaryFolder flight, anywhere;
  const auto session = session_of(flight, text);
  REQUIRE(session->scene()->frame_count() > 0);
  REQUIRE_FALSE(session->scene()->plan.runs(core::EffectId::double_bounce));
  const auto scene = session->scene();
  const core::Pose flown = scene->trajectory->at(scene->trajectory->begin_s() + 1.0);
  const renderer::Frame before = session->render(flown, 3);
  CHECK_FALSE(is_outside(before));

  const core::Pose back = pose(51.946, 150.0, 180.0);  // 2.5 km before it
  const renderer::Frame seen = session->render(back, 0);
  CHECK(is_outside(seen));
  // As a session that counts on any pose shows it.
  const auto wide = session_of(anywhere, text + "\n[flight_volume]\n");
  REQUIRE(wide->scene()->plan.runs(core::EffectId::double_bounce));
  const renderer::Frame expected = wide->render(back, 0);
  CHECK_FALSE(is_outside(expected));
  CHECK(tests::largest_difference_grey(seen, expected) < 0.5);
  // It leaves no trace.
  CHECK(session->render(flown, 3).bscope_W == before.bscope_W);
  CHECK_FALSE(session->scene()->plan.runs(core::EffectId::double_bounce));
}

TEST_CASE("Every frame of a flight is one that its plan was made for", "[flight_volume]") {
  const TemporaryFolder folder;
  const auto scene = tests::good_scene(
      folder, tests::kSmallScene +
                  "\n[[weather.rain_cell]]\nat = { latitude_deg = 52.004, longitude_deg = 10.0 }\n"
                  "radius_m = 300.0\nrain_rate_mm_per_h = 40.0\n");
  for (int frame = 0; frame < scene->frame_count(); frame += 7) {
    INFO(frame);
    REQUIRE(scenes::planned_for(*scene, scene->frame_pose(frame)));
  }
}

// Poses between its rows are off their height by rounding: plans of their own took twice the time.
TEST_CASE("The frames of a radar that stands are inside its volume", "[flight_volume]") {
  const std::string approach = "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0\n";
  for (const auto& [latitude, longitude] : {std::pair{"51.991931873", "10.003472588"},
                                            {"51.987654321", "9.9987654321"},
                                            {"52.001234567", "10.011223344"},
                                            {"51.98271828", "9.99314159"},
                                            {"52.00577215", "10.00161803"},
                                            {"51.99693147", "9.98892718"},
                                            {"51.9914142135", "10.0117320508"}}) {
    INFO(latitude << ", " << longitude);
    const TemporaryFolder folder;
    std::string rows =
        "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
    for (const char* time : {"0", "1", "2"})
      rows += std::string(time) + "," + latitude + "," + longitude + ",130,0,0,10\n";
    folder.write("standing.csv", rows);
    const auto scene = tests::good_scene(
        folder,
        tests::replaced(tests::kSmallScene, approach,
                        "[trajectory]\nfile = \"standing.csv\"\nvertical_datum = \"scene\"\n"));
    for (int frame = 0; frame < scene->frame_count(); ++frame) {
      INFO("frame " << frame);
      CHECK(scenes::planned_for(*scene, scene->frame_pose(frame)));
    }
  }
}

TEST_CASE("A flight's plan does not hold where verticals turn more than its bounds count on",
          "[flight_volume]") {
  const TemporaryFolder folder;
  const auto scene = tests::good_scene(folder, tests::kSmallScene);
  scene->facts = scene->all_facts;  // all is seen
  const auto planned = [&](double turn_rad, double counted_on_rad) {
    renderer::FramePose at = scene->frame_pose(0);
    at.north_east_down =
        glm::mat3_cast(glm::angleAxis(turn_rad, glm::dvec3(1.0, 0.0, 0.0))) * at.north_east_down;
    scene->facts.vertical_turn_rad = counted_on_rad;
    return scenes::planned_for(*scene, at);
  };
  // 1.1 km over 3.7 km of range; 0.04 rad is less than the 300 m that every bound counts on.
  CHECK(planned(0.3, 0.31));
  CHECK_FALSE(planned(0.3, 0.0));
  CHECK(planned(0.04, 0.0));
}

TEST_CASE("The frames of shipped flights are inside their own volume", "[flight_volume]") {
  for (const char* name : {"flat-grass", "braunschweig-26", "obstacle-field", "rain-94ghz"}) {
    core::ProblemList problems;
    const std::string shipped = FANBEAM_SOURCE_DIR;
    const session::Session session(shipped + "/scenes/" + name, {.shipped = shipped}, problems);
    const auto scene = session.scene();
    for (int frame = 0; frame < scene->frame_count(); frame += 101) {
      INFO(name << ", frame " << frame);
      REQUIRE(scenes::planned_for(*scene, scene->frame_pose(frame)));
    }
  }
}

TEST_CASE("A flight volume upside down", "[flight_volume]") {
  const TemporaryFolder folder;
  const tests::Outcome outcome =
      tests::build_text(folder, live() + "[flight_volume]\nlowest_m = 500.0\nhighest_m = 100.0\n");
  CHECK_THAT(tests::messages(folder, outcome.problems),
             Catch::VectorContains(std::string(
                 "@/scene.toml:27:1: E-RANGE flight_volume.highest_m = 100: expected at least "
                 "lowest_m, 500")));
  // One side alone can be wrong as well.
  const tests::Outcome high =
      tests::build_text(folder, live() + "[flight_volume]\nlowest_m = 9000.0\n");
  REQUIRE(high.scene == nullptr);
  CHECK(tests::messages(folder, high.problems).front().find("E-RANGE flight_volume = 8949 to ") !=
        std::string::npos);
}

TEST_CASE("A scene without a trajectory has no frames of its own", "[flight_volume]") {
  const TemporaryFolder folder;
  const auto session = session_of(folder, live());
  CHECK_THROWS_AS(session->render_flown(0, session->scene()->plan), core::InputError);
}
