// A flight by the words of a command line, without the command.
#include "live/wiring/run.h"

#include <catch2/catch.hpp>

#include "tests/live/live_scene.h"

using namespace fanbeam;

TEST_CASE(
    "A run opens its scene, tells of its page and its frames, and ends after as many as asked",
    "[live]") {
  const tests::TemporaryFolder folder;
  const live::RunSettings settings{
      .http = "0", .rays_per_cell = 1.0, .lockstep = true, .frames = 2};
  std::vector<std::string> opened, shown;
  std::vector<std::uint64_t> frames;
  const auto heard = std::make_shared<int>();  // held by whoever hears of this scene
  const live::RunCallbacks calls{.open =
                                     [&](const std::string& scene) {
                                       opened.push_back(scene);
                                       return tests::live_session(folder);
                                     },
                                 .page =
                                     [&](const std::string& scene, std::uint16_t port) {
                                       CHECK(port != 0);  // of 0, any that is free
                                       CHECK(frames.empty());
                                       shown.push_back(scene);
                                     },
                                 .status =
                                     [&] {
                                       return
                                           [&frames, heard](const live::Status& now, int viewers) {
                                             CHECK(viewers == 0);
                                             frames.push_back(now.frames);
                                           };
                                     }};
  live::run_live(settings, live::wiring_of(settings, nullptr), nullptr, "here", calls);
  CHECK(opened == std::vector<std::string>{"here"});
  CHECK(shown == std::vector<std::string>{"test"});
  REQUIRE_FALSE(frames.empty());
  CHECK(frames.back() == 2);
  CHECK(heard.use_count() == 1);  // the scene is left, and so is who heard of it
}

TEST_CASE("The token of the environment counts where no file of one is named", "[live]") {
  const live::RunSettings settings{.http = "0.0.0.0:0"};  // beyond this machine
  CHECK_THROWS_AS(live::wiring_of(settings, nullptr), core::InputError);
  CHECK(live::wiring_of(settings, "0123456789abcdef").access.has_token());
  // Too short, and told in the words of the environment.
  try {
    live::wiring_of({}, "short");
    FAIL("taken");
  } catch (const core::InputError& error) {
    CHECK(core::to_string(error.problems().front()).find(live::kTokenVariable) !=
          std::string::npos);
  }
}
