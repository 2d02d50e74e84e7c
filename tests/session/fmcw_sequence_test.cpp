// A sequence at signal level on disk: what it writes and tells, and what it refuses before that.
#include "session/signal/fmcw_sequence.h"

#include <catch2/catch.hpp>

#include "session/signal/radar_file.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

TEST_CASE("A sequence at signal level has the paths of its frames, and says where its files are",
          "[fmcw]") {
  const tests::TemporaryFolder folder, out;
  folder.write("scene.toml", tests::standing() + "[sensor]\nfile = \"automotive-76.toml\"\n");
  core::ProblemList problems;
  const auto scene = scenes::build_scene(
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems), {}, problems);
  session::FmcwSequenceSettings settings{
      .output = out.path() / "run", .frames = "0", .products = {"beat"}};
  settings.radar.transmitters = 1;  // few samples, for speed
  settings.radar.receivers = 2;
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i)
    if (session::kWaveformNumbers[i].option == std::string("--chirps"))
      settings.radar.numbers[i] = 16.0;
  std::vector<int> heard;
  const auto progress = [&](int done, int total) {
    CHECK(total == 1);
    heard.push_back(done);
  };

  // It has no other radar: nothing is made, not even the folder.
  session::FmcwSequenceSettings refused = settings;
  refused.products = {"interference"};
  CHECK_THROWS_AS(session::run_fmcw(*scene, refused, progress), core::InputError);
  CHECK(heard.empty());
  CHECK_FALSE(std::filesystem::exists(out.path() / "run"));

  const session::FmcwSequence sequence = session::run_fmcw(*scene, settings, progress);
  CHECK(heard == std::vector<int>{0, 1});
  REQUIRE(sequence.frames.size() == 1);
  CHECK(sequence.frames[0].chain);
  CHECK(sequence.frames[0].paths == session::fmcw_paths(*scene, 0, settings.radar).paths.size());
  CHECK(sequence.frames[0].files == std::set<std::string>{"beat/00000.npy"});
  REQUIRE(sequence.places.size() == 2);
  CHECK(sequence.places[0].name == "beat");
  CHECK(std::filesystem::exists(sequence.places[0].path / "00000.npy"));
  CHECK(sequence.places[1].path == out.path() / "run" / "run.json");
  CHECK(std::filesystem::exists(sequence.places[1].path));
  // Read again without the scene, the samples have maps of the same cells: its sensor ends at 151 m, they at 240 m.
  const session::FmcwRadar made = session::fmcw_radar(settings.radar, scene->description.sensor);
  const session::FmcwRadar again =
      session::fmcw_radar(session::radar_settings(out.path() / "run" / "radar.toml"));
  CHECK(made.detection.transform.kept_range_cells < signal::samples_per_segment(again.waveform, 0));
  CHECK(again.detection.transform.kept_range_cells == made.detection.transform.kept_range_cells);
}
