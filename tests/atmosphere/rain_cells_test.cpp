#include "atmosphere/precipitation/rain_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "atmosphere/volume_echo.h"
#include "atmosphere/weather.h"
#include "core/constants.h"
#include "core/random.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

namespace {

RainCell round_cell(double east_m, double north_m, double radius_m, double rate_mm_per_h,
                    double base_m = -2000.0, double top_m = 3000.0) {
  RainCell cell;
  cell.centre_m = {east_m, north_m};
  cell.radius_m = radius_m;
  cell.rain_rate_mm_per_h = rate_mm_per_h;
  cell.base_m = base_m;
  cell.top_m = top_m;
  return cell;
}

RainCell band(double east_m, double north_m, double length_m, double width_m, double heading_rad,
              double rate_mm_per_h) {
  RainCell cell = round_cell(east_m, north_m, 0.0, rate_mm_per_h);
  cell.length_m = length_m;
  cell.width_m = width_m;
  cell.heading_rad = heading_rad;
  return cell;
}

Weather with_cells(std::vector<RainCell> cells) {
  Weather weather;
  weather.simulate_gas = false;
  weather.rain_cells = std::move(cells);
  return weather;
}

double dB_per_km(double rate_mm_per_h) { return rain_dB_per_km(Weather{}, rate_mm_per_h, 35e9); }

}  // namespace

TEST_CASE("Chords through a round cell are those of geometry", "[rain_cells]") {
  const auto prism = VerticalPrism::circular({100.0, 200.0}, 50.0, 0.0, 1000.0);
  const auto chord = [&](glm::dvec3 a, glm::dvec3 b) {
    CHECK(prism.chord_m(a, b) == tests::within(prism.chord_m(b, a), 1e-13));
    return prism.chord_m(a, b);
  };
  // Through the middle, 30 m beside it (2 sqrt(50^2 - 30^2) = 80), touching, and past it.
  CHECK(chord({-500.0, 200.0, 10.0}, {500.0, 200.0, 10.0}) == tests::within(100.0, 1e-13));
  CHECK(chord({-500.0, 230.0, 10.0}, {500.0, 230.0, 10.0}) == tests::within(80.0, 1e-13));
  CHECK(chord({-500.0, 250.0, 10.0}, {500.0, 250.0, 10.0}) == 0.0);
  CHECK(chord({-500.0, 251.0, 10.0}, {500.0, 251.0, 10.0}) == 0.0);
  // Ending inside, starting at the rim going out, wholly inside, a point.
  CHECK(chord({-500.0, 200.0, 10.0}, {100.0, 200.0, 10.0}) == tests::within(50.0, 1e-13));
  CHECK(chord({150.0, 200.0, 10.0}, {900.0, 200.0, 10.0}) == 0.0);
  CHECK(chord({90.0, 190.0, 10.0}, {110.0, 190.0, 10.0}) == 20.0);
  CHECK(chord({100.0, 200.0, 10.0}, {100.0, 200.0, 10.0}) == 0.0);
  // Vertical, and slanted with a rise of 3 in 4.
  CHECK(chord({100.0, 200.0, -500.0}, {100.0, 200.0, 300.0}) == tests::within(300.0, 1e-13));
  CHECK(chord({160.0, 200.0, -500.0}, {160.0, 200.0, 300.0}) == 0.0);
  CHECK(chord({0.0, 200.0, 0.0}, {200.0, 200.0, 150.0}) == tests::within(125.0, 1e-13));
  CHECK(prism.longest_chord_m() == tests::within(std::hypot(100.0, 1000.0), 1e-14));
}

TEST_CASE("Chords through a rain band are those of geometry", "[rain_cells]") {
  // 400 m along north-east, 100 m across.
  const auto prism =
      VerticalPrism::rectangular({0.0, 0.0}, 400.0, 100.0, core::kPi / 4, 0.0, 500.0);
  const double s = std::sqrt(0.5);
  CHECK(prism.chord_m({-1000.0 * s, -1000.0 * s, 10.0}, {1000.0 * s, 1000.0 * s, 10.0}) ==
        tests::within(400.0, 1e-12));
  CHECK(prism.chord_m({-1000.0 * s, 1000.0 * s, 10.0}, {1000.0 * s, -1000.0 * s, 10.0}) ==
        tests::within(100.0, 1e-12));
  CHECK(prism.chord_m({0.0, -1000.0, 10.0}, {0.0, 1000.0, 10.0}) ==
        tests::within(100.0 * std::sqrt(2.0), 1e-12));
  CHECK(prism.contains({140.0, 140.0, 10.0}));
  CHECK_FALSE(prism.contains({140.0, -140.0, 10.0}));
}

