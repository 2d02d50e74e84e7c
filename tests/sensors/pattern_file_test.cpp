// Antenna patterns from files, well-formed and hostile, and the keys that ask for them.
#include "sensors/antenna/pattern_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/sensors/shipped_sensor.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::radians;

namespace {

namespace fs = std::filesystem;

std::string rows(const std::string& keyword, const std::function<double(int)>& attenuation_dB) {
  std::string text = keyword + " 360\n";
  for (int i = 0; i < 360; ++i)
    text += std::to_string(i) + " " + std::to_string(attenuation_dB(i)) + "\n";
  return text;
}

// Gaussian of 10 deg, 5 deg right of the axis and 20 deg below it, 40 dB down elsewhere.
double falling(int angle_deg, double peak_deg) {
  const double off = std::remainder(angle_deg - peak_deg, 360.0) / 10.0;
  return std::min(40.0, 12.0 * off * off);
}

std::string msi(const std::string& gain = "GAIN 20 dBi\n") {
  return "NAME test\nFREQUENCY 35000\n" + gain + "TILT ELECTRICAL\n" +
         rows("HORIZONTAL", [](int i) { return falling(i, 5.0); }) +
         rows("VERTICAL", [](int i) { return falling(i, 20.0); });
}

double gain_at(const PatternCut& cut, double angle_deg) {
  BeamCut beam;
  beam.shape = BeamCut::Shape::table;
  beam.half_power_width_rad = 0.1;
  beam.cut_rad = radians(180.0);
  beam.table_angle_rad = cut.angle_rad;
  beam.table_gain = cut.gain;
  return one_way_gain(beam, radians(angle_deg));
}

std::vector<core::Problem> problems_of(const fs::path& file, PatternPlane plane) {
  core::ProblemList problems;
  read_pattern_cut(file, plane, problems);
  return problems.all();
}

std::string sensor_text(const std::string& elevation) {
  const std::string text =
      tests::hivision_text("shape = \"gaussian\"\nhalf_power_width_deg = 10.0", elevation + "\n#");
  return tests::replaced_once(text, "cut_deg = 15.625", "# 15.625");
}

}  // namespace

TEST_CASE("an MSI file's angles run to the right and downwards", "[pattern_file]") {
  const tests::TemporaryFolder folder;
  const fs::path file = folder.write("a.msi", msi());
  core::ProblemList problems;
  const PatternCut across = read_pattern_cut(file, PatternPlane::azimuth, problems);
  const PatternCut down = read_pattern_cut(file, PatternPlane::elevation, problems);
  REQUIRE(problems.all().empty());
  CHECK(gain_at(across, 5.0) == Approx(1.0));
  CHECK(gain_at(across, 10.0) == Approx(std::pow(10.0, -0.3)));
  CHECK(gain_at(across, -5.0) == Approx(std::pow(10.0, -1.2)));
  CHECK(gain_at(down, -20.0) == Approx(1.0));
  CHECK(gain_at(down, -25.0) == Approx(std::pow(10.0, -0.3)));
  CHECK(gain_at(down, 20.0) == Approx(1e-4));
  CHECK(gain_at(down, 180.0) == Approx(1e-4));
  CHECK(gain_at(down, -180.0) == Approx(1e-4));
  CHECK(across.angle_rad.size() == 361);
  CHECK(*across.peak_gain == Approx(100.0));
}

TEST_CASE("MSI gain is over a dipole unless it says dBi", "[pattern_file]") {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  for (const char* line : {"GAIN 17.85\n", "GAIN 17.85 dBd\n", "gain 17.85dBd \n"}) {
    const PatternCut cut =
        read_pattern_cut(folder.write("a.pln", msi(line)), PatternPlane::azimuth, problems);
    if (problems.has_errors()) {
      CHECK(std::string(line) == "gain 17.85dBd \n");  // amount and unit must stand apart
      continue;
    }
    CHECK(*cut.peak_gain == Approx(100.0));
  }
  CHECK_FALSE(
      read_pattern_cut(folder.write("b.msi", msi("")), PatternPlane::azimuth, problems).peak_gain);
}

