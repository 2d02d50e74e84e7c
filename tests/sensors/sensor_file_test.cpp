#include "sensors/sensor_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;

namespace {

std::vector<core::Problem> problems_of(const std::string& text) {
  core::ProblemList problems;
  read_sensor_text(text, "test.toml", problems);
  return problems.all();
}

// One problem, of this class, at this field, with line and an expectation.
void check_single(const std::vector<core::Problem>& problems, const std::string& code,
                  const std::string& field) {
  for (const core::Problem& problem : problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].code == code);
  CHECK(problems[0].field == field);
  CHECK(problems[0].place.line > 0);
  CHECK_FALSE(problems[0].expected.empty());
}

struct Bad {
  const char* from;
  const char* to;
  const char* code;
  const char* field;
};

void check_each(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    INFO(bad.from << " -> " << bad.to);
    check_single(problems_of(tests::hivision_text(bad.from, bad.to)), bad.code, bad.field);
  }
}

}  // namespace

TEST_CASE("S10 sensor settings that make no sense are refused at load", "[sensor_file]") {
  check_each({
      {"cell_m = 6.67", "cell_m = 0", "E-RANGE", "range.cell_m"},
      {"cell_m = 6.67", "cell_m = -6.67", "E-RANGE", "range.cell_m"},
      {"cell_m = 6.67", "cell_m = 1e-300", "E-RANGE", "range.cell_m"},
      {"cell_m = 6.67", "cell_m = nan", "E-NONFINITE", "range.cell_m"},
      {"cells = 524", "maximum_m = 150.0", "E-RANGE", "range.maximum_m"},
      {"half_power_width_deg = 0.8", "half_power_width_deg = 0", "E-RANGE",
       "antenna.azimuth.half_power_width_deg"},
      {"half_power_width_deg = 10.0", "half_power_width_deg = 400", "E-RANGE",
       "antenna.elevation.half_power_width_deg"},
      {"frequency_GHz = 35.0", "frequency_GHz = 0", "E-RANGE", "waveform.frequency_GHz"},
      {"frame_rate_Hz = 16.0", "frame_rate_Hz = 0", "E-RANGE", "scan.frame_rate_Hz"},
      {"frame_rate_Hz = 16.0", "frame_rate_Hz = 1e-300", "E-RANGE", "scan.frame_rate_Hz"},
      {"frame_rate_Hz = 16.0", "frame_rate_Hz = 1e9", "E-RANGE", "scan.frame_rate_Hz"},
      {"frame_rate_Hz = 16.0", "frame_rate_Hz = inf", "E-NONFINITE", "scan.frame_rate_Hz"},
      // c / 2B = 3747 m in a window of 3495 m.
      {"bandwidth_MHz = 22.473", "bandwidth_MHz = 0.04", "E-RANGE", "waveform.bandwidth_MHz"},
      // A margin of more columns than an int holds, memory without end, power that is no number.
      {"field_of_view_deg = 41.0", "field_of_view_deg = 1e-9", "E-RANGE", "scan.field_of_view_deg"},
      {"field_of_view_deg = 41.0\ncolumns = 164", "field_of_view_deg = 0.01\ncolumns = 4096",
       "E-LIMIT", "scan.columns"},
      {"span_deg = 10.0", "span_deg = 1e-6", "E-RANGE", "display.cscope.span_deg"},
      {"looks = 1", "looks = 1\ndwell_us = 1e-320", "E-RANGE", "receiver.dwell_us"},
      {"transmit_power_W = 1.0", "transmit_power_W = 1e-320", "E-RANGE",
       "waveform.transmit_power_W"},
      {"peak_gain = 3250.0", "peak_gain = 1e-300", "E-RANGE", "antenna.peak_gain"},
      {"high_dB = 5.0", "high_dB = -55.0", "E-RANGE", "display.high_dB"},
      {"peak_gain = 3250.0", "peak_gain = 5000.0", "E-RANGE", "antenna.peak_gain"},
      {"efficiency = 0.714", "efficiency = 0.8", "E-RANGE", "antenna.efficiency"},
  });
}

TEST_CASE("R06 a last cell that ends on maximum_m fits, whatever the decimals round to",
          "[sensor_file]") {
  const auto cells = [](double minimum_m, double cell_m, double maximum_m) {
    std::string text = tests::hivision_text("bandwidth_MHz = 22.473", "bandwidth_MHz = 2000.0");
    text = tests::replaced_once(text, "minimum_m = 200.0",
                                "minimum_m = " + core::number_text(minimum_m));
    text = tests::replaced_once(text, "cell_m = 6.67", "cell_m = " + core::number_text(cell_m));
    text = tests::replaced_once(text, "cells = 524", "maximum_m = " + core::number_text(maximum_m));
    core::ProblemList problems;
    const Sensor sensor = read_sensor_text(text, "test.toml", problems);
    for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
    CHECK(problems.all().empty());
    return sensor.range.cells;
  };
  CHECK(cells(200.0, 0.1, 361.4) == 1614);  // a floor of the quotient: 1613
  CHECK(cells(0.0, 0.1, 62.3) == 623);
  CHECK(cells(200.0, 0.3, 265.7) == 219);
  CHECK(cells(200.0, 0.1, 361.399999) == 1613);  // one that does not fit
  CHECK(cells(200.0, 6.67, 3700.0) == 524);
}

