// A sequence on disk is what its session renders, and asks for nothing that is not there.
#include "session/sequence.h"

#include <catch2/catch.hpp>
#include <set>
#include <span>

#include "core/image.h"
#include "core/parallel.h"
#include "core/units.h"
#include "sensors/display/display.h"
#include "tests/needed_program.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

std::unique_ptr<session::Session> opened(const TemporaryFolder& folder,
                                         const session::ProductSet& products = {"bscope",
                                                                                "cscope"}) {
  folder.write("scene.toml", tests::kSmallScene);
  core::ProblemList problems;
  session::Setup setup{.shipped = FANBEAM_SOURCE_DIR, .seed = 7};
  session::plan_for(products, setup.build);
  return std::make_unique<session::Session>(folder.path(), setup, problems);
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

// Its budget was measured with all processors, and the record told them.
TEST_CASE("A sequence keeps to the threads of its session", "[sequence]") {
  const TemporaryFolder scene, out;
  scene.write("scene.toml", tests::kSmallScene);
  core::ProblemList problems;
  session::Session session(scene.path(), {.shipped = FANBEAM_SOURCE_DIR, .threads = 1}, problems);
  const session::Sequence sequence =
      session::render_sequence(session,
                               {.output = out.path() / "run",
                                .frames = "3",
                                .products = {"bscope"},
                                .sampling = {.rays_per_cell = 2.0}},
                               [](int, int) { CHECK(core::ThreadLimit::threads() == 1); });
  CHECK(sequence.record.threads == 1);
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

TEST_CASE("A sequence is refused products that the plan of its session was not told of",
          "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  for (const char* product : {"power", "labels", "detections", "obstacles"}) {
    INFO(product);
    try {
      session::render_sequence(
          *session, {.output = out.path() / "run", .frames = "3", .products = {"bscope", product}},
          [](int, int) {});
      FAIL("taken");
    } catch (const core::InputError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK(error.problems()[0].code == "E-REF");
      CHECK(error.problems()[0].value == product);
    }
  }
  CHECK_FALSE(std::filesystem::exists(out.path() / "run"));
}

// They were taken for those of another input and removed: the plan gave other reasons and bounds.
TEST_CASE("A run of other products keeps the pictures of the run before", "[sequence]") {
  const TemporaryFolder scene, out;
  const auto folder = out.path() / "run";
  std::set<std::string> listed;
  for (const char* product : {"bscope", "detections", "cscope"}) {
    const auto session = opened(scene, {product});
    const session::Sequence sequence =
        session::render_sequence(*session,
                                 {.output = folder,
                                  .frames = "3",
                                  .products = {product},
                                  .sampling = {.rays_per_cell = 2.0}},
                                 [](int, int) {});
    REQUIRE(sequence.record.frames.size() == 1);
    listed = sequence.record.frames[0].files;
  }
  CHECK(listed == std::set<std::string>{"bscope/00003.png", "cscope/00003.png",
                                        "detections/00003.csv", "detections/00003.png"});
  for (const std::string& file : listed) CHECK(std::filesystem::exists(folder / file));
}

// They were kept: what a session sets stood in no fingerprint.
TEST_CASE("Frames of other conditions are not kept, and those of the same are", "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  std::set<std::string> inputs;
  const auto kept = [&] {
    const session::Sequence sequence = session::render_sequence(*session,
                                                                {.output = out.path() / "run",
                                                                 .frames = "3",
                                                                 .products = {"bscope", "cscope"},
                                                                 .sampling = {.rays_per_cell = 2.0},
                                                                 .resume = true},
                                                                [](int, int) {});
    for (const auto& [key, value] : core::read_metadata(out.path() / "run" / "bscope/00003.png"))
      if (key == "fanbeam:input") inputs.insert(value);
    return sequence.record.frames.at(0).resumed;
  };
  const auto is_new = [&] { return !kept() && kept(); };
  CHECK(is_new());
  const atmosphere::Weather own = session->scene()->weather;
  atmosphere::Weather weather = own;
  weather.humidity = 0.5;
  session->set(weather);
  CHECK(is_new());
  session->set(session::SensorSettings{.cscope_mode = sensors::Display::CScopeMode::flat_earth});
  CHECK(is_new());
  session::TargetState truck{.name = "truck",
                             .position = {core::radians(52.002), core::radians(10.0), 60.0},
                             .rcs = materials::ConstantRcs{100.0}};
  session->set(std::span(&truck, 1));
  CHECK(is_new());
  truck.rcs = materials::ConstantRcs{200.0};
  session->set(std::span(&truck, 1));
  CHECK(is_new());
  truck.swerling = core::Swerling::case1;
  session->set(std::span(&truck, 1));
  CHECK(is_new());
  truck.position.latitude_rad = core::radians(52.003);
  session->set(std::span(&truck, 1));
  CHECK(is_new());
  CHECK(inputs.size() == 7);
  // As the file says again.
  session->set(own);
  session->set(session::SensorSettings{});
  session->set(std::span<const session::TargetState>());
  CHECK(is_new());
  CHECK(inputs.size() == 7);
}

TEST_CASE("A frame with its error estimated is another than one without", "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  const auto frame = [&](bool estimate) {
    return session::render_sequence(*session,
                                    {.output = out.path() / "run",
                                     .frames = "3",
                                     .products = {"bscope"},
                                     .sampling = {.rays_per_cell = 2.0, .estimate_error = estimate},
                                     .resume = true},
                                    [](int, int) {})
        .record.frames.at(0);
  };
  for (const bool estimate : {false, true, false})
    for (const bool resumed : {false, true}) {
      INFO("estimated " << estimate << ", again " << resumed);
      const session::FrameRecord record = frame(estimate);
      CHECK(record.resumed == resumed);
      CHECK(record.error.has_value() == estimate);
    }
}

TEST_CASE("Frames refined for a C-scope too are others than those of the B-scope alone",
          "[sequence]") {
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  const auto kept = [&](const session::ProductSet& products, session::SamplingRequest sampling) {
    return session::render_sequence(*session,
                                    {.output = out.path() / "run",
                                     .frames = "3",
                                     .products = products,
                                     .sampling = sampling,
                                     .resume = true},
                                    [](int, int) {})
        .record.frames.at(0)
        .resumed;
  };
  const session::SamplingRequest refined{.accuracy_grey = 4.0}, fixed{.rays_per_cell = 2.0};
  CHECK_FALSE(kept({"bscope", "cscope"}, refined));
  CHECK_FALSE(kept({"bscope"}, refined));
  CHECK(kept({"bscope"}, refined));
  CHECK_FALSE(kept({"bscope", "cscope"}, refined));
  // Else the one picture does not depend on the other.
  CHECK_FALSE(kept({"bscope", "cscope"}, fixed));
  CHECK(kept({"bscope"}, fixed));
}

TEST_CASE("A film has its name only once its folder knows that it is its own", "[sequence]") {
  if (!tests::needed_program("ffmpeg")) return;
  const TemporaryFolder scene, out;
  const auto session = opened(scene);
  const auto folder = out.path() / "run";
  const auto render = [&] {
    session::render_sequence(*session,
                             {.output = folder,
                              .frames = "3",
                              .products = {"preview"},
                              .sampling = {.rays_per_cell = 1.0}},
                             [](int, int) {});
  };
  // What the folder's note cannot replace.
  std::filesystem::create_directories(folder / ".unfinished.json" / "in-the-way");
  CHECK_THROWS_AS(render(), core::InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "preview.mp4"));
  std::filesystem::remove_all(folder / ".unfinished.json");
  render();
  CHECK(std::filesystem::exists(folder / "preview.mp4"));
}
