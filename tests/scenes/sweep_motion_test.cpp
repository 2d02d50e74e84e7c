// S11: a frame is one instant, the middle of its sweep. What moves the aircraft during a sweep is
// not in a picture.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/frame_renderer.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

TEST_CASE("S11: a frame flown at 70 m/s is the picture of a radar that stands there",
          "[sweep_motion]") {
  const TemporaryFolder folder;
  const Outcome outcome = build_text(folder, kSmallScene);
  REQUIRE(outcome.scene);
  const scenes::Scene& scene = *outcome.scene;
  const double rate_Hz = scene.world.sensor.scan.frame_rate_Hz;
  const renderer::FrameRenderer frames(scene.world, renderer::sampling_for(1.0), {},
                                       {{core::EffectId::thermal_noise}});
  for (const int frame : {0, 1, 100}) {
    core::Pose standing = scene.trajectory->at((frame + 0.5) / rate_Hz);
    CHECK(std::hypot(standing.v_N_mps.x, standing.v_N_mps.y) == Approx(70.0).epsilon(1e-3));
    standing.v_N_mps = glm::dvec3(0.0);
    const renderer::Frame flown = frames.render(scene.frame_pose(frame));
    const renderer::Frame still = frames.render(scene.pose_at(standing));
    CHECK(flown.bscope_W == still.bscope_W);
    CHECK(flown.cscope_W_m3 == still.cscope_W_m3);
    CHECK(flown.bscope_grey == still.bscope_grey);
  }
  // From frame to frame everything comes nearer by one frame's way over the ground: 4.375 m.
  const glm::dvec2 step_m(scene.frame_pose(101).position_m - scene.frame_pose(100).position_m);
  CHECK(glm::length(step_m) == Approx(70.0 / rate_Hz).margin(1e-3).epsilon(0.0));
}

}  // namespace fanbeam::tests