TEST_CASE("received power has no window of its own: both ends are asked for", "[sensor_file]") {
  const auto problems = problems_of(
      tests::hivision_text("mapping = \"stc\"\nlow_dB = -55.0", "mapping = \"log\"\n# -55.0"));
  check_single(problems, "E-REF", "display.low_dB");
  std::string seed = tests::hivision_text("mapping = \"stc\"", "mapping = \"seed\"");
  const auto unused = problems_of(seed);  // it has one of its own
  REQUIRE(unused.size() == 2);
  for (const core::Problem& one : unused) CHECK(one.code == "W-UNUSED");
  seed = tests::replaced_once(seed, "low_dB = -55.0", "#");
  seed = tests::replaced_once(seed, "high_dB = 5.0", "#");
  CHECK(problems_of(seed).empty());
  seed = tests::replaced_once(seed, "minimum_m = 200.0", "minimum_m = 0.0");
  check_single(problems_of(seed), "E-RANGE", "display.mapping");
}

TEST_CASE("R17 absurd sizes are refused before anything is allocated", "[sensor_file]") {
  const auto begin = std::chrono::steady_clock::now();
  check_each({
      {"cells = 524", "cells = 0", "E-RANGE", "range.cells"},
      {"columns = 164 ", "columns = -1 ", "E-RANGE", "scan.columns"},
      {"columns = 164 ", "columns = 4294967297 ", "E-RANGE", "scan.columns"},
      {"cells = 524", "maximum_m = 1e9", "E-LIMIT", "range.maximum_m"},
      {"rows = 524", "rows = 100000", "E-RANGE", "display.cscope.rows"},
  });
  std::string text = tests::hivision_text("cells = 524", "cells = 100000");
  text.replace(text.find("columns = 164"), 13, "columns = 100000");
  CHECK(problems_of(text).size() == 2);  // 1e5 x 1e5: both sides, E-RANGE

  // Each side allowed, the product not.
  text = tests::hivision_text("cells = 524", "cells = 16384");
  text.replace(text.find("columns = 164"), 13, "columns = 4096");
  check_single(problems_of(text), "E-LIMIT", "range.cells");
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CHECK(elapsed_s < 0.1 * 7);
}

TEST_CASE("all problems of a sensor file are reported together, unknown keys with a suggestion",
          "[sensor_file]") {
  std::string text = tests::hivision_text("cell_m = 6.67", "cell_m = 0\ncolums = 3");
  text.replace(text.find("loss_dB = 0.0"), 13, "lossdB = 0.0");
  const auto problems = problems_of(text);
  const auto about = [&](const std::string& field) {
    return std::any_of(problems.begin(), problems.end(),
                       [&](const core::Problem& problem) { return problem.field == field; });
  };
  CHECK(about("range.cell_m"));
  CHECK(about("range.colums"));
  CHECK(about("receiver.lossdB"));
}

TEST_CASE("an assumption about a value that the file does not have is refused", "[sensor_file]") {
  check_single(problems_of(tests::hivision_text("\"scan.surface\"", "\"scan.surfaces\"")), "E-REF",
               "assumed");
  const Sensor sensor = tests::hivision();
  CHECK(std::count(sensor.assumed.begin(), sensor.assumed.end(), "antenna.elevation.cut_deg") == 1);
}

TEST_CASE("a missing file and a missing value name themselves", "[sensor_file]") {
  core::ProblemList problems;
  read_sensor("no/such/sensor.toml", problems);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-IO");
  check_single(problems_of(tests::hivision_text("frequency_GHz = 35.0", "")), "E-REF",
               "waveform.frequency_GHz");
}

TEST_CASE("errors that were there before do not hide those of a sensor file", "[sensor_file]") {
  core::ProblemList problems;
  problems.error(core::ErrorClass::range, {}, "elsewhere", "1", "2");
  read_sensor_text(tests::hivision_text("peak_gain = 3250.0", "peak_gain = 5000.0"), "test.toml",
                   problems);
  CHECK(problems.all().size() == 2);
}

TEST_CASE("range cells finer than the bandwidth resolves are a warning", "[sensor_file]") {
  check_single(problems_of(tests::hivision_text("bandwidth_MHz = 22.473", "bandwidth_MHz = 2.0")),
               "W-RESOLUTION", "waveform.bandwidth_MHz");
}

TEST_CASE("a radar that leaves own-ship Doppler in its ranges can be described", "[sensor_file]") {
  core::ProblemList problems;
  const Sensor sensor = read_sensor_text(
      tests::hivision_text("doppler_compensated = true", "doppler_compensated = false"), "t",
      problems);
  CHECK(problems.all().empty());
  CHECK_FALSE(sensor.waveform.doppler_compensated);
  CHECK(sensor.waveform.doppler_place.file == "t");
  CHECK(sensor.waveform.doppler_place.line > 1);
  CHECK(tests::hivision().waveform.doppler_compensated);
}

