// fanbeam doctor tells pictures that show nothing, and what to change.
#include <regex>
#include <vector>

#include "tests/apps/plain_scene.h"
#include "tests/apps/program.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

std::string display(const std::string& mapping, double low_dB, double high_dB) {
  return "[display]\nmapping = \"" + mapping + "\"\nlow_dB = " + std::to_string(low_dB) +
         "\nhigh_dB = " + std::to_string(high_dB) + "\n";
}

struct Told {
  int exit_code = -1;
  std::vector<nlohmann::json> blank;  // the findings about pictures
};

Told told_of(const std::string& scene, const TemporaryFolder& folder) {
  const fs::path file = folder.path() / "findings.json";
  const Result result = run_fanbeam("doctor " + scene + " --json " + quoted(file));
  INFO(result.output);
  REQUIRE(fs::exists(file));
  Told told{result.exit_code, {}};
  const nlohmann::json all = json_of(file);
  for (const nlohmann::json& finding : all["findings"])
    if (finding["check"] == "blank-picture") told.blank.push_back(finding);
  fs::remove(file);
  return told;
}

Told told(const TemporaryFolder& folder, const std::string& text) {
  folder.write("scene.toml", text);
  return told_of(quoted(folder.path()), folder);
}

bool says(const nlohmann::json& finding, const std::string& key, const std::string& words) {
  const std::string text = finding[key];
  INFO(key << ": " << text);
  return text.find(words) != std::string::npos;
}

// The window that a finding advises.
std::string advised(const nlohmann::json& finding, const std::string& mapping) {
  const std::string remedy = finding["do"];
  INFO(remedy);
  std::smatch match;
  REQUIRE(
      std::regex_search(remedy, match, std::regex("low_dB = (-?[0-9]+) and high_dB = (-?[0-9]+)")));
  return display(mapping, std::stod(match[1]), std::stod(match[2]));
}

}  // namespace

TEST_CASE("doctor tells black and white pictures, and the window it advises shows something",
          "[doctor]") {
  const TemporaryFolder folder;
  struct Case {
    std::string mapping;
    double low_dB, high_dB;
    std::string colour;
  };
  for (const Case& c : {Case{"stc", 40.0, 90.0, "black"}, Case{"stc", -250.0, -150.0, "white"},
                        Case{"log", -60.0, 0.0, "black"}, Case{"log", -300.0, -200.0, "white"}}) {
    INFO(c.mapping << ' ' << c.colour);
    const Told blank = told(folder, kPlain + display(c.mapping, c.low_dB, c.high_dB) + kOverGrass);
    CHECK(blank.exit_code == 1);
    REQUIRE(blank.blank.size() == 2);
    CHECK(says(blank.blank[0], "what", "the B-scope is " + c.colour));
    CHECK(says(blank.blank[1], "what", "the C-scope is " + c.colour));
    for (const nlohmann::json& finding : blank.blank) {
      CHECK(finding["severity"] == "wrong");
      CHECK(says(finding, "where", "frame 0"));
      CHECK(finding["figure"].get<double>() >= 99.99);  // per cent of the pixels
      const Told better = told(folder, kPlain + advised(finding, c.mapping) + kOverGrass);
      CHECK(better.exit_code == 0);
      CHECK(better.blank.empty());
    }
  }
}

TEST_CASE("doctor tells a picture of one grey between black and white", "[doctor]") {
  const TemporaryFolder folder;
  // Noise at -164 dBW and grass up to 60 dB above it, on 800 dB: 3 dB a grey.
  const Told grey = told(folder, kPlain + display("log", -400.0, 400.0) + kOverGrass);
  REQUIRE(grey.blank.size() == 2);
  CHECK(says(grey.blank[0], "what", "the B-scope is one grey"));
}

TEST_CASE("doctor tells a picture that holds noise alone: nothing in view, or all of it too weak",
          "[doctor]") {
  const TemporaryFolder folder;
  const std::string away = R"([trajectory.fixed]
at = { latitude_deg = 52.026, longitude_deg = 10.0 }
above_ground_m = 60.0
)";
  const Told empty = told(folder, kPlain + away);
  CHECK(empty.exit_code == 1);
  REQUIRE(empty.blank.size() == 2);
  CHECK(says(empty.blank[0], "what", "the B-scope shows nothing but noise"));
  CHECK(says(empty.blank[0], "why", "Nothing lies in the field of view"));

  std::string sensor = narrow_sensor(164);
  const std::string power = "transmit_power_W = 1.0";
  REQUIRE(sensor.find(power) != std::string::npos);
  sensor.replace(sensor.find(power), power.size(), "transmit_power_W = 1e-9");
  folder.write("weak.toml", sensor);
  const Told weak = told(folder, kPlain + "[sensor]\nfile = \"weak.toml\"\n" + kOverGrass);
  CHECK(weak.exit_code == 1);
  REQUIRE_FALSE(weak.blank.empty());
  CHECK(says(weak.blank[0], "why", "the echoes drown"));
  CHECK(says(weak.blank[0], "do", "No window can show them"));
}

TEST_CASE("doctor finds something to see in both pictures of the shipped scenes", "[doctor]") {
  const TemporaryFolder folder;
  for (const char* scene : {"braunschweig-26", "flat-grass", "highway-76ghz", "obstacle-field",
                            "rain-94ghz", "street-76ghz"}) {
    INFO(scene);
    CHECK(told_of(scene, folder).blank.empty());
  }
}

TEST_CASE("doctor looks at the C-scope as a fan beam draws it, too", "[doctor]") {
  const TemporaryFolder folder;
  const std::string flat = "cscope_mode = \"flat_earth\"\n";
  CHECK(told(folder, kPlain + display("stc", -55.0, 5.0) + flat + kOverGrass).blank.empty());
  const Told blank = told(folder, kPlain + display("stc", 60.0, 120.0) + flat + kOverGrass);
  REQUIRE(blank.blank.size() == 2);
  CHECK(says(blank.blank[1], "what", "the C-scope is black"));
}
