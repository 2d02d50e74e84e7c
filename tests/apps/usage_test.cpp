// What cannot be meant is refused before anything is done, with what was expected or meant.
#include <map>
#include <set>

#include "apps/number_check.h"
#include "tests/apps/commands.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

TEST_CASE("A seed is a whole number from 0 to 2^64 - 1, and no other number is read as one",
          "[cli]") {
  const TemporaryFolder folder;
  const std::string to = " -q -o " + quoted(folder.path() / "out");
  const std::string largest = "18446744073709551615";
  REQUIRE(run_fanbeam("render flat-grass --seed " + largest + to).exit_code == 0);
  CHECK(json_of(folder.path() / "out/run.json").at("seed").get<std::uint64_t>() == UINT64_MAX);
  const auto before = contents(folder.path());
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "1e3", "0x10", "nan", "''"}) {
    const Result refused = run_fanbeam(std::string("render flat-grass --seed ") + seed + to);
    INFO(seed << ": " << refused.output);
    CHECK(refused.exit_code == 2);
    CHECK((contents(folder.path()) == before));
  }
  CHECK(run_fanbeam("render --seed -1")
            .output.find("--seed: -1 given, expected a whole number from 0 to " + largest) !=
        std::string::npos);
}

TEST_CASE("A whole number is plain decimal digits within its limits", "[cli]") {
  const CLI::Validator check = fanbeam::apps::whole_number_from(1, 64);
  for (const char* good : {"1", "8", "64"}) CHECK(check(std::string(good)).empty());
  // CLI11 alone would read 010 as eight, 0x10 as sixteen, and blanks and a plus as nothing.
  for (const char* bad : {"0", "65", "-1", "1.5", "1e1", "010", "0x10", " 8", "+8", "8 ", "",
                          "18446744073709551617", "eight"})
    CHECK(check(std::string(bad)) ==
          std::string(bad) + " given, expected a whole number from 1 to 64");
}

TEST_CASE("A number is decimal, finite and within its limits", "[cli]") {
  const CLI::Validator check = fanbeam::apps::number_from(-2.5, 1e7);
  for (const char* good : {"-2.5", "0", "1e7", "0.1"}) CHECK(check(std::string(good)).empty());
  for (const char* bad : {"-2.6", "1.1e7", "nan", "inf", "-inf", "1,5", "0x1p3", "", "1e400"})
    CHECK(check(std::string(bad)) ==
          std::string(bad) + " given, expected a number from -2.5 to 1e7");
}

TEST_CASE("No option of any command takes a negative number as a whole one, or a NaN as a number",
          "[cli]") {
  std::size_t seeds = 0, options = 0;
  std::set<std::string> numbers;  // one command is asked where several share an option
  for (const ManPage& page : man_pages())
    for (const ManOption& option : page.options) {
      const bool whole = option.takes("N");
      if (!whole && !(option.takes("NUMBER") && numbers.insert(option.name()).second)) continue;
      ++options;
      if (option.name() == "--seed") ++seeds;
      const std::string words = page.command + " " + option.name() + (whole ? " -1" : " nan");
      const Result refused = run_fanbeam(words);
      INFO("fanbeam " << words << ": " << refused.output);
      CHECK(refused.exit_code == 2);
      if (whole)
        CHECK(refused.output.find(option.name() + ": -1 given, expected a whole number from ") !=
              std::string::npos);
    }
  CHECK(seeds >= 3);
  CHECK(options >= 50);
}

