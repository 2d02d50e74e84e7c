// What a path is to a tracker, and which scenarios of a file it takes.
#include "session/signal/sources/track_input.h"

#include <catch2/catch.hpp>
#include <string>

#include "core/errors.h"
#include "session/signal/tracks/scenario_record.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using session::TrackInput;

namespace {

namespace fs = std::filesystem;

// Of a folder with these files.
TrackInput folder_of(const std::vector<std::string>& names) {
  const tests::TemporaryFolder folder;
  for (const std::string& name : names) {
    fs::create_directories((folder.path() / name).parent_path());
    folder.write(name, "");
  }
  return session::track_input(folder.path());
}

}  // namespace

TEST_CASE("An input is told by its name, its folder's files, or what its JSON holds",
          "[track_input]") {
  const tests::TemporaryFolder folder;
  const auto json = [&](const std::string& text) {
    return session::track_input(folder.write("input.json", text));
  };
  CHECK(json(R"({"time_s": 0, "detections": []})") == TrackInput::detections);
  CHECK(json(R"({"frames": []})") == TrackInput::detections);
  CHECK(json(R"({"scenarios": []})") == TrackInput::scenarios);
  CHECK(json("[]") == TrackInput::scenarios);
  CHECK(json("{") == TrackInput::scenarios);
  CHECK(session::track_input(folder.path() / "none.json") == TrackInput::scenarios);
  CHECK(session::track_input("any.csv") == TrackInput::detections);
  CHECK(session::track_input("any.npy") == TrackInput::samples);
  CHECK(session::track_input("street-76ghz") == TrackInput::scene);

  CHECK(folder_of({}) == TrackInput::detections);
  CHECK(folder_of({"scene.toml", "beat/00000.npy"}) == TrackInput::scene);
  CHECK(folder_of({"run.json", "radar.toml", "beat/00000.npy"}) == TrackInput::samples);
  CHECK(folder_of({"00000.npy"}) == TrackInput::samples);
  CHECK(folder_of({"run.json", "beat/00000.npy", "detections/00000.json"}) ==
        TrackInput::detections);
}

TEST_CASE("Samples without the file of their radar are refused by the option that names it",
          "[track_input]") {
  const tests::TemporaryFolder folder;
  CHECK_THROWS_WITH(session::recorded_source(folder.write("any.npy", ""), {}, {}),
                    Catch::Contains("E-REF --radar = not given: expected the radar file"));
  CHECK_THROWS_WITH(
      session::recorded_source(folder.path() / "none.npy", {}, {}),
      Catch::Contains("E-REF --radar = not given") && Catch::Contains("none.npy: E-IO"));
}

TEST_CASE("Scenarios of a file are chosen by their id, with the radar that the settings mean",
          "[track_input]") {
  scenes::HighwayFile file;
  for (const char* id : {"S1", "S2"}) {
    file.scenarios.emplace_back();
    file.scenarios.back().id = id;
    file.scenarios.back().radar.noise_figure = 2.0;
  }
  session::TrackSettings settings;
  const auto all = session::chosen_scenarios(file, "", settings);
  REQUIRE(all.size() == 2);
  CHECK(all[1].scenario == &file.scenarios[1]);
  CHECK(all[1].radar.noise_figure == 2.0);
  CHECK(all[1].radar.array_elements == 12);
  settings.noise_figure_dB = 10.0;
  settings.range_only = true;
  const auto one = session::chosen_scenarios(file, "S2", settings);
  REQUIRE(one.size() == 1);
  CHECK(one[0].scenario->id == "S2");
  CHECK(one[0].radar.noise_figure == Approx(10.0).epsilon(1e-12));
  CHECK(one[0].radar.array_elements == 1);

  CHECK_THROWS_WITH(session::chosen_scenarios(file, "S9", settings),
                    Catch::Contains("E-REF --scenario = \"S9\": expected one of: S1, S2"));
  file.scenarios[0].id = "../S1";
  CHECK(session::chosen_scenarios(file, "S2", settings).size() == 1);
  CHECK_THROWS_WITH(session::chosen_scenarios(file, "", settings),
                    Catch::Contains("E-PATH scenario id = \"../S1\""));
}

// Tracked to the end, it was the run's record that could not be written.
TEST_CASE("Scenarios named like a record are refused with all bad names, before any is tracked",
          "[track_input]") {
  scenes::HighwayFile file;
  file.name = "road.json";
  for (const char* id : {"run.json", "S1", "timing.json", "../S2"}) {
    file.scenarios.emplace_back();
    file.scenarios.back().id = id;
  }
  CHECK_THROWS_WITH(session::chosen_scenarios(file, "", {}),
                    Catch::Contains("road.json: E-PATH scenario id = \"run.json\"") &&
                        Catch::Contains("\"timing.json\"") && Catch::Contains("\"../S2\""));
  CHECK(session::chosen_scenarios(file, "S1", {}).size() == 1);
}
