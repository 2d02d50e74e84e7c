// Things narrower than a sub-column: met by one ray in several, they have their power on average.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

double frame_W(const renderer::World& world, const renderer::Sampling& sampling,
               const renderer::FramePose& pose) {
  const renderer::Frame frame = renderer::render_frame(world, sampling, {}, {}, pose);
  return std::accumulate(frame.bscope_W.begin(), frame.bscope_W.end(), 0.0);
}

}  // namespace

// Where two rays differed, one in an azimuth of its own was put between them. It took from the share of the one that had
// met the mast, and never from that of one that had missed: 3.5 dB too little at four sub-columns a column.
TEST_CASE("A mast half a metre wide returns by rays on average what it returns by slices",
          "[rays]") {
  const materials::PhongNrcs grass(0.0325, 0.136, 1.99), wall(0.0, 0.1, 0.0);
  const auto scene = [&](std::vector<tests::Body> bodies) {
    return tests::world(tests::hivision(64),
                        tests::ground(3600.0, 200.0, [](double, double) { return 0.0; }),
                        {grass, wall}, std::move(bodies));
  };
  const renderer::World with = scene({tests::box({-0.25, 2500.0, 0.0}, {0.25, 2500.5, 40.0}, 1)});
  const renderer::World without = scene({});
  renderer::Sampling slices;
  slices.caster = renderer::CasterKind::profile;
  constexpr int kPoses = 120;
  renderer::FramePose pose = tests::level_pose(60.0);
  // The plain looks the same from everywhere.
  double by_rays_W = -kPoses * frame_W(without, {}, pose);
  double by_slices_W = -kPoses * frame_W(without, slices, pose);
  for (int i = 0; i < kPoses; ++i) {
    const double place = 0.6180339887 * i;
    pose.position_m.x = 600.0 * (place - std::floor(place) - 0.5);
    by_rays_W += frame_W(with, {}, pose);
    by_slices_W += frame_W(with, slices, pose);
  }
  CHECK(by_rays_W / by_slices_W == Approx(1.0).epsilon(0.0).margin(0.05));
}
