// Flights that need no simulator stay in the air, in the scene, and see the runway.
#include "live/flights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;

TEST_CASE("The circle passes over the threshold along the runway, level and banked for its turn",
          "[flights]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  const live::Flight flight = live::circle(*scene);
  const core::Pose first = flight(0.0);
  const glm::dvec3 at_m = scene->frame.to_local_m(first.position);
  const glm::dvec3 threshold_m = scene->runways[0].ends[0].threshold_m;
  CHECK(at_m.x == Approx(threshold_m.x).epsilon(0.0).margin(0.01));
  CHECK(at_m.y == Approx(threshold_m.y).epsilon(0.0).margin(0.01));
  CHECK(at_m.z - threshold_m.z >= 149.9);
  const core::Attitude attitude = core::attitude_from(first.q_NB);
  CHECK(std::sin(attitude.heading_rad) ==
        Approx(0.0).epsilon(0.0).margin(1e-3));  // the runway leads north
  CHECK(attitude.pitch_rad == Approx(0.0).epsilon(0.0).margin(1e-9));
  // Position and velocity agree, and so do bank and turn: g tan(bank) = v^2 / r.
  constexpr double kStep_s = 0.01;
  for (double time_s = 0.0; time_s < 200.0; time_s += 7.0) {
    const core::Pose pose = flight(time_s), next = flight(time_s + kStep_s);
    const glm::dvec3 here_m = scene->frame.to_local_m(pose.position);
    const glm::dvec3 moved_m = scene->frame.to_local_m(next.position) - here_m;
    CHECK(glm::length(moved_m) / kStep_s == Approx(70.0).epsilon(1e-4));
    const glm::dvec3 told_mps = scene->frame.north_east_down_at(pose.position) * pose.v_N_mps;
    CHECK(glm::length(moved_m / kStep_s - told_mps) < 0.05);
    const double turn_radps = std::remainder(core::attitude_from(next.q_NB).heading_rad -
                                                 core::attitude_from(pose.q_NB).heading_rad,
                                             2.0 * core::kPi) /
                              kStep_s;
    CHECK(std::tan(core::attitude_from(pose.q_NB).roll_rad) ==
          Approx(70.0 * turn_radps / 9.80665).epsilon(0.01));
    CHECK(scene->world.surfaces().height_above_ground_m(here_m) > 100.0);
    CHECK(scene->volume.holds(here_m));
  }
}

TEST_CASE("A scene without a runway is circled, one without a trajectory has no approach",
          "[flights]") {
  std::string text = tests::kSmallScene;
  text.erase(text.find("[trajectory.ils]"));
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder, text);
  CHECK_THROWS_AS(live::approach(*session->scene()), core::InputError);
  text.erase(text.find("[[runway]]"));
  const auto bare = tests::live_session(folder, text);
  const live::Flight flight = live::circle(*bare->scene());
  for (double time_s = 0.0; time_s < 200.0; time_s += 7.0)
    CHECK(bare->scene()->volume.holds(bare->scene()->frame.to_local_m(flight(time_s).position)));
}

TEST_CASE("The approach is the trajectory, and begins again at its end", "[flights]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  const live::Flight flight = live::approach(*scene);
  const double length_s = scene->trajectory->end_s() - scene->trajectory->begin_s();
  for (const double time_s : {0.0, 3.0, length_s - 0.1}) {
    const core::Pose flown = scene->trajectory->at(scene->trajectory->begin_s() + time_s);
    CHECK(flight(time_s).position.latitude_rad == flown.position.latitude_rad);
    CHECK(flight(time_s + length_s).position.height_m ==
          Approx(flown.position.height_m).epsilon(0.0).margin(1e-6));
  }
}