TEST_CASE("columns wider than the beam are a warning", "[sensor_file]") {
  check_single(problems_of(tests::hivision_text("columns = 164", "columns = 41")), "W-COLUMNS",
               "scan.columns");
  CHECK(problems_of(tests::hivision_text("columns = 164", "columns = 82")).empty());
  const auto found = [](const std::string& field_deg, const std::string& columns) {
    return problems_of(
        tests::replaced_once(tests::hivision_text("columns = 164", "columns = " + columns),
                             "field_of_view_deg = 41.0", "field_of_view_deg = " + field_deg));
  };
  // As wide as the beam of 0.8 deg, but for the last digit of a number in radians.
  for (const auto& [field_deg, columns] :
       {std::pair<const char*, const char*>{"17.6", "22"}, {"35.2", "44"}, {"70.4", "88"}}) {
    INFO(field_deg << " deg in " << columns << " columns");
    for (const core::Problem& problem : found(field_deg, columns))
      CHECK(problem.code != "W-COLUMNS");
  }
  const auto wider = found("60.0", "2");
  const auto told = std::find_if(wider.begin(), wider.end(), [](const core::Problem& problem) {
    return problem.code == "W-COLUMNS";
  });
  REQUIRE(told != wider.end());
  CHECK(told->expected.starts_with("kept: of 30 deg, wider than the beam of 0.8 deg, "));
}

TEST_CASE("a stated dwell must fit its column and sets the noise", "[sensor_file]") {
  core::ProblemList problems;
  const Sensor sensor = read_sensor_text(
      tests::hivision_text("loss_dB = 0.0", "loss_dB = 0.0\ndwell_us = 100.0"), "t", problems);
  CHECK(problems.all().empty());
  CHECK(sensor.noise_power_W() == Approx(4.18258e-17 * 381.0976 / 100.0).epsilon(1e-5));
  check_single(
      problems_of(tests::hivision_text("loss_dB = 0.0", "loss_dB = 0.0\ndwell_us = 400.0")),
      "E-RANGE", "receiver.dwell_us");
}

TEST_CASE("a beam may be given as a table of angles and decibels", "[sensor_file]") {
  const std::string from = "half_power_width_deg = 0.8\ncut_deg = 1.25";
  const auto with = [&](const std::string& angles, const std::string& gains) {
    std::string text =
        tests::hivision_text(from, "table_angle_deg = " + angles + "\ntable_gain_dB = " + gains);
    const std::string shape = "[antenna.azimuth]\nshape = \"gaussian\"";
    text.replace(text.find(shape), shape.size(), "[antenna.azimuth]\nshape = \"table\"");
    for (const std::string name :
         {"  \"antenna.azimuth.cut_deg\",\n", "  \"antenna.efficiency\",\n"})
      text.erase(text.find(name), name.size());
    return text.erase(text.find("efficiency = 0.714"), 18);
  };
  core::ProblemList problems;
  // Power is linear between the rows: from 1 to 0.1 over 1 deg, one half is at 0.5556 deg.
  const Sensor sensor =
      read_sensor_text(with("[-1, 0, 1]", "[-10, 0, -10]"), "test.toml", problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  CHECK(problems.all().empty());
  CHECK(core::degrees(sensor.antenna.azimuth.half_power_width_rad) == Approx(2 * 0.5 / 0.9));
  CHECK(core::degrees(sensor.antenna.azimuth.cut_rad) == Approx(1.0));
  CHECK(core::degrees(two_way_width(sensor.antenna.azimuth)) == Approx(2.0 / 3.0 * 1.11));

  check_single(problems_of(with("[-1, 1, 0]", "[-10, 0, -10]")), "E-RANGE",
               "antenna.azimuth.table_angle_deg");
  check_single(problems_of(with("[-1, 0, 1]", "[-10, 0]")), "E-RANGE",
               "antenna.azimuth.table_gain_dB");
  check_single(problems_of(with("[-1, 0, 1]", "[-10, -3, -10]")), "E-RANGE",
               "antenna.azimuth.table_gain_dB");
}

TEST_CASE("gain may be given in decibels, but not twice", "[sensor_file]") {
  core::ProblemList problems;
  const Sensor sensor = read_sensor_text(
      tests::hivision_text("peak_gain = 3250.0", "peak_gain_dB = 35.0"), "t", problems);
  CHECK(problems.all().empty() == false);  // 35 dB is 0.695 of the directivity, not 0.714
  CHECK(sensor.antenna.peak_gain == Approx(std::pow(10.0, 3.5)));
  check_single(problems_of(tests::hivision_text("peak_gain = 3250.0",
                                                "peak_gain = 3250.0\npeak_gain_dB = 35.12")),
               "E-RANGE", "antenna.peak_gain");
}
