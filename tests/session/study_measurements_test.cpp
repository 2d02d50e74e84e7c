// The study's bounds are those of the ramps that it measures with, its samples have the rate of the file.
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/decibel.h"
#include "session/signal/tracks/study.h"
#include "tracking/simulation/measurement_bound.h"

using namespace fanbeam;

namespace {

// A triangle of half a millisecond: the beat of a car at 100 m is 330 kHz.
core::HighwayRadar steep_radar(double rate_Hz) {
  core::HighwayRadar radar;
  radar.transmit_gain = core::power_from_dB(32.0);
  radar.receive_gain = core::power_from_dB(27.0);
  radar.noise_figure = core::power_from_dB(4.5);
  radar.waveforms.triangle_ramp_s = 0.5e-3;
  radar.waveforms.triangle_rate_Hz = rate_Hz;
  return radar;
}

// Cells of the row below a table's heading.
std::vector<std::string> first_row(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(lines, line);
  std::istringstream cells(line.substr(1));
  std::vector<std::string> row;
  for (std::string cell; std::getline(cells, cell, '|');) row.push_back(cell);
  return row;
}

}  // namespace

TEST_CASE("A study's samples have the rate that a file gives its triangle", "[track]") {
  const auto row = first_row(session::study_buffer(steep_radar(2e6), 1).text);
  // Of 100 draws, four standard deviations.
  CHECK(std::stod(row.at(1)) == Approx(std::stod(row.at(2))).epsilon(0.28));
  CHECK(std::stoi(row.at(6)) == 0);
}

TEST_CASE("A study whose beats all fold says so instead of no error", "[track]") {
  const session::StudyPart part = session::study_buffer(steep_radar(500e3), 1);
  const auto row = first_row(part.text);
  CHECK(row.at(1) == " - ");
  CHECK(row.at(4) == " - ");
  CHECK(std::stoi(row.at(6)) == 100);
  CHECK(std::isnan(part.plots.at(0).second.series.at(0).y.at(0)));
}

TEST_CASE("Errors over the noise figure meet the bound of a file's own ramps", "[track]") {
  core::HighwayRadar radar;
  radar.transmit_gain = core::power_from_dB(32.0);
  radar.receive_gain = core::power_from_dB(27.0);
  radar.waveforms.triangle_ramp_s = 1e-3;
  const session::StudyPart part = session::study_noise_figure(radar, 1);
  const auto& series = part.plots.at(0).second.series;
  const double errors_mm = series.at(0).y.at(2), bound_mm = series.at(1).y.at(2);  // 4.5 dB
  radar.noise_figure = core::power_from_dB(4.5);
  radar.ramp_s = 1e-3;
  CHECK(bound_mm == Approx(1e3 * tracking::measurement_bound(radar, 10.0, 100.0, 0.0).range_sigma_m)
                        .epsilon(1e-9));
  // Of 100 draws, four standard deviations; that of 2 ms is 1.4 times smaller.
  CHECK(errors_mm == Approx(bound_mm).epsilon(0.28));
}
