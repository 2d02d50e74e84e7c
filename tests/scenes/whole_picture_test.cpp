// The whole picture of shipped scenes, every planned effect in it: slices, whose bounces follow their
// number, against rays with jittered samples.
#include <catch2/catch.hpp>

#include "renderer/accuracy/grey_error.h"
#include "renderer/frame.h"
#include "tests/scenes/shipped_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;

namespace {

renderer::FramePower power_of(const scenes::Scene& scene, int frame,
                              const renderer::Sampling& sampling) {
  renderer::Frame rendered =
      renderer::render_frame(scene.world, sampling, {true, true},
                             renderer::effects_of(scene.plan, 0), scene.frame_pose(frame));
  return {std::move(rendered.bscope_W), std::move(rendered.cscope_W_m3)};
}

// Against a quarter of the reference, whose own error over Innsbruck is 0.18 and 0.14 grey.
void check_convergence(const scenes::Scene& scene, int frame) {
  REQUIRE(scene.plan.runs(core::EffectId::double_bounce));
  const renderer::GreyReference reference(
      scene.world.sensor, power_of(scene, frame, renderer::reference_sampling(1, 4)));
  const auto error_of = [&](double slices) {
    return reference.error_of(
        power_of(scene, frame, renderer::sampling_for(renderer::CasterKind::profile, slices)));
  };
  const renderer::FrameError few = error_of(4), more = error_of(16), many = error_of(64);
  const auto rms = [](const renderer::PictureError& error) { return error.with_noise.rms; };
  // Asked for of both scopes: 0.5 grey with noise, 0.8 noise-free.
  CHECK(rms(many.bscope) < 0.5);
  CHECK(many.bscope.noise_free.rms < 0.8);
  CHECK(rms(many.cscope) < 0.5);
  CHECK(many.cscope.noise_free.rms < 0.8);
  // Sixteen times the slices have a quarter of the error or a little more.
  CHECK(rms(more.bscope) < 0.6 * rms(few.bscope));
  CHECK(rms(many.bscope) < 0.35 * rms(few.bscope));
  CHECK(rms(more.cscope) < 0.6 * rms(few.cscope));
  CHECK(rms(many.cscope) < 0.35 * rms(few.cscope));
}

}  // namespace

TEST_CASE("Bounces converge with the slices: an airport", "[scenes][bounce]") {
  check_convergence(*tests::shipped_scene("braunschweig-26"), 1200);
}

TEST_CASE("Converged slices are converged rays over a city, bounces included",
          "[scenes][bounce][data]") {
  const auto data = tests::shared_data("lowi-innsbruck");
  if (!data) return;
  check_convergence(*tests::shipped_scene("innsbruck-26", {data->parent_path()}), 700);
}