TEST_CASE("hostile pattern files are refused with class, file and line", "[pattern_file]") {
  const tests::TemporaryFolder folder;
  std::string many = "angle_deg,gain_dB\n", huge = many;
  for (int i = 0; i < 40000; ++i) many += std::to_string(-180.0 + i * 0.005) + ",0\n";
  for (int i = 0; i < 1000000; ++i) huge += "0.0,0\n";
  const std::string header = "angle_deg,gain_dB\n";
  struct Bad {
    const char* name;
    std::string text;
    const char* code;
    int line;
  };
  const Bad cases[] = {
      {"a.csv", "", "E-PARSE", 0},
      {"a.csv", "0,0\n1,-3\n", "E-PARSE", 1},
      {"a.csv", header + "0,0\n", "E-PARSE", 2},
      {"a.csv", header + "0,0\n1,x\n", "E-PARSE", 3},
      {"a.csv", header + "0,0\n\n# note\n1,nan\n", "E-NONFINITE", 5},
      {"a.csv", header + "0,0\n1,-inf\n", "E-NONFINITE", 3},
      {"a.csv", header + "0,0\n1,3\n", "E-RANGE", 3},
      {"a.csv", header + "0,0\n0,-3\n", "E-RANGE", 3},
      {"a.csv", header + "5,0\n1,-3\n", "E-RANGE", 3},
      {"a.csv", header + "5,-9\n6,-3\n", "E-RANGE", 3},
      {"a.csv", header + "0,0\n1e300,-3\n", "E-RANGE", 3},
      {"a.csv", many, "E-LIMIT", 36003},
      {"a.csv", huge, "E-LIMIT", 0},
      {"a.txt", header, "E-UNSUPPORTED", 0},
      {"a.msi", "NAME x\n", "E-PARSE", 1},
      {"a.msi", "HORIZONTAL 360\n0 0\n1 0.1\n", "E-PARSE", 3},
      {"a.msi", "HORIZONTAL many\n", "E-PARSE", 1},
      {"a.msi", "HORIZONTAL 1e9\n", "E-RANGE", 1},
      {"a.msi", "HORIZONTAL 2\n0 0\n0 1\n", "E-RANGE", 3},
      {"a.msi", "HORIZONTAL 2\n0 0\n360 1\n", "E-RANGE", 3},
      {"a.msi", "HORIZONTAL 2\n0 0\n1 -1\n", "E-RANGE", 3},
      {"a.msi", "HORIZONTAL 2\n0 0\n1 1\nHORIZONTAL 2\n0 0\n1 1\n", "E-PARSE", 4},
      {"a.msi", "HORIZONTAL 2\n0 0\n1 1\n2 2\nVERTICAL 2\n0 0\n1 1\n", "E-PARSE", 4},
      {"a.msi", "GAIN 3 dBi\nGAIN 4 dBi\nHORIZONTAL 2\n0 0\n1 1\n", "E-PARSE", 2},
      {"a.msi", "GAIN nan\nHORIZONTAL 2\n0 0\n1 1\n", "E-NONFINITE", 1},
      {"a.msi", "GAIN 3 dBx\nHORIZONTAL 2\n0 0\n1 1\n", "E-PARSE", 1},
  };
  for (const Bad& bad : cases) {
    const fs::path file = folder.write(bad.name, bad.text);
    const auto problems = problems_of(file, PatternPlane::azimuth);
    INFO(bad.text.substr(0, 60));
    REQUIRE(problems.size() == 1);
    INFO(core::to_string(problems[0]));
    CHECK(problems[0].code == bad.code);
    CHECK(problems[0].place.file == file.string());
    CHECK(problems[0].place.line == bad.line);
  }
  CHECK(problems_of("no/such.msi", PatternPlane::azimuth).at(0).code == "E-IO");
}

TEST_CASE("all bad rows of a pattern file are told at once, up to the list's end",
          "[pattern_file]") {
  const tests::TemporaryFolder folder;
  const auto lines_of = [&](const char* name, const std::string& text) {
    std::vector<int> lines;
    for (const core::Problem& problem :
         problems_of(folder.write(name, text), PatternPlane::azimuth))
      lines.push_back(problem.place.line);
    return lines;
  };
  CHECK(lines_of("a.csv", "angle_deg,gain_dB\n0,0\n1,x\n2,3\n3,-1\n2,-1\n4,nan\n5,-1\n") ==
        std::vector<int>{3, 4, 6, 7});
  CHECK(lines_of("a.msi", "HORIZONTAL 4\n0 0\n1 -1\n2 x\n3 1\nVERTICAL 2\n0 0\n400 1\n") ==
        std::vector<int>{3, 4, 8});
  // What stands where a row should does not make all that follows one.
  CHECK(lines_of("a.msi", "HORIZONTAL 3\n0 0\n1 1\nVERTICAL 2\n0 0\n1 1\n").size() <= 2);
  std::string many = "angle_deg,gain_dB\n";
  for (int i = 0; i < 1000; ++i) many += "x,0\n";
  CHECK(lines_of("a.csv", many).size() == core::ProblemList::kMost);
}

TEST_CASE("a sensor file takes a cut, and the gain only when it says so, from a file beside it",
          "[pattern_file]") {
  const tests::TemporaryFolder folder;
  folder.write("beam.msi", msi());
  const std::string from_file =
      sensor_text("shape = \"file\"\nfile = \"beam.msi\"\ncut_deg = 60.0");
  const auto read = [&](const std::string& text) {
    core::ProblemList problems;
    const Sensor sensor = read_sensor(folder.write("sensor.toml", text), problems);
    for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
    return std::pair(sensor, problems.all());
  };
  // HiVision's efficiency and list of assumptions are about its own beam.
  const auto relaxed = [](std::string text) {
    const auto drop = [&text](const std::string& what) {
      const std::size_t at = text.find(what);
      REQUIRE(at != std::string::npos);
      text.erase(at, text.find('\n', at) - at);
    };
    drop("efficiency = 0.714");
    drop("  \"antenna.efficiency\"");
    drop("  \"antenna.elevation.half_power_width_deg\"");
    return text;
  };
  std::string text = relaxed(from_file);
  text = tests::replaced_once(text, "peak_gain = 3250.0", "peak_gain = 1000.0");
  const auto [stated, problems] = read(text);
  CHECK(problems.empty());
  CHECK(stated.antenna.peak_gain == 1000.0);
  CHECK(core::degrees(stated.antenna.elevation.cut_rad) == Approx(60.0));
  CHECK(core::degrees(stated.antenna.elevation.half_power_width_rad) ==
        Approx(10.0).epsilon(0.0).margin(0.1));
  text = tests::replaced_once(text, "peak_gain = 1000.0", "peak_gain_from_file = true");
  const auto [taken, more] = read(text);
  CHECK(more.empty());
  CHECK(taken.antenna.peak_gain == Approx(100.0));

  for (const char* outside : {"../beam.msi", "/etc/beam.msi", "http://x/beam.msi"}) {
    const auto [sensor, refused] = read(tests::replaced_once(text, "beam.msi", outside));
    REQUIRE_FALSE(refused.empty());
    CHECK(refused[0].code == "E-PATH");
    CHECK(refused[0].place.line > 0);
  }
}
