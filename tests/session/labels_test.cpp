// Labels of frames: masks as runs, signal to clutter, and what a scene of known geometry is told to
// hold. Formats and positions are judged from outside, in tests/python/labels_test.py.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/parallel.h"
#include "renderer/plan/plan.h"
#include "session/labels/frame_labels.h"
#include "session/labels/labels_json.h"
#include "session/labels/masks.h"
#include "session/session.h"

using namespace fanbeam;
using session::MaskLabel;

namespace {

MaskLabel mask_of(std::vector<std::uint32_t> cells) {
  MaskLabel mask;
  mask.cells = std::move(cells);
  return mask;
}

}  // namespace

TEST_CASE("Runs count cells outside and inside in turn, and all of them", "[labels]") {
  using Runs = std::vector<std::uint32_t>;
  CHECK(session::runs_of(mask_of({}), 6) == Runs{6});
  CHECK(session::runs_of(mask_of({0, 1}), 6) == Runs{0, 2, 4});
  CHECK(session::runs_of(mask_of({2, 3, 5}), 6) == Runs{2, 2, 1, 1});
  CHECK(session::runs_of(mask_of({0, 1, 2, 3, 4, 5}), 6) == Runs{0, 6});
  CHECK(session::runs_of(mask_of({1, 3}), 6) == Runs{1, 1, 1, 1, 2});
}

TEST_CASE("Signal to clutter is the strongest cell over the cells around it and the noise",
          "[labels]") {
  constexpr int kColumns = 40, kRows = 40, kReach = 2;
  std::vector<double> power_W(static_cast<std::size_t>(kColumns * kRows), 1e-12);
  const auto at = [&](int column, int row) -> double& {  // of a picture: the farthest row first
    return power_W[static_cast<std::size_t>((kRows - 1 - row) * kColumns + column)];
  };
  at(20, 10) = 1e-9;
  at(21, 10) = at(19, 10) = at(22, 10) = 5e-10;  // what the beam smears is no clutter
  const MaskLabel mask = mask_of({20 * kRows + 10});
  CHECK(*session::signal_to_clutter_dB(mask, power_W, kColumns, kReach, 0.0) ==
        Approx(30.0).epsilon(1e-12));
  CHECK(*session::signal_to_clutter_dB(mask, power_W, kColumns, kReach, 9e-12) ==
        Approx(20.0).epsilon(1e-12));
  // In a corner of the picture too.
  at(0, 0) = 1e-10;
  CHECK(*session::signal_to_clutter_dB(mask_of({0}), power_W, kColumns, kReach, 0.0) ==
        Approx(20.0).epsilon(1e-12));
  CHECK_FALSE(
      session::signal_to_clutter_dB(mask, std::vector<double>(1600, 0.0), kColumns, kReach, 1e-12));
}

TEST_CASE("What fills all around itself stands out of nothing that is known", "[labels]") {
  const std::vector<double> power_W(9, 1e-9);
  CHECK_FALSE(
      session::signal_to_clutter_dB(mask_of({0, 1, 2, 3, 4, 5, 6, 7, 8}), power_W, 3, 1, 1e-12));
}

TEST_CASE("A frame's labels are the same for any number of threads", "[labels]") {
  core::ProblemList problems;
  const std::filesystem::path root(FANBEAM_SOURCE_DIR);
  session::Setup setup;
  setup.shipped = root;
  session::Session session(root / "scenes" / "obstacle-field", setup, problems);
  const auto scene = session.scene();
  const core::Pose pose = scene->trajectory->at(scene->trajectory->frame_time_s(400, 16.0));
  const renderer::Frame frame = session.render(pose, 400, {.layers = true, .cscope_layers = true});
  const session::Labeller labeller(*scene);
  const auto text = [&] {
    return session::labels_json(labeller.labels(*scene, pose, frame), *scene, 400, pose, {});
  };
  const std::string all = text();
  const core::ThreadLimit one(1);
  CHECK(text() == all);
  const session::FrameLabels labels = labeller.labels(*scene, pose, frame);
  CHECK(labels.objects.size() > 3);
  for (const session::ObjectLabel& object : labels.objects) {
    INFO(object.name);
    CHECK(object.in_sight_share >= 0.0);
    CHECK(object.in_sight_share <= 1.0);
    // What a picture holds cells of stands where the formula says: within its own size.
    if (object.bscope.cells.empty() || !object.middle.bscope) continue;
    CHECK(object.middle.bscope->at_px.y > object.bscope.top - 40);
    CHECK(object.middle.bscope->at_px.y < object.bscope.top + object.bscope.rows + 40);
  }
  const core::Metadata metadata = {{"fanbeam:input", "0123"}, {"fanbeam:rays", "7"}};
  CHECK(session::labels_metadata(session::labels_json(labels, *scene, 400, pose, metadata),
                                 "x.json") == metadata);
  CHECK_THROWS_AS(session::labels_metadata("{\"metadata\": {\"a\": 1}", "x.json"),
                  core::InputError);
  CHECK_THROWS_AS(session::labels_metadata("[]", "x.json"), core::InputError);
}
