// Heights from shadows on shipped scenes, beside what stands there. docs/physics/shadow-heights.md
// holds the figures of every 20th frame; here fewer frames, with a little slack.
#include <catch2/catch.hpp>

#include "tests/scenes/shadow_truth.h"

using namespace fanbeam;
using namespace fanbeam::tests;

namespace {

ShadowTally tally_of(const std::string& name, const std::string& wishes, int step) {
  core::ProblemList problems;
  const std::filesystem::path source = FANBEAM_SOURCE_DIR;
  const scenes::SceneDescription description =
      scenes::read_scene(source / "scenes" / name, {source, {}, {}}, problems);
  scenes::BuildOptions build;
  if (!wishes.empty()) build.wishes = renderer::parse_effect_wishes(wishes);
  const auto scene = scenes::build_scene(description, build, problems);
  return tally_shadows(*scene, step);
}

void check_all_found_within_1_m(const ShadowTally& tally, const std::string& box, int least_free) {
  const ShadowScore& score = tally.boxes.at(box);
  INFO(box << ": free " << score.free << ", found " << score.found << ", within " << score.within
           << ", worst " << score.worst_m << " m");
  CHECK(score.free >= least_free);
  CHECK(score.found == score.free);
  CHECK(score.within == score.found);
}

}  // namespace

TEST_CASE("on level ground every wall and hangar with a free shadow has its height within 1 m",
          "[shadow]") {
  // No ground mirrored in metal walls fills the shadows.
  const ShadowTally tally = tally_of("obstacle-field", "-double-bounce", 40);
  CHECK(tally.frames == 15);
  check_all_found_within_1_m(tally, "wall", 13);
  check_all_found_within_1_m(tally, "oblique wall", 10);
  check_all_found_within_1_m(tally, "hangar west", 6);
  check_all_found_within_1_m(tally, "hangar east", 2);
  CHECK(tally.boxes.at("tower").free == 0);  // its shadow leaves the range gate
  CHECK(tally.false_alarms <= 1);            // the runway in the farthest frame
}

TEST_CASE("metal walls mirror ground into their shadows, dull walls keep theirs", "[shadow]") {
  const ShadowTally tally = tally_of("obstacle-field", "", 80);
  check_all_found_within_1_m(tally, "wall", 6);
  check_all_found_within_1_m(tally, "oblique wall", 5);
  // Fewer of the hangars' shadows are left; those tell the height.
  const ShadowScore& hangar = tally.boxes.at("hangar west");
  CHECK(hangar.found < hangar.free);
  CHECK(hangar.within == hangar.found);
  CHECK(tally.false_alarms <= 1);
}

TEST_CASE("rolling ground: how often and how well, and false alarms per frame", "[shadow]") {
  const ShadowTally tally = tally_of("braunschweig-26", "", 40);
  INFO(tally.false_alarms << " false alarms in " << tally.frames << " frames, "
                          << tally.buildings.found << " at buildings, " << tally.buildings.within
                          << " of them within 1 m, " << tally.woods << " at woods");
  CHECK(tally.false_alarms <= 0.6 * tally.frames);             // measured 0.35
  CHECK(tally.buildings.found >= 6 * tally.frames);            // measured 9.2
  CHECK(tally.buildings.within >= tally.buildings.found / 3);  // measured 41 %
}