TEST_CASE("A data folder that is not there is told by every command that takes one", "[cli]") {
  const TemporaryFolder folder;
  folder.write("file", "");
  std::set<std::string> commands;
  for (const ManPage& page : man_pages())
    for (const ManOption& option : page.options)
      if (option.name() == "--data") commands.insert(page.command);
  CHECK(commands.size() >= 8);
  const std::map<std::string, std::string> words = {
      {"init", "new --airport EDNY --runway 24 --apt-dat file --dem file"},
      {"list", "scenes"},
      {"regress run", quoted(FANBEAM_SOURCE_DIR "/tests/golden/suite.toml")}};
  for (const std::string& command : commands)
    for (const fs::path& data : {folder.path() / "nowhere", folder.path() / "file"}) {
      const auto own = words.find(command);
      const Result told =
          run_fanbeam(command + " " + (own == words.end() ? "flat-grass" : own->second) +
                          " --data " + quoted(data),
                      "cd " + quoted(folder.path()) + " &&");
      INFO(command << ": " << told.output);
      CHECK((told.exit_code == 4 || command == "init"));  // whose other files are no airport's
      CHECK(told.exit_code > 2);
      CHECK(told.output.find("E-IO --data = \"" + data.string() +
                             "\": expected a folder that exists") != std::string::npos);
      for (const char* made : {"out", "new"}) CHECK_FALSE(fs::exists(folder.path() / made));
    }
}

TEST_CASE("Scene, sensor and data folder that are not there are told together", "[cli]") {
  const Result told = run_fanbeam("render flat-gras --sensor hivison --data /nowhere");
  INFO(told.output);
  CHECK(told.exit_code == 4);
  CHECK(told.output.find("one of the scenes: flat-grass ") != std::string::npos);
  CHECK(told.output.find("--sensor = \"hivison\" not found: expected a sensor file, or one of the "
                         "shipped sensors: hivision ") != std::string::npos);
  CHECK(told.output.find("--data = \"/nowhere\"") != std::string::npos);
  CHECK(told.output.find("3 errors\n") != std::string::npos);
}

TEST_CASE("A file that the command line names and that is not there is E-IO, exit code 4",
          "[cli]") {
  for (const char* words :
       {"render flat-grass --sensor nowhere.toml", "fmcw --sensor nowhere.toml",
        "materials --library nowhere.toml", "materials objects --library nowhere.toml",
        "materials plot -o /dev/null/x.svg --library nowhere.toml",
        "materials fit --library nowhere.toml", "materials fit --csv nowhere.csv",
        "track nowhere.json", "compare nowhere.png nowhere-else.png", "live --replay nowhere.jsonl",
        "live --token-file nowhere.txt"}) {
    const Result told = run_fanbeam(words);
    INFO("fanbeam " << words << ": " << told.output);
    CHECK(told.exit_code == 4);
    CHECK(told.output.find("E-IO") != std::string::npos);
    CHECK(told.output.find("nowhere") != std::string::npos);
    CHECK(told.output.find("expected ") != std::string::npos);
  }
  CHECK(run_fanbeam("compare nowhere.png nowhere-else.png").output.find("2 errors") !=
        std::string::npos);
}

TEST_CASE("An option that would do nothing beside the others given is refused", "[cli]") {
  const TemporaryFolder folder;
  folder.write("a.png", "");  // not even looked at
  const std::string a = quoted(folder.path() / "a.png");
  for (const std::string option : {"--rms 5", "--largest 5", "--percent 5"}) {
    const Result told = run_fanbeam("compare --exact " + option + " " + a + " " + a);
    INFO(told.output);
    CHECK(told.exit_code == 2);
    CHECK(told.output.find(option.substr(0, option.find(' ')) + " excludes --exact") !=
          std::string::npos);
  }
  const std::string data = " --data " + quoted(folder.path());
  for (const char* words :
       {"list", "list sensors", "list products --json", "list scenes --names"}) {
    const Result told = run_fanbeam(words + data);
    INFO(words << ": " << told.output);
    CHECK(told.exit_code == 2);
    CHECK(told.output.find("--data: only tells in fanbeam list scenes") != std::string::npos);
  }
  for (const char* words : {"list scenes", "list scenes --json", "list --json"})
    CHECK(run_fanbeam(words + data).exit_code == 0);
}

