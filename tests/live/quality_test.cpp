// The error that is told with live pictures.
#include "live/quality.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/units.h"
#include "live/flights.h"
#include "live/mailbox.h"
#include "renderer/plan/effects.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;

namespace {

live::Status told_by(const live::Quality& quality, double samples) {
  live::Status status;
  status.samples = samples;
  const auto begin = live::Clock::now();
  while (!status.errors && live::seconds_between(begin, live::Clock::now()) < 200.0) {
    quality.tell(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return status;
}

std::shared_ptr<const live::LiveFrame> frame_at(const session::Session& session, double samples,
                                                std::uint64_t number) {
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = number;
  frame->samples = samples;
  frame->pose = live::circle(*session.scene())(1.0);
  frame->under = session.now();
  return frame;
}

}  // namespace

TEST_CASE("The error that is told is the renderer's own estimate for the frame that is shown",
          "[quality][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Quality quality(*session, hub, 0.05);
  live::Status nothing;
  quality.tell(nothing);
  CHECK_FALSE(nothing.errors.has_value());
  hub.publish(frame_at(*session, 1.0, 1));
  const live::Status coarse = told_by(quality, 1.0);
  REQUIRE(coarse.errors.has_value());

  renderer::Sampling sampling = session->sampling();
  sampling.estimate_error = true;
  const auto scene = session->scene();
  const renderer::Effects effects = renderer::without_draws(renderer::effects_of(scene->plan, 0));
  const renderer::Frame made = renderer::render_frame(scene->world, sampling, {true, true}, effects,
                                                      scene->pose_at(live::circle(*scene)(1.0)));
  REQUIRE(made.error.has_value());
  CHECK(coarse.errors->bscope_grey == made.error->rms_grey);
  CHECK(coarse.errors->cscope_grey == made.error->cscope_rms_grey);

  // Of another sampling nothing is told until it was looked at; a finer one is closer.
  session->set(session::Samples{16.0});
  live::Status finer;
  finer.samples = 16.0;
  quality.tell(finer);
  CHECK_FALSE(finer.errors.has_value());
  hub.publish(frame_at(*session, 16.0, 2));
  finer = told_by(quality, 16.0);
  REQUIRE(finer.errors.has_value());
  CHECK(finer.errors->bscope_grey < 0.5 * coarse.errors->bscope_grey);
}

// It was gone for five seconds at each step of the ladder, and for as long as the aircraft was far out.
TEST_CASE("The error of a step that was measured is told at once, that of another one soon",
          "[quality][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Quality quality(*session, hub, 1000.0);  // of a step that was measured
  hub.publish(frame_at(*session, 1.0, 1));
  const live::Status coarse = told_by(quality, 1.0);
  REQUIRE(coarse.errors.has_value());
  session->set(session::Samples{4.0});
  hub.publish(frame_at(*session, 4.0, 2));
  REQUIRE(told_by(quality, 4.0).errors.has_value());
  live::Status again;
  again.samples = 1.0;
  quality.tell(again);
  REQUIRE(again.errors.has_value());
  CHECK(again.errors->bscope_grey == coarse.errors->bscope_grey);

  // From 4 km south, beyond the terrain's edge, towards it.
  session->set(session::Samples{2.0});
  auto outside = std::make_shared<live::LiveFrame>(*frame_at(*session, 2.0, 3));
  outside->pose.position = {core::radians(51.964), core::radians(10.0), 350.0};
  outside->pose.q_NB = core::quaternion_from({0.0, 0.0, 0.0});
  outside->outside_volume = true;
  const auto events = session->render(outside->under, outside->pose, 3).events;
  REQUIRE(std::count(events.begin(), events.end(), "outside_volume") == 1);
  hub.publish(outside);
  const live::Status far = told_by(quality, 2.0);
  REQUIRE(far.errors.has_value());
  CHECK(far.errors->bscope_grey > 0.0);
}

TEST_CASE("Whoever ends does not wait for the next look", "[quality][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const auto begin = live::Clock::now();
  { const live::Quality quality(*session, hub, 1000.0); }
  CHECK(live::seconds_between(begin, live::Clock::now()) < 5.0);
}

// It took the flight with it.
TEST_CASE("The error of a frame that cannot be made is not told and that of the next one is",
          "[quality][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  auto endless = std::make_shared<scenes::Scene>(*session->scene());
  endless->plan = {};
  endless->world.sensor.scan.columns = -1;  // as a size: more than any vector holds
  auto frame = std::make_shared<live::LiveFrame>(*frame_at(*session, 1.0, 1));
  frame->under = session->moment(endless);
  live::Hub hub;
  hub.publish(frame);
  const live::Quality quality(*session, hub, 0.05);
  std::this_thread::sleep_for(std::chrono::seconds(1));  // it looks
  live::Status status;
  status.samples = 1.0;
  quality.tell(status);
  CHECK_FALSE(status.errors.has_value());
  hub.publish(frame_at(*session, 1.0, 2));
  CHECK(told_by(quality, 1.0).errors.has_value());
}
