// The program as a user meets it: exit codes, messages, what validate, compare and bad input do.
#include <filesystem>
#include <regex>

#include "renderer/plan/effect_catalogue.h"
#include "session/products/products.h"
#include "tests/apps/commands.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

const std::string kBadScene =
    "[scene]\nname = \"bad\"\norigin = { latitude_deg = 95.0, longitude_deg = 10.0 }\n"
    "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\nabove_ground = 60.0\n";

}  // namespace

TEST_CASE("Help and version are told with exit code 0", "[cli]") {
  const std::string version_text = run_fanbeam("--version").output;
  for (const ManPage& page : man_pages()) {
    const std::string& command = page.command;
    INFO(command);
    const Result help = run_fanbeam(command + " --help");
    CHECK(help.exit_code == 0);
    CHECK(help.output.find("Usage") != std::string::npos);
    for (const char* option : {"--version", "--quiet", "--log-level"})
      CHECK((command.empty() || help.output.find(option) != std::string::npos));
    const Result version = run_fanbeam(command + " --version");
    CHECK(version.exit_code == 0);
    CHECK(version.output == version_text);
  }
  CHECK(run_fanbeam("--help").output.find("Exit codes: 0 done, 1 comparison failed, 2 usage") !=
        std::string::npos);
  CHECK(run_fanbeam("--version").output.rfind("fanbeam ", 0) == 0);
}

TEST_CASE("render --help names every effect and product", "[cli]") {
  // As one line: the help wraps.
  const std::string help =
      std::regex_replace(run_fanbeam("render --help").output, std::regex("\\s+"), " ");
  for (const fanbeam::renderer::Effect& effect : fanbeam::renderer::effect_catalogue())
    CHECK(help.find(effect.name()) != std::string::npos);
  for (const fanbeam::session::Product& product : fanbeam::session::kProducts)
    CHECK(help.find(std::string(product.name) + " (") != std::string::npos);
}

TEST_CASE("Exit code 2: a command line that cannot be understood", "[cli]") {
  for (const char* words :
       {"", "rendr", "render --nope", "render --threads many", "render --threads -1",
        "render --rays-per-cell 0", "render --rays-per-cell 0.29",
        "render --reference --rays-per-cell 4", "compare one.png",
        "render flat-grass --caster lidar", "render flat-grass --reference --caster profile",
        "render --log-level loud", "render flat-grass --frames 1:x", "render flat-grass --frames 5",
        "render flat-grass --products bscope,dscope", "render flat-grass --effects +magic",
        "render flat-grass --preview-format avi"}) {
    INFO("fanbeam " << words);
    const Result result = run_fanbeam(words);
    INFO(result.output);
    CHECK(result.exit_code == 2);
    CHECK_FALSE(result.output.empty());
  }
}

TEST_CASE("The range of --accuracy is one, whichever command takes it", "[cli]") {
  for (const char* command : {"render", "plan", "doctor", "fmcw"}) {
    const auto run = [&](const std::string& grey) {
      return run_fanbeam(std::string(command) + " /nonexistent --accuracy " + grey);
    };
    // The scene is looked for when the command line is understood: exit code 4, no such file.
    for (const char* grey : {"0.01", "100"}) {
      INFO(command << " --accuracy " << grey);
      CHECK(run(grey).exit_code == 4);
    }
    for (const char* grey : {"0", "0.009", "100.1", "255", "nan", "-1"}) {
      INFO(command << " --accuracy " << grey);
      CHECK(run(grey).exit_code == 2);
    }
  }
}

TEST_CASE("What takes long is told as long as it takes", "[cli]") {
  // Measured on two cores: 43 to 77 s over fields and cities on a machine that others used too.
  for (const char* command : {"render", "cost"}) {
    const std::string help = run_fanbeam(std::string(command) + " --help").output;
    std::string words;  // as one line, whatever the width of the page
    std::istringstream stream(help);
    for (std::string word; stream >> word;) words += (words.empty() ? "" : " ") + word;
    INFO(help);
    CHECK(words.find("10 s to well over a minute") != std::string::npos);
    CHECK(words.find("longest over a city") != std::string::npos);
  }
}

