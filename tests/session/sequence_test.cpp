// A sequence on disk is what its session renders, and asks for nothing that is not there.
#include "session/sequence.h"

#include <catch2/catch.hpp>

#include "core/image.h"
#include "sensors/display/display.h"
#include "tests/scenes/scene_folder.h"

namespace {

using namespace fanbeam;
using tests::TemporaryFolder;

std::unique_ptr<session::Session> opened(const TemporaryFolder& folder) {
  folder.write("scene.toml", tests::kSmallScene);
  core::ProblemList problems;
  return std::make_unique<session::Session>(
      folder.path(), session::Setup{.shipped = FANBEAM_SOURCE_DIR, .seed = 7}, problems);
}

std::vector<double> grey(const core::Picture8& picture) {
  return {picture.pixels.begin(), picture.pixels.end()};
}

}  // namespace

TEST_CASE("Pictures of a sequence are those that its session renders", "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  std::vector<int> heard;
  const session::Sequence sequence = session::render_sequence(*session,
                                                              {.output = out.path() / "run",
                                                               .frames = "3:6:2",
                                                               .products = {"bscope", "cscope"},
                                                               .sampling = {.rays_per_cell = 2.0}},
                                                              [&](int done, int total) {
                                                                CHECK(total == 2);
                                                                heard.push_back(done);
                                                              });
  CHECK(heard == std::vector<int>{0, 1, 2});
  REQUIRE(sequence.record.frames.size() == 2);
  CHECK(sequence.record.frames[1].index == 5);
  CHECK(sequence.record.seed == 7);
  REQUIRE(sequence.places.size() == 3);
  CHECK(std::filesystem::exists(sequence.places.back().path));  // run.json
  const auto shown = session->scene();
  for (const session::FrameRecord& record : sequence.record.frames) {
    const renderer::Frame frame = session->render_flown(record.index, shown->plan);
    const sensors::Sensor& sensor = shown->description.sensor;
    const std::string name = "0000" + std::to_string(record.index) + ".png";
    CHECK(core::read_image(out.path() / "run" / "bscope" / name).layers.at(0).values ==
          grey(sensors::bscope_picture(sensor, frame.bscope_grey)));
    CHECK(core::read_image(out.path() / "run" / "cscope" / name).layers.at(0).values ==
          grey(sensors::cscope_picture(sensor, frame.cscope_grey)));
  }
}

TEST_CASE("All that a sequence asks for in vain is told at once, and nothing is written",
          "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  const auto refused = [&](const session::SequenceSettings& settings) {
    try {
      session::render_sequence(*session, settings, [](int, int) {});
    } catch (const core::InputError& error) {
      return error.problems().size();
    }
    return std::size_t{0};
  };
  CHECK(refused({.output = out.path() / "run",
                 .products = {"bscop", "cscope", "film"},
                 .preview_format = "avi",
                 .range_unit = "mile"}) == 4);
  CHECK(refused({.output = out.path() / "run"}) == 1);
  CHECK(refused({.output = out.path() / "run", .frames = "9999", .products = {"bscope"}}) == 1);
  CHECK_FALSE(std::filesystem::exists(out.path() / "run"));
}