TEST_CASE("A05 cutting a path through three rain cells changes nothing", "[rain_cells][A05]") {
  const Weather weather = with_cells({round_cell(500.0, 2500.0, 1200.0, 20.0),
                                      round_cell(-300.0, 5200.0, 2000.0, 60.0, -2000.0, 450.0),
                                      band(0.0, 8000.0, 3000.0, 900.0, 1.1, 5.0)});
  const RainCells cells(weather, 35e9);
  const glm::dvec3 from_m(0.0, 0.0, 600.0);
  const glm::dvec3 to_m(800.0, 9949.0, 0.0);
  const double length_m = glm::length(to_m - from_m);
  const auto at = [&](double share) { return from_m + (to_m - from_m) * share; };
  const double whole_dB = cells.one_way_dB(from_m, to_m);

  // Where the path meets a border: the shares at which the loss along it begins or ends to grow.
  std::vector<double> borders = {0.0, 1.0};
  for (const RainCell& cell : weather.rain_cells) {
    const RainCells alone(with_cells({cell}), 35e9);
    const double total_dB = alone.one_way_dB(from_m, to_m);
    REQUIRE(total_dB > 0.5);
    const double inside_share = total_dB / dB_per_km(cell.rain_rate_mm_per_h) * 1e3 / length_m;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 80; ++i) {
      const double middle = (low + high) / 2;
      (alone.one_way_dB(from_m, at(middle)) > 0.0 ? high : low) = middle;
    }
    borders.insert(borders.end(), {low, high, low + inside_share, low + inside_share});
  }

  const core::RandomKey key{7};
  for (const std::size_t cuts : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    std::vector<double> s = borders;
    s.insert(s.end(), {0.0, 1.0});
    for (std::uint64_t i = 0; i < cuts; ++i)
      s.push_back(core::uniform_from(core::random_words(key, i, 0)[0]));
    std::sort(s.begin(), s.end());
    double sum_dB = 0.0;
    double factor = 1.0;
    for (std::size_t i = 0; i + 1 < s.size(); ++i) {
      sum_dB += cells.one_way_dB(at(s[i]), at(s[i + 1]));
      factor *= cells.two_way_power_factor(at(s[i]), at(s[i + 1]));
    }
    CHECK(sum_dB == tests::within(whole_dB, 1e-12));
    CHECK(factor == tests::within(cells.two_way_power_factor(from_m, to_m), 1e-11));
  }
}

TEST_CASE("A05 points and paths on a border count once", "[rain_cells][A05]") {
  // Four bands of 5 mm/h that share walls, and a lid on top that shares their top.
  std::vector<RainCell> tiles = {
      band(50.0, 50.0, 100.0, 100.0, 0.0, 5.0), band(150.0, 50.0, 100.0, 100.0, 0.0, 5.0),
      band(50.0, 150.0, 100.0, 100.0, 0.0, 5.0), band(150.0, 150.0, 100.0, 100.0, 0.0, 5.0)};
  for (RainCell& tile : tiles) tile.top_m = 500.0;
  RainCell lid = band(100.0, 100.0, 200.0, 200.0, 0.0, 5.0);
  lid.base_m = 500.0;
  lid.top_m = 800.0;
  tiles.push_back(lid);
  const Weather weather = with_cells(tiles);
  const RainCells cells(weather, 35e9);
  const VolumeEcho echo(weather, 35e9);
  const double per_km = dB_per_km(5.0);
  const double eta = echo.eta_m2_per_m3({50.0, 50.0, 10.0});
  REQUIRE(eta > 0.0);

  // Along the shared walls, level at the shared top, straight up along the common edge.
  CHECK(cells.one_way_dB({100.0, -50.0, 10.0}, {100.0, 300.0, 10.0}) ==
        tests::within(0.2 * per_km, 1e-13));
  CHECK(cells.one_way_dB({-50.0, 100.0, 10.0}, {300.0, 100.0, 10.0}) ==
        tests::within(0.2 * per_km, 1e-13));
  CHECK(cells.one_way_dB({-50.0, 40.0, 500.0}, {300.0, 40.0, 500.0}) ==
        tests::within(0.2 * per_km, 1e-13));
  CHECK(cells.one_way_dB({100.0, 100.0, 0.0}, {100.0, 100.0, 900.0}) ==
        tests::within(0.8 * per_km, 1e-13));
  CHECK(cells.one_way_dB({-50.0, 40.0, 800.0}, {300.0, 40.0, 800.0}) == 0.0);
  for (const glm::dvec3 point : {glm::dvec3(100.0, 50.0, 10.0), glm::dvec3(100.0, 100.0, 10.0),
                                 glm::dvec3(100.0, 100.0, 500.0), glm::dvec3(0.0, 0.0, 0.0)})
    CHECK(echo.eta_m2_per_m3(point) == eta);
  for (const glm::dvec3 point : {glm::dvec3(200.0, 50.0, 10.0), glm::dvec3(50.0, 50.0, 800.0)})
    CHECK(echo.eta_m2_per_m3(point) == 0.0);
  // Diagonally through the corner that all share.
  CHECK(cells.one_way_dB({0.0, 0.0, 10.0}, {200.0, 200.0, 10.0}) ==
        tests::within(0.2 * std::sqrt(2.0) * per_km, 1e-13));
}