TEST_CASE("Exit code 3: every problem of a scene in one run, and the output folder stays as it was",
          "[cli]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", kBadScene);
  fs::create_directories(folder.path() / "out/bscope");
  folder.write("out/bscope/00000.png", "an older picture");
  folder.write("out/run.json", "{}");
  const auto before = contents(folder.path());
  const auto time_before = fs::last_write_time(folder.path() / "out");
  for (const std::string& words :
       {"validate " + quoted(folder.path()),
        "render " + quoted(folder.path()) + " -o " + quoted(folder.path() / "out"),
        "render " + quoted(folder.path() / "scene.toml") + " -q --resume -o " +
            quoted(folder.path() / "out")}) {
    const Result result = run_fanbeam(words);
    INFO(result.output);
    CHECK(result.exit_code == 3);
    const std::string file = (folder.path() / "scene.toml").string();
    CHECK(result.output.find(
              file + ":3:12: E-RANGE scene.origin.latitude_deg = 95: expected -90 to 90\n") !=
          std::string::npos);
    CHECK(result.output.find(
              file +
              ":1:1: E-REF scene.vertical_datum = missing: expected what heights count from") !=
          std::string::npos);
    CHECK(result.output.find(
              file +
              ":4:1: E-REF trajectory.fixed.above_ground_m = missing: expected -1000 to 20000\n") !=
          std::string::npos);
    CHECK(result.output.find(file + ":6:1: E-REF trajectory.fixed.above_ground = unknown key") !=
          std::string::npos);
    CHECK(result.output.find("4 errors\n") != std::string::npos);
    CHECK((contents(folder.path()) == before));
    CHECK(fs::last_write_time(folder.path() / "out") == time_before);
  }
}

TEST_CASE(
    "Exit code 3 for a scene without its data, which it names; a new output folder is not made",
    "[cli]") {
  const TemporaryFolder folder;
  folder.write("scene.toml",
               "[scene]\nname = \"t\"\norigin = { latitude_deg = 52.0, longitude_deg = 10.0 "
               "}\nvertical_datum = \"scene\"\n"
               "[terrain]\nelevation = \"no-such-data/dem.tif\"\n[trajectory.fixed]\n"
               "at = { latitude_deg = 52.0, longitude_deg = 10.0 }\nabove_ground_m = 60.0\n");
  fs::create_directories(folder.path() / "from/option");
  const fs::path option = folder.path() / "from/option";
  const Result result = run_fanbeam("render " + quoted(folder.path()) + " --data " +
                                        quoted(option) + " -o " + quoted(folder.path() / "out"),
                                    "FANBEAM_DATA=/from/environment");
  CHECK(result.exit_code == 3);
  CHECK(result.output.find(
            "/scene.toml:6:1: E-IO terrain.elevation = \"no-such-data/dem.tif\" not found") !=
        std::string::npos);
  CHECK(result.output.find(folder.path().string() + ", " + option.string() +
                           ", /from/environment") != std::string::npos);
  CHECK(result.output.find("--data DIR or FANBEAM_DATA") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}

TEST_CASE("Exit code 4: what the system refuses", "[cli]") {
  const TemporaryFolder folder;
  folder.write("file", "");
  const std::string long_name(5000, 'a');
  for (const std::string& words :
       {std::string("validate no-such-scene"), "validate " + long_name,
        "validate " + quoted(folder.path()), std::string("render flat-grass --sensor missing.toml"),
        "render flat-grass -q -o " + quoted(folder.path() / "file"),
        "render flat-grass -q -o " + quoted(folder.path() / "file/deeper"),
        std::string("compare missing.png missing.png"),
        std::string("live flat-grass --http 0 -q --from csv:/proc/self/mem")}) {
    INFO("fanbeam " << words.substr(0, 100));
    const Result result = run_fanbeam(words);
    INFO(result.output.substr(0, 500));
    CHECK(result.exit_code == 4);
    CHECK(result.output.find("E-IO") != std::string::npos);
  }
  for (const char* shipped : {" braunschweig-26", " flat-grass"})
    CHECK(run_fanbeam("validate no-such-scene").output.find(shipped) != std::string::npos);
  CHECK(fs::file_size(folder.path() / "file") == 0);
}

TEST_CASE("validate describes a good scene, and is quiet when asked", "[cli]") {
  const Result result = run_fanbeam("validate flat-grass");
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("flat-grass: valid") == 0);
  CHECK(result.output.find("frames      1 at 16 Hz") != std::string::npos);
  CHECK(run_fanbeam("validate flat-grass -q").output.empty());
  // By folder, by file, by name, from elsewhere.
  const fs::path folder = FANBEAM_SOURCE_DIR "/scenes/flat-grass";
  for (const std::string& scene : {quoted(folder), quoted(folder / "scene.toml"),
                                   std::string("scenes/flat-grass"), std::string("flat-grass")})
    CHECK(run_fanbeam("validate -q " + scene, "cd / &&").exit_code == 0);
}

