// Heights from shadows on shipped scenes, beside what stands there. docs/physics/shadow-heights.md
// holds the figures of every 20th frame; here fewer frames, with a little slack.
#include <catch2/catch.hpp>

#include "tests/scenes/shadow_truth.h"

using namespace fanbeam;
using tests::ShadowScore;
using tests::ShadowTally;

namespace {

ShadowTally tally_of(const std::string& name, const std::string& wishes, int step) {
  core::ProblemList problems;
  const std::filesystem::path source = FANBEAM_SOURCE_DIR;
  const scenes::SceneDescription description =
      scenes::read_scene(source / "scenes" / name, {source, {}, {}}, problems);
  scenes::BuildOptions build;
  if (!wishes.empty()) build.wishes = renderer::parse_effect_wishes(wishes);
  const auto scene = scenes::build_scene(description, build, problems);
  return tests::tally_shadows(*scene, step);
}

// Of the frames with a free shadow at least `least_given` get a height, and those are within.
void check_heights(const ShadowTally& tally, const std::string& box, int least_given) {
  const ShadowScore& score = tally.boxes.at(box);
  INFO(box << ": free " << score.free << ", reported " << score.seen << ", with a height "
           << score.found << ", within " << score.within << ", worst " << score.worst_m << " m");
  CHECK(score.found >= least_given);
  CHECK(score.within == score.found);
}

void check_share_within(const ShadowTally& tally, int least_heights, double least_share) {
  INFO(tally.heights << " heights, " << tally.within << " within, " << tally.uncertain
                     << " obstacles without a height, " << tally.false_alarms
                     << " false alarms, of them with a height " << tally.false_heights << " in "
                     << tally.frames << " frames");
  CHECK(tally.heights >= least_heights);
  CHECK(tally.within >= least_share * tally.heights);
  CHECK(tally.false_heights == 0);
}

}  // namespace

TEST_CASE("on level ground the heights that are given lie within 1 m", "[shadow]") {
  // No ground mirrored in metal walls fills the shadows.
  const ShadowTally tally = tally_of("obstacle-field", "-double-bounce", 40);
  CHECK(tally.frames == 15);
  check_share_within(tally, 28, 1.0);  // measured 31
  check_heights(tally, "wall", 13);
  check_heights(tally, "oblique wall", 8);
  check_heights(tally, "hangar west", 7);
  check_heights(tally, "hangar east", 0);
  CHECK(tally.boxes.at("tower").free == 0);  // its shadow leaves the range gate
  CHECK(tally.false_alarms <= 1);            // the runway in the farthest frame
}

TEST_CASE("metal walls mirror ground into their shadows: what has a height is still within 1 m",
          "[shadow]") {
  const ShadowTally tally = tally_of("obstacle-field", "", 80);
  check_share_within(tally, 13, 1.0);  // measured 15
  CHECK(tally.false_alarms <= 1);
}

TEST_CASE("rolling ground: few heights are given, about nine of ten within the criterion",
          "[shadow]") {
  const ShadowTally tally = tally_of("braunschweig-26", "", 40);
  check_share_within(tally, 25, 0.85);                           // every 20th frame: 62 of 69
  CHECK(tally.buildings.within >= 0.9 * tally.buildings.found);  // 57 of 57
  CHECK(tally.uncertain >= 5 * tally.frames);
  CHECK(tally.false_alarms <= 0.5 * tally.frames);  // 0.23 per frame
}