TEST_CASE("A06 more rain in a cell never helps", "[rain_cells][A06]") {
  double before = 1.0;
  for (int step = 0; step <= 20; ++step) {
    const RainCells cells(with_cells({round_cell(0.0, 1500.0, 700.0, 7.5 * step)}), 35e9);
    const double factor = cells.two_way_power_factor({0.0, 0.0, 100.0}, {50.0, 3000.0, 0.0});
    CHECK((step == 0 ? factor == 1.0 : factor < before));
    CHECK(cells.empty() == (step == 0));
    before = factor;
  }
}

TEST_CASE("Cells add to the layers, and their bounds hold", "[rain_cells]") {
  Weather weather = with_cells(
      {round_cell(0.0, 1000.0, 400.0, 30.0), round_cell(300.0, 1200.0, 500.0, 10.0, 200.0, 800.0)});
  weather.rain_rate_mm_per_h = 2.0;
  const RainCells cells(weather, 35e9);
  const VolumeEcho echo(weather, 35e9);
  const core::RandomKey key{11};
  const auto place = [&](std::uint64_t i, std::uint32_t part) {
    const auto words = core::random_words(key, i, part);
    return glm::dvec3(3000.0 * core::uniform_from(words[0]) - 1500.0,
                      3000.0 * core::uniform_from(words[1]) - 500.0,
                      1200.0 * core::uniform_from(words[2]) - 100.0);
  };
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const glm::dvec3 a = place(i, 0), b = place(i, 1);
    const double length_m = glm::length(b - a);
    REQUIRE(cells.one_way_dB(a, b) <= cells.largest_one_way_dB(length_m) * (1.0 + 1e-12));
    REQUIRE(cells.two_way_power_factor(a, b) <= 1.0);
    // Both cells hold the height of 300 m: there a path loses something where its plan meets one.
    const glm::dvec2 from(a), to(b);
    const bool meets = cells.one_way_dB({from, 300.0}, {to, 300.0}) > 0.0;
    REQUIRE(cells.stand_between(from, to) == meets);
    REQUIRE(echo.cells_between(from, to) == meets);
    const double eta = echo.eta_m2_per_m3(a);
    REQUIRE(eta >= echo.layered_eta_m2_per_m3(a.z));
    REQUIRE(eta <= echo.largest_eta_m2_per_m3(a.z, a.z));
    REQUIRE(eta <= echo.largest_eta_m2_per_m3());
  }
  const glm::dvec3 in_both(100.0, 1100.0, 300.0);
  const auto rain_eta = [&](double rate) {
    return rain_eta_m2_per_m3(RainEchoLaw::mie, rate, 35e9, rain_drops(weather));
  };
  CHECK(echo.eta_m2_per_m3(in_both) ==
        tests::within(rain_eta(2.0) + rain_eta(30.0) + rain_eta(10.0), 1e-13));
  weather.simulate_rain = false;
  CHECK(RainCells(weather, 35e9).empty());
  CHECK(VolumeEcho(Weather{}, 35e9).largest_eta_m2_per_m3() == 0.0);
  CHECK(VolumeEcho(Weather{}, 35e9).eta_m2_per_m3({0.0, 0.0, 0.0}) == 0.0);
}

TEST_CASE("Cells that cannot be are refused", "[rain_cells]") {
  const auto rejected = [](RainCell cell, ErrorClass error_class, const std::string& part) {
    tests::check_rejected([&] { RainCells(with_cells({cell}), 35e9); }, error_class, part);
  };
  rejected(round_cell(0.0, 0.0, 0.0, 5.0), ErrorClass::ref, "rain_cell[0].radius_m");
  rejected(round_cell(0.0, 0.0, 10.0, 5.0, 100.0, 100.0), ErrorClass::range, "above base_m = 100");
  rejected(round_cell(0.0, std::nan(""), 10.0, 5.0), ErrorClass::nonfinite, "rain_cell[0].north");
  rejected(round_cell(0.0, 0.0, 10.0, 301.0), ErrorClass::range, "0 to 300");
}