TEST_CASE("A folder that only bears a shipped scene's name does not hide it", "[cli]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "flat-grass/bscope");
  CHECK(run_fanbeam("validate flat-grass -q", "cd " + quoted(folder.path()) + " &&").exit_code ==
        0);
}

TEST_CASE("compare: exit code 0 when equal, 1 when not, 3 for what is no picture", "[cli]") {
  const TemporaryFolder folder;
  const std::string a = quoted(folder.path() / "a");
  const std::string b = quoted(folder.path() / "b");
  REQUIRE(run_fanbeam("render flat-grass -q --products bscope,cscope,power -o " + a).exit_code ==
          0);
  fs::copy(folder.path() / "a", folder.path() / "b", fs::copy_options::recursive);
  CHECK(run_fanbeam("compare --exact " + a + " " + b).exit_code == 0);
  CHECK(run_fanbeam("compare " + a + "/bscope/00000.png " + b + "/bscope/00000.png").exit_code ==
        0);

  const Result different =
      run_fanbeam("compare " + a + "/bscope/00000.png " + a + "/cscope/00000.png");
  CHECK(different.exit_code == 1);
  CHECK(different.output.rfind("DIFFER", 0) == 0);
  CHECK(run_fanbeam("compare --rms 255 " + a + "/bscope/00000.png " + a + "/cscope/00000.png")
            .exit_code == 0);

  fs::create_directories(folder.path() / "c/bscope");
  fs::copy(folder.path() / "a/cscope/00000.png", folder.path() / "c/bscope/00000.png");
  const std::string c = quoted(folder.path() / "c");
  fs::create_directories(folder.path() / "d/bscope");
  fs::copy(folder.path() / "a/bscope/00000.png", folder.path() / "d/bscope/00000.png");
  const std::string pair = quoted(folder.path() / "d") + " " + c;
  // A limit that is not given does not bind.
  for (const char* wide : {"--rms 255", "--largest 255", "--percent 100"})
    CHECK(run_fanbeam("compare " + std::string(wide) + " " + pair).exit_code == 0);
  const std::pair<const char*, const char*> tight[] = {
      {"", "cells differ: RMS above 0\n"},
      {"--largest 1", "cells differ: largest above 1\n"},
      {"--percent 0.5", "cells differ: per cent above 0.5\n"},
      {"--rms 0.5 --largest 255", "cells differ: RMS above 0.5\n"},
      {"--rms 0.5 --largest 1", "cells differ: RMS above 0.5, largest above 1\n"},
      {"--exact", "cells differ: not equal\n"}};
  for (const auto& [limits, broken] : tight) {
    const Result told = run_fanbeam("compare " + std::string(limits) + " " + pair);
    INFO(told.output);
    CHECK(told.exit_code == 1);
    CHECK(told.output.find("DIFFER bscope/00000.png ") != std::string::npos);
    CHECK(told.output.find(broken) != std::string::npos);
  }
  fs::rename(folder.path() / "c/bscope", folder.path() / "c/cscope");
  const Result apart = run_fanbeam("compare " + pair);
  CHECK(apart.exit_code == 4);
  CHECK(apart.output.find("no name in both") != std::string::npos);

  fs::remove(folder.path() / "b/cscope/00000.png");
  const Result missing = run_fanbeam("compare " + a + " " + b);
  CHECK(missing.exit_code == 1);
  CHECK(missing.output.find("DIFFER cscope/00000.png: only in") != std::string::npos);

  const Result no_picture = run_fanbeam("compare " + a + "/run.json " + a + "/run.json");
  CHECK(no_picture.exit_code == 3);
  CHECK(run_fanbeam("compare " + a + " " + a + "/run.json").exit_code == 3);
  CHECK(run_fanbeam("compare " + a + "/bscope/00000.png " + a + "/power/00000.exr").exit_code == 3);
}
