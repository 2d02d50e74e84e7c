// Tracks of one flight by its detections as JSON and as tables.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"

namespace fanbeam::tests {

// What fanbeam fmcw left has tables of detections alone then.
inline void remove_json(const std::filesystem::path& detections, int frames) {
  for (int i = 0; i < frames; ++i)
    REQUIRE(std::filesystem::remove(detections / fmt::format("{:05}.json", i)));
}

// The first columns of a table.
inline std::vector<std::vector<double>> numbers_in(const std::filesystem::path& tracks,
                                                   std::size_t columns) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(bytes_of(tracks));
  std::string line, cell;
  for (std::getline(lines, line); std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (rows.back().size() < columns && std::getline(cells, cell, ','))
      rows.back().push_back(std::stod(cell));
  }
  return rows;
}

// Tables of detections have half a millimetre, half a millimetre a second and half a thousandth of a degree, 2 mm at
// 240 m: tracks of them are off by 3 mm and 25 mm/s at most, by a third and a quarter of what is asked for.
inline void check_same_tracks(const std::filesystem::path& one,
                              const std::filesystem::path& other) {
  const auto a = numbers_in(one / "tracks.csv", 7), b = numbers_in(other / "tracks.csv", 7);
  REQUIRE(a.size() > 100);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].size() == 7);
    REQUIRE(b[i].size() == 7);
    CHECK(b[i][0] == Approx(a[i][0]).epsilon(0.0).margin(1e-6));  // time
    CHECK(b[i][1] == a[i][1]);                                    // track
    for (const std::size_t place : {3U, 4U})
      CHECK(b[i][place] == Approx(a[i][place]).epsilon(0.0).margin(0.01));
    for (const std::size_t velocity : {5U, 6U})
      CHECK(b[i][velocity] == Approx(a[i][velocity]).epsilon(0.0).margin(0.1));
  }
  for (const char* count : {"frames", "detections", "measurements", "confirmed_tracks",
                            "moving_tracks", "radar_velocity_mps", "resolution"})
    CHECK(json_of(other / "run.json").at(count) == json_of(one / "run.json").at(count));
}

}  // namespace fanbeam::tests
