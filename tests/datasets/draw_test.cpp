// Drawn values: distributions in closed form, plans as pure functions of file and run.
#include "datasets/draw.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "core/config_table.h"
#include "core/errors.h"
#include "datasets/campaign.h"
#include "datasets/record_seal.h"
#include "datasets/run_flight.h"
#include "datasets/sha256.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using datasets::Campaign;
using datasets::Distribution;

namespace {

double number(const datasets::Value& value) { return std::get<double>(value); }

Campaign campaign_of(const std::string& text) {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  Campaign campaign = datasets::read_campaign(folder.write("campaign.toml", text), problems);
  problems.throw_if_errors();
  return campaign;
}

constexpr const char* kThree = R"(
[parameters]
surface = { values = ["dry", "wet"] }
weather.rain_rate_mm_per_h = { values = [0, 2, 10] }
weather.humidity = 0.5
)";

std::string head(const std::string& plan, int runs) {
  return "[campaign]\nname = \"x\"\nscenes = [\"flat-grass\"]\nplan = \"" + plan +
         "\"\nruns = " + std::to_string(runs) + "\n";
}

}  // namespace

TEST_CASE("SHA-256 of the standard's examples", "[draw]") {
  // FIPS 180-4, examples of NIST: "abc" and the empty message.
  CHECK(datasets::sha256("abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(datasets::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("A sealed record tells of any byte that is not its own", "[draw]") {
  const std::string body = "{\n \"run\": 3,\n \"isa\": \"v3\"";
  const std::string record = datasets::sealed(body + "\n}");
  CHECK(record == body + ",\n \"record_sha256\": \"" + datasets::sha256(body) + "\"\n}\n");
  CHECK(datasets::is_intact(record));
  CHECK(datasets::is_intact(body + "\n}\n"));  // as earlier versions wrote them
  for (std::size_t i = 0; i < record.size(); ++i) {
    // But of the seal's own name, without which there is none.
    if (i > body.size() + 2 && i <= body.size() + 17) continue;
    std::string other = record;
    other[i] ^= 1;
    INFO(other);
    CHECK_FALSE(datasets::is_intact(other));
  }
  CHECK_FALSE(datasets::is_intact(record + " "));
  CHECK_FALSE(datasets::is_intact(record.substr(0, record.size() - 1)));
}

TEST_CASE("Distributions are the inverse of their law", "[draw]") {
  const Distribution uniform(Distribution::Uniform{100.0, 300.0, false});
  CHECK(number(uniform.at(0.25)) == 150.0);
  const Distribution decades(Distribution::Uniform{1.0, 100.0, true});
  CHECK(number(decades.at(0.5)) == Approx(10.0).epsilon(1e-14));
  CHECK(number(decades.at(1.0)) <= 100.0);
  // A normal law cut at one standard deviation: u = (Phi(x) - Phi(-1)) / (Phi(1) - Phi(-1)).
  // High in the tail as low in it: what is left above x is erfc(x / sqrt 2) / 2, beyond 20 nothing.
  const Distribution tail(Distribution::Normal{0.0, 1.0, 8.0, 20.0}),
      other_tail(Distribution::Normal{0.0, 1.0, -20.0, -8.0});
  for (const double u : {0.0625, 0.25, 0.5, 0.9375, 0.9990234375}) {
    INFO(u);
    const double x = number(tail.at(u));
    CHECK(std::erfc(x / std::sqrt(2.0)) / std::erfc(8.0 / std::sqrt(2.0)) ==
          Approx(1.0 - u).epsilon(1e-9));
    CHECK(number(other_tail.at(1.0 - u)) == Approx(-x).epsilon(1e-9));
  }
  const Distribution normal(Distribution::Normal{5.0, 2.0, 3.0, 7.0});
  CHECK(number(normal.at(0.5)) == Approx(5.0).epsilon(1e-12));
  for (const double x : {3.3, 4.0, 6.9}) {
    const auto phi = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
    const double u = (phi((x - 5.0) / 2.0) - phi(-1.0)) / (phi(1.0) - phi(-1.0));
    CHECK(number(normal.at(u)) == Approx(x).epsilon(1e-10));
  }
  CHECK(number(normal.at(0.0)) >= 3.0);
  CHECK(number(normal.at(1.0)) <= 7.0);
  const Distribution choice(Distribution::Choice{{1.0, 2.0, 3.0}, {0.5, 0.0, 0.5}});
  CHECK(number(choice.at(0.499)) == 1.0);
  CHECK(number(choice.at(0.5)) == 3.0);
  CHECK(number(choice.at(std::nextafter(1.0, 0.0))) == 3.0);
}

TEST_CASE("A grid goes through every combination, as often as it is told", "[draw]") {
  const Campaign campaign = campaign_of(head("grid", 2) + kThree);
  REQUIRE(campaign.runs == 12);
  datasets::Drawer drawer(campaign);
  std::multiset<std::pair<std::string, double>> seen;
  for (int run = 0; run < campaign.runs; ++run) {
    const datasets::Draw draw = drawer.draw(run);
    seen.insert({*draw.word("surface"), *draw.number("weather.rain_rate_mm_per_h")});
    CHECK(*draw.number("weather.humidity") == 0.5);
  }
  for (const char* surface : {"dry", "wet"})
    for (const double rain : {0.0, 2.0, 10.0}) CHECK(seen.count({surface, rain}) == 2);
}

TEST_CASE("Traffic that is in every run, or in none, doubles no grid", "[draw]") {
  for (const char* present : {"", "present = 1\n", "present = 0\n"}) {
    const Campaign campaign =
        campaign_of(head("grid", 1) + kThree + "[[traffic]]\nname = \"car\"\n" + present);
    CHECK(campaign.runs == 6);
    const bool there = std::string(present) != "present = 0\n";
    for (int run = 0; run < campaign.runs; ++run)
      CHECK(*datasets::Drawer(campaign).draw(run).number("traffic.car.present") == (there ? 1 : 0));
  }
}

TEST_CASE("What is more or less often than the rest is refused in a grid, by its line", "[draw]") {
  const std::string uneven =
      "[parameters]\n"
      "surface = { values = [\"dry\", \"wet\"], weights = [3, 1] }\n"
      "[[traffic]]\nname = \"car\"\n"
      "along_m = { values = [1, 2], weights = [1, 1] }\n"
      "present = 0.5\n";
  std::string told;
  try {
    campaign_of(head("grid", 1) + uneven);
  } catch (const core::InputError& error) {
    told = error.what();
  }
  for (const char* problem : {"campaign.toml:7:", "E-REF parameters.surface.weights",
                              "campaign.toml:10:", "E-REF traffic[0].along_m.weights",
                              "campaign.toml:11:", "E-RANGE traffic[0].present = 0.5"}) {
    INFO(told);
    CHECK(told.find(problem) != std::string::npos);
  }
  CHECK(campaign_of(head("sobol", 4) + uneven).runs == 4);
}

TEST_CASE("A run's values depend on the file and its number alone", "[draw]") {
  for (const char* plan : {"sobol", "random", "grid"}) {
    INFO(plan);
    const Campaign campaign = campaign_of(head(plan, 6) + kThree);
    datasets::Drawer rising(campaign);
    std::vector<datasets::Draw> draws;
    for (int run = 0; run < 6; ++run) draws.push_back(rising.draw(run));
    datasets::Drawer any(campaign);
    for (const int run : {5, 0, 3, 3, 1, 4, 2})
      CHECK((any.draw(run).values == draws[static_cast<std::size_t>(run)].values));
  }
}

// Where it stood alone in its group it was taken, and no run had it.
TEST_CASE("A misspelt parameter is refused, alone in its group too, with the right name",
          "[draw]") {
  const std::string group = head("sobol", 4) + "[parameters]\n",
                    traffic = head("sobol", 4) + "[[traffic]]\nname = \"car\"\n";
  const auto refused = [](const std::string& text, const std::string& key,
                          const std::string& name) {
    CHECK_THROWS_WITH(campaign_of(text), Catch::Contains("E-REF " + key + " = unknown key") &&
                                             Catch::Contains("\"" + name + "\""));
  };
  refused(group + "weather.visibility = { uniform = [100, 2000] }\n",
          "parameters.weather.visibility", "visibility_m");
  refused(group + "flight.lateral = 3\n", "parameters.flight.lateral", "lateral_m");
  refused(group + "flight.lateral = 3\nflight.vertical_m = 3\n", "parameters.flight.lateral",
          "lateral_m");
  refused(group + "sensor.tilt = 1\n", "parameters.sensor.tilt", "tilt_deg");
  refused(group + "surfaces = \"wet\"\n", "parameters.surfaces", "surface");
  refused(traffic + "along = 500\n", "traffic[0].along", "along_m");
  // A scene's key that no campaign has.
  CHECK_THROWS_WITH(campaign_of(group + "weather.rain_top_m = 500\n"),
                    Catch::Contains("E-REF parameters.weather.rain_top_m = unknown key"));
}

TEST_CASE("A scene is named once, and not as an airport is", "[draw]") {
  const auto told = [](const std::string& scenes, const std::string& rest,
                       datasets::ReadFor purpose) {
    const tests::TemporaryFolder folder;
    core::ProblemList problems;
    datasets::read_campaign(
        folder.write("campaign.toml", "[campaign]\nname = \"x\"\nscenes = " + scenes + "\n" + rest),
        problems, purpose);
    return problems.all().empty() ? "" : core::to_string(problems.all().front());
  };
  const std::string airport =
      "[[airport]]\nident = \"EDNY\"\nrunway = \"24\"\nname = \"a\"\nfile = \"r.csv\"\n"
      "elevation = \"e.hgt\"\n";
  using datasets::ReadFor;
  CHECK(told("[\"b\", \"c\"]", airport, ReadFor::making).empty());
  for (const std::string& scenes : {std::string("[\"b\", \"b\"]"), std::string("[\"b\", \"a\"]")}) {
    INFO(scenes);
    CHECK_THAT(told(scenes, airport, ReadFor::making),
               Catch::Contains("campaign.toml:3:") && Catch::Contains("E-REF campaign.scenes"));
    CHECK(told(scenes, airport, ReadFor::looking).empty());
  }
}

// Each of ten thousand runs failed by it, and told no line.
TEST_CASE("A scene or sensor that is not there is refused by its line beside all else", "[draw]") {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "small");
  folder.write("small/scene.toml", "");
  const std::filesystem::path file = folder.write(
      "campaign.toml",
      "[campaign]\nname = \"x\"\nscenes = [\"smal\", \"flat-gras\", \"small\", \"flat-grass\"]\n"
      "sensor = \"hivisoin\"\nruns = 0\n");
  core::ProblemList problems;
  datasets::read_campaign(file, problems, datasets::ReadFor::making, FANBEAM_SOURCE_DIR);
  std::string told;
  for (const core::Problem& problem : problems.all()) told += core::to_string(problem) + "\n";
  INFO(told);
  CHECK(problems.all().size() == 4);
  for (
      const char* part :
      {"campaign.toml:3:1: E-REF campaign.scenes = \"smal\" not found: expected a folder with "
       "scene.toml, or one of the scenes: small ",
       "campaign.toml:3:1: E-REF campaign.scenes = \"flat-gras\" not found: expected a folder with "
       "scene.toml, or one of the scenes: flat-grass ",
       "campaign.toml:4:1: E-REF campaign.sensor = \"hivisoin\" not found: expected a sensor file, "
       "or one of the shipped sensors: hivision ",
       "campaign.toml:5:1: E-RANGE campaign.runs = 0"})
    CHECK_THAT(told, Catch::Contains(part));
}

TEST_CASE("A name that is missing is one mistake", "[draw]") {
  const auto told = [](const std::string& text) {
    try {
      campaign_of(text);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string nameless =
      told("[campaign]\nscenes = [\"flat-grass\"]\n[[traffic]]\nalong_m = 3\n[[traffic]]\n");
  INFO(nameless);
  CHECK(std::count(nameless.begin(), nameless.end(), '\n') == 2);
  for (const char* field : {"campaign.name", "traffic[0].name", "traffic[1].name"})
    CHECK_THAT(nameless, Catch::Contains(std::string("E-REF ") + field + " = missing"));
  CHECK_THAT(told(head("sobol", 4) + "[[traffic]]\nname = \"\"\n"),
             Catch::Contains("E-RANGE traffic[0].name = \"\""));
}

TEST_CASE("A product is named once; of an earlier version's campaign it is one column", "[draw]") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder.write(
      "campaign.toml", head("random", 1) + "products = [\"bscope\", \"labels\", \"bscope\"]\n");
  core::ProblemList making, looking;
  datasets::read_campaign(file, making);
  REQUIRE(making.all().size() == 1);
  CHECK_THAT(
      core::to_string(making.all()[0]),
      Catch::Contains("campaign.toml:6:") &&
          Catch::Contains("E-REF campaign.products = \"bscope\": expected each product once"));
  const Campaign campaign = datasets::read_campaign(file, looking, datasets::ReadFor::looking);
  CHECK(looking.all().empty());
  CHECK(campaign.products == std::vector<std::string>{"bscope", "labels"});
}

TEST_CASE("A Sobol plan fills every dimension evenly, whatever the seed", "[draw]") {
  for (const int seed : {0, 1, 99}) {
    const Campaign campaign =
        campaign_of(head("sobol", 256) + "seed = " + std::to_string(seed) +
                    "\n[parameters]\nweather.humidity = { uniform = [0, 1] }\n"
                    "flight.lateral_m = { uniform = [0, 1] }\n");
    datasets::Drawer drawer(campaign);
    std::vector<int> squares(256, 0);
    for (int run = 0; run < 256; ++run) {
      const datasets::Draw draw = drawer.draw(run);
      const int x = static_cast<int>(16 * *draw.number("weather.humidity"));
      const int y = static_cast<int>(16 * *draw.number("flight.lateral_m"));
      ++squares[static_cast<std::size_t>(16 * y + x)];
    }
    // Of 256 random points a third of 256 squares is empty; of the shifted sequence few are.
    CHECK(std::count(squares.begin(), squares.end(), 0) < 64);
    CHECK(*std::max_element(squares.begin(), squares.end()) <= 4);
  }
}

TEST_CASE("Runs leave the flight as they are told, and wander as far as they are told", "[draw]") {
  core::Pose flown;
  flown.position = {0.9, 0.2, 500.0};
  flown.v_N_mps = {50.0, 0.0, 1.0};  // northwards
  datasets::Draw draw;
  draw.values = {{"flight.lateral_m", 100.0},
                 {"flight.vertical_m", -20.0},
                 {"flight.speed_factor", 2.0},
                 {"flight.heading_deg", 90.0}};
  flown.time_s = 10.0;
  const core::Pose pose = datasets::run_pose(draw, 1, flown, 0.0);
  // 100 m to the east on the parallel: a / sqrt(1 - e^2 sin^2) cos.
  const double sine = std::sin(0.9),
               radius_m = 6378137.0 / std::sqrt(1 - 6.69437999014e-3 * sine * sine);
  CHECK((pose.position.longitude_rad - 0.2) * radius_m * std::cos(0.9) ==
        Approx(100.0).epsilon(1e-6));
  CHECK(pose.position.height_m == 480.0);
  CHECK(pose.time_s == 5.0);
  // From where it begins, whatever the clock says there.
  flown.time_s = 1010.0;
  CHECK(datasets::run_pose(draw, 1, flown, 1000.0).time_s == 1005.0);
  CHECK(pose.v_N_mps.x == 100.0);
  CHECK(core::attitude_from(pose.q_NB).heading_rad == Approx(1.5707963267948966));

  // Pitched up, it turns about its own axes: a right angle of yaw makes all of its pitch a roll.
  flown.q_NB = core::quaternion_from({0.0, 0.1, 0.0});
  draw.values = {{"flight.heading_deg", 90.0}};
  const core::Attitude yawed = core::attitude_from(datasets::run_pose(draw, 1, flown, 0.0).q_NB);
  CHECK(yawed.roll_rad == Approx(0.1).epsilon(1e-9));
  CHECK(yawed.pitch_rad == Approx(0.0).epsilon(0.0).margin(1e-12));
  CHECK(yawed.heading_rad == Approx(1.5707963267948966));

  draw.values = {{"flight.turbulence_m", 3.0}};
  double square = 0.0;
  int count = 0;
  for (draw.run = 0; draw.run < 200; ++draw.run)
    for (int second = 0; second < 60; ++second, ++count) {
      flown.time_s = second;
      const double up_m = datasets::run_pose(draw, 1, flown, 0.0).position.height_m - 500.0;
      square += up_m * up_m;
    }
  CHECK(std::sqrt(square / count) == Approx(3.0).epsilon(0.05));
}

TEST_CASE("Frames of a run are spread over the part of the flight that is asked for", "[draw]") {
  using Frames = std::vector<int>;
  CHECK(datasets::frames_of({5, 0.0, 1.0}, 101) == Frames{0, 25, 50, 75, 100});
  CHECK(datasets::frames_of({1, 0.2, 0.4}, 101) == Frames{30});
  CHECK(datasets::frames_of({5, 0.0, 1.0}, 1) == Frames{0});
}