TEST_CASE("A misspelt command or option is answered with the nearest one", "[cli]") {
  const std::pair<const char*, const char*> slips[] = {
      {"rendr", "fanbeam: no command rendr; did you mean render?\n"},
      {"redner flat-grass", "no command redner; did you mean render?\n"},
      {"help rendr", "fanbeam: no command rendr; did you mean render?\n"},
      {"help materials plt", "fanbeam materials: no command plt; did you mean plot?\n"},
      {"render --frame 0:1", "fanbeam render: no option --frame; did you mean --frames?\n"},
      {"render --acuracy=1", "no option --acuracy; did you mean --accuracy?\n"},
      {"materials plot --ouput x.svg", "no option --ouput; did you mean --output?\n"},
      {"compare --exat a b", "no option --exat; did you mean --exact?\n"},
      // What was meant to be a value of the unknown option is not blamed.
      {"compare --rsm 3 a b", "fanbeam compare: no option --rsm; did you mean --rms?\n"}};
  for (const auto& [words, answer] : slips) {
    const Result result = run_fanbeam(words);
    INFO("fanbeam " << words << ": " << result.output);
    CHECK(result.exit_code == 2);
    CHECK(result.output.find(answer) != std::string::npos);
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') <= 2);
  }
}

// It was asked whether -q had been meant by -q.
TEST_CASE("Of an option before its command it is told that it belongs after it", "[cli]") {
  const std::pair<const char*, const char*> early[] = {
      {"-q render", "fanbeam render: -q belongs after the command: fanbeam render -q\n"},
      {"--seed=3 render flat-grass",
       "fanbeam render: --seed belongs after the command: fanbeam render --seed\n"},
      {"materials --output x.svg plot",
       "fanbeam materials plot: --output belongs after the command: fanbeam materials plot "
       "--output\n"},
      {"--frame 0:1 render", "fanbeam render: no option --frame; did you mean --frames?\n"}};
  for (const auto& [words, answer] : early) {
    const Result result = run_fanbeam(words);
    INFO("fanbeam " << words << ": " << result.output);
    CHECK(result.exit_code == 2);
    CHECK(result.output.find(answer) != std::string::npos);
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') <= 2);
  }
}

TEST_CASE("Of a list with too few or too many values it is told how many it takes", "[cli]") {
  const std::pair<const char*, const char*> counts[] = {
      {"track x.json --body-errors 0.1,0.1", "--body-errors takes 3 values, M,MPS,DEG: 2 given\n"},
      {"track x.json --body-errors 1,2,3,4", "--body-errors takes 3 values, M,MPS,DEG: 4 given\n"},
      {"fmcw --cfar-guard 1,2,3", "--cfar-guard takes 1 or 2 values, N[,N]: 3 given\n"},
      {"fmcw --seed 1 --seed 2", "--seed is given more than once: one N\n"}};
  for (const auto& [words, answer] : counts) {
    const Result result = run_fanbeam(words);
    INFO("fanbeam " << words << ": " << result.output);
    CHECK(result.exit_code == 2);
    CHECK(result.output.find(answer) != std::string::npos);
  }
  const std::string help = run_fanbeam("help track").output + run_fanbeam("help fmcw").output;
  for (const std::string value : {"--body-errors M,MPS,DEG", "--cfar-guard N[,N]"}) {
    CHECK(help.find(value) != std::string::npos);
    CHECK(help.find(value + ",") == std::string::npos);
  }
}

TEST_CASE("Nothing is suggested for what looks like nothing, but where to look is told", "[cli]") {
  const Result command = run_fanbeam("quux");
  CHECK(command.exit_code == 2);
  CHECK(command.output.find("did you mean") == std::string::npos);
  CHECK(command.output.find("there are render plan cost") != std::string::npos);
  const Result option = run_fanbeam("render --quux-of-it");
  CHECK(option.exit_code == 2);
  CHECK(option.output.find("did you mean") == std::string::npos);
  CHECK(option.output.find("\"fanbeam help render\" lists its options") != std::string::npos);
  const Result surplus = run_fanbeam("compare a b c");
  CHECK(surplus.exit_code == 2);
  CHECK(surplus.output.find("nothing to do with \"c\"") != std::string::npos);
  const Result none = run_fanbeam("");
  CHECK(none.exit_code == 2);
  CHECK(none.output.find("Pictures of a scene:") != std::string::npos);
  CHECK(none.output.find("a command is missing") != std::string::npos);
  const Result value = run_fanbeam("render --seed");
  CHECK(value.exit_code == 2);
  CHECK(value.output.find("--seed needs N: ") != std::string::npos);
}
