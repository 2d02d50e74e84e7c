// fanbeam waveform: its figures are those of the library, and what it cannot use it refuses.
#include "tests/apps/program.h"

using namespace fanbeam;

TEST_CASE("The waveform command prints the figures of the reference radar", "[waveform_command]") {
  const auto run = tests::run_fanbeam("waveform two-stage --json");
  REQUIRE(run.exit_code == 0);
  const auto json = nlohmann::json::parse(run.output);
  REQUIRE(json["stages"].size() == 2);
  CHECK(json["stages"][0]["range_cell_m"].get<double>() == Approx(0.599585).epsilon(1e-6));
  CHECK(json["stages"][0]["taylor_width_m"].get<double>() == Approx(0.7117).epsilon(1e-4));
  CHECK(json["stages"][0]["speed_cell_mps"].get<double>() == Approx(0.38522).epsilon(2e-5));
  CHECK(json["stages"][1]["frequency_bin_Hz"].get<double>() == Approx(500.0));
  CHECK_FALSE(json.contains("target"));

  const auto table = tests::run_fanbeam("waveform triangle --ramp 20000");
  CHECK(table.exit_code == 0);
  CHECK(table.output.find("beat per metre") != std::string::npos);
  CHECK(table.output.find("83.391") != std::string::npos);
}

TEST_CASE("The waveform command tells a target's beats and what folds", "[waveform_command]") {
  // 100 km/h towards the radar on a ramp of 20 ms: the beat on the ramp up is negative. Its range
  // is 100 m in the middle of that ramp, 99.7222 m at the turnaround.
  const auto run = tests::run_fanbeam(
      "waveform triangle --ramp 20000 --range 99.722222 --speed -27.777778 --json");
  REQUIRE(run.exit_code == 0);
  const auto json = nlohmann::json::parse(run.output);
  CHECK(json["target"]["beats"][0]["beat_Hz"].get<double>() ==
        Approx(-5744.71).epsilon(0.0).margin(0.05));
  CHECK(json["target"]["doppler_shift_Hz"].get<double>() ==
        Approx(14083.8188).epsilon(0.0).margin(0.01));
  CHECK(json["target"]["warnings"].empty());

  const auto folded = tests::run_fanbeam("waveform --range 300 --speed 60");
  CHECK(folded.exit_code == 0);
  CHECK(folded.output.find("W-FOLDED stage 0 range") != std::string::npos);
  CHECK(folded.output.find("W-FOLDED stage 0 radial speed") != std::string::npos);
  CHECK(tests::run_fanbeam("waveform --range 300 --refuse-folding").exit_code == 3);
}

TEST_CASE("The waveform command refuses what the kind does not have", "[waveform_command]") {
  const auto run = tests::run_fanbeam("waveform triangle --pulses 8");
  CHECK(run.exit_code == 2);
  CHECK(run.output.find("--pulses") != std::string::npos);
  CHECK(tests::run_fanbeam("waveform continuous --down-first").exit_code == 2);
  CHECK(tests::run_fanbeam("waveform sawteeth").exit_code == 2);
  CHECK(tests::run_fanbeam("waveform --bandwidth nan").exit_code == 2);
  CHECK(tests::run_fanbeam("waveform --bandwidth 80000").exit_code == 2);
  CHECK(tests::run_fanbeam("waveform --chirps 2.5").exit_code == 2);
  CHECK(tests::run_fanbeam("waveform --speed 3").exit_code == 2);
  const auto help = tests::run_fanbeam("waveform --help");
  CHECK(help.exit_code == 0);
  for (const char* word : {"KIND", "--bandwidth", "--refuse-folding", "--json", "receding"})
    CHECK(help.output.find(word) != std::string::npos);
}

TEST_CASE("The waveform command tells what does not go together in the units of its options",
          "[waveform_command]") {
  const auto told = [](const std::string& options, const std::string& words) {
    const auto run = tests::run_fanbeam("waveform " + options);
    INFO(options << ": " << run.output);
    CHECK(run.exit_code == 2);
    CHECK(run.output.find(words) != std::string::npos);
  };
  told("--interval 10", "--interval = 10: expected at least the ramp");
  told("two-slopes --second-ramp 2000",
       "--second-ramp = 2000: expected another time than the first ramp");
  told("--frequency 0.2 --bandwidth 250", "--bandwidth = 250: expected below the frequency");
  told("stepped --shift -300000", "--shift = 300000: expected below the bandwidth");
  // The number of samples is no rate.
  told("--sample-rate 100000", "--sample-rate = 5.12e+08 samples: expected at most 1e8 in a frame");
  told("--chirps 65536 --slots 256", "--chirps x slots = 16777216: expected 1 to 1000000");
}

TEST_CASE("The waveform command tells all that is wrong in one run", "[waveform_command]") {
  const auto run = tests::run_fanbeam("waveform --chirps 2.5 --slots 1.5 --pulses 8 --interval 10");
  INFO(run.output);
  CHECK(run.exit_code == 2);
  for (const char* words : {"--chirps = 2.5", "--slots = 1.5", "--pulses = 8", "--interval = 10"})
    CHECK(run.output.find(words) != std::string::npos);
}

TEST_CASE("A mixer's tables do not take the place of somebody's", "[waveform_command]") {
  const tests::TemporaryFolder folder;
  const auto mixer = [&] {
    return tests::run_fanbeam("waveform --range 60 --mixer " + tests::quoted(folder.path()));
  };
  folder.write("mixer.csv", "time_s,volts\n0,1\n");
  folder.write("beat.csv", "mine");
  auto run = mixer();
  INFO(run.output);
  CHECK(run.exit_code == 2);
  for (const char* name : {"without mixer.csv", "without beat.csv"})
    CHECK(run.output.find(name) != std::string::npos);
  CHECK(tests::bytes_of(folder.path() / "beat.csv") == "mine");
  for (const char* name : {"mixer.csv", "beat.csv"}) std::filesystem::remove(folder.path() / name);
  folder.write("mixer.png", "mine");
  CHECK(mixer().exit_code == 2);
  std::filesystem::remove(folder.path() / "mixer.png");
  CHECK(mixer().exit_code == 0);
  CHECK(mixer().exit_code == 0);  // its own it writes again
}
