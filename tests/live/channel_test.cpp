// What a channel shows of a source that falls silent.
#include "live/channel.h"

#include <catch2/catch.hpp>

#include "live/desk.h"
#include "live/flights.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;

// Who looks at pictures alone took the last one for that of an aircraft that stands.
TEST_CASE("F13 a second without a pose shows the last picture once more, as out of date",
          "[channel][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  core::Pose pose = live::circle(*scene)(1.0);
  pose.v_N_mps = glm::dvec3(0.0);
  live::Hub hub;
  live::Mailbox mailbox;
  const auto begin = live::Clock::now();
  mailbox.put(pose);
  std::vector<std::shared_ptr<const live::LiveFrame>> frames;
  core::StopSource stop;
  int stale_ticks = 0;
  const auto told = [&](live::Status& status) {
    const auto newest = hub.newest();
    REQUIRE(newest);
    if (frames.empty() || frames.back()->number != newest->number) frames.push_back(newest);
    CHECK(status.stale == newest->stale);
    // What is shown once more has a number, and is no frame that was rendered.
    CHECK(status.frames + (status.stale || stale_ticks > 0 ? 1 : 0) == newest->number);
    if (status.stale && ++stale_ticks == 10) mailbox.put(pose);
    if (stale_ticks > 0 && !status.stale) stop.request();
  };
  live::run_channel(*session, live::source_of(mailbox, scene->frame, begin), {20.0, 1.0, begin},
                    hub, told, stop.token());
  REQUIRE(frames.size() >= 3);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CHECK(frames[i]->number == i + 1);
    CHECK(frames[i]->stale == (i + 2 == frames.size()));
  }
  const live::LiveFrame &last = *frames[frames.size() - 3], &stale = *frames[frames.size() - 2];
  CHECK(stale.pose_age_ms > 1000.0);
  CHECK(last.pose_age_ms < stale.pose_age_ms);
  // Readers time frames by that.
  CHECK(frames[0]->began_s > std::chrono::duration<double>(begin.time_since_epoch()).count());
  CHECK(last.began_s > frames[0]->began_s);
  CHECK(stale.began_s == last.began_s);
  CHECK(stale.bscope.pixels == last.bscope.pixels);
  CHECK(stale.cscope.pixels == last.cscope.pixels);
  CHECK(stale.pose.position.latitude_rad == last.pose.position.latitude_rad);
  CHECK(hub.origin(stale.number)->scene == hub.origin(last.number)->scene);
  for (const live::Scope scope : {live::Scope::bscope, live::Scope::cscope}) {
    const auto& pixels = scope == live::Scope::bscope ? stale.bscope.pixels : stale.cscope.pixels;
    CHECK(live::picture_to_show(last, scope).pixels == pixels);
    CHECK(live::picture_to_show(stale, scope).pixels != pixels);
  }
}

// Rate, age and picture were those of a flight, for as long as every pose was refused.
TEST_CASE(
    "F13 a second of poses that are refused shows the last picture once more, and the rate falls",
    "[channel][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const core::Pose here = live::circle(*session->scene())(1.0);
  core::Pose elsewhere = here;
  elsewhere.position.latitude_rad = 0.0;
  live::Hub hub;
  core::StopSource stop;
  bool fallen = false;
  const live::PoseSource source = [&](double, double) {
    const bool refused = hub.status().frames >= 5 && !fallen;
    return std::optional(live::Sighting{refused ? elsewhere : here});
  };
  std::vector<std::shared_ptr<const live::LiveFrame>> frames;
  const auto told = [&](live::Status& status) {
    const auto newest = hub.newest();
    REQUIRE(newest);
    if (frames.empty() || frames.back()->number != newest->number) frames.push_back(newest);
    CHECK(status.stale == newest->stale);
    if (fallen && !status.stale) stop.request();
    fallen = fallen || (status.stale && status.rate_Hz == 0.0);
  };
  live::run_channel(*session, source, {20.0, 1.0}, hub, told, stop.token());
  REQUIRE(frames.size() == 7);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CHECK(frames[i]->number == i + 1);
    CHECK(frames[i]->stale == (i == 5));
  }
  CHECK(frames[5]->pose_age_ms > 1000.0);
  CHECK(frames[5]->bscope.pixels == frames[4]->bscope.pixels);
  CHECK(hub.status().frames == 6);
  CHECK(hub.status().refused > 10);
}

// A number runs ahead of the frames with each picture that is shown once more: readers of shared memory, who take
// numbers that rise, missed as many frames of the next scene.
TEST_CASE("Frames of a scene that follows another go on from its newest number", "[channel]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  live::Status before;
  before.frames = 66;
  hub.tell(before);
  core::StopSource stop;
  live::run_lockstep(
      *session, live::circle(*session->scene()), {.samples = 1.0, .newest_number = 70}, hub,
      [&](live::Status&) { stop.request(); }, stop.token());
  REQUIRE(hub.newest());
  CHECK(hub.newest()->number == 71);
  CHECK(hub.status().frames == 67);
}
