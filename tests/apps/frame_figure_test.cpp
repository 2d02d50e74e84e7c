// The figure of a frame: its scopes are the scopes, and its scales say what lies where.
#include "session/figure/frame_figure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "sensors/display/display.h"
#include "session/figure/figure_page.h"
#include "session/figure/plan_figure.h"
#include "session/figure/runway_view.h"
#include "tests/apps/program.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::session;
using namespace fanbeam::tests;
using core::radians;

namespace {

core::Picture8 noise(int columns, int rows, unsigned seed) {
  core::Picture8 picture{columns, rows, {}};
  for (int i = 0; i < columns * rows; ++i) {
    seed = seed * 1664525U + 1013904223U;
    picture.pixels.push_back(static_cast<std::uint8_t>(seed >> 24U));
  }
  return picture;
}

FigureFacts some_facts(const sensors::Sensor& sensor) {
  FigureFacts facts;
  facts.title = "a title \x1b[31m \u4e2d" + std::string(500, 'W');
  facts.unit = range_unit("", sensor.range);
  RunwayView runway;
  runway.name = "26";
  const double near_m = sensor.range.minimum_m + 0.5 * sensor.range.cell_m;
  runway.seen = {{near_m, radians(0.1), radians(-3.0)},
                 {near_m + 100.0 * sensor.range.cell_m, radians(0.5), radians(-1.0)}};
  runway.threshold = runway.seen[0];
  facts.runways = {runway, runway, runway, runway, runway};
  return facts;
}

core::Colour pixel(const core::ColourPicture& picture, int x, int y) {
  return picture.pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.columns) +
                           static_cast<std::size_t>(x));
}

// One pixel of each block of `box`, when all pixels of all blocks are equal and grey.
core::Picture8 cut_out(const core::ColourPicture& figure, const Box& box, int columns, int rows) {
  const int across = box.columns / columns, down = box.rows / rows;
  REQUIRE((across >= 1 && across * columns == box.columns));
  REQUIRE((down >= 1 && down * rows == box.rows));
  core::Picture8 picture{columns, rows, {}};
  bool equal = true;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const core::Colour first = pixel(figure, box.left + column * across, box.top + row * down);
      equal = equal && first.red == first.green && first.red == first.blue;
      for (int i = 0; i < across * down; ++i)
        equal = equal && pixel(figure, box.left + column * across + i % across,
                               box.top + row * down + i / across) == first;
      picture.pixels.push_back(first.red);
    }
  CHECK(equal);
  return picture;
}

// A straight runway of 2 km to the north, seen from `behind_m` before its threshold.
std::vector<RunwayView> seen_from(double behind_m, double height_m, double heading_deg,
                                  double unstabilised_pitch_deg = 0.0) {
  const scenes::RunwayPlace runway{{{"36", {0.0, 0.0, 0.0}}, {"18", {0.0, 2000.0, 0.0}}}};
  const glm::dmat3 north_east_down{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  const sensors::Sensor sensor = hivision();
  const sensors::AntennaFrame antenna =
      sensors::antenna_frame({0.0, -behind_m, height_m}, north_east_down,
                             core::quaternion_from({.pitch_rad = radians(unstabilised_pitch_deg),
                                                    .heading_rad = radians(heading_deg)}),
                             sensor.mounting, unstabilised_pitch_deg == 0.0);
  return runway_views({runway}, sensor, antenna, {0.0, 0.0, 1.0});
}

}  // namespace

TEST_CASE("The scopes in a figure are the scopes, pixel by pixel, for every shipped sensor",
          "[figure]") {
  for (const char* name :
       {"hivision.toml", "hivision-94.toml", "hivision-seed.toml", "automotive-76.toml"}) {
    CAPTURE(name);
    const sensors::Sensor sensor = shipped_sensor(name);
    const core::Picture8 bscope = noise(sensor.scan.columns, sensor.range.cells, 1);
    const core::Picture8 cscope = noise(sensor.scan.columns, sensor.display.cscope_rows, 2);
    const core::ColourPicture figure = frame_figure(sensor, some_facts(sensor), bscope, cscope);
    const FigureLayout layout = figure_layout(sensor);
    CHECK(figure.columns == layout.columns);
    CHECK(figure.rows == layout.rows);
    CHECK(figure.columns % 2 == 0);
    CHECK(figure.rows % 2 == 0);
    CHECK(cut_out(figure, layout.bscope, bscope.columns, bscope.rows).pixels == bscope.pixels);
    CHECK(cut_out(figure, layout.cscope, cscope.columns, cscope.rows).pixels == cscope.pixels);
  }
}

TEST_CASE("The plan view in its figure is the plan view, pixel by pixel", "[figure]") {
  for (const char* name : {"hivision.toml", "automotive-76.toml"}) {
    CAPTURE(name);
    const sensors::Sensor sensor = shipped_sensor(name);
    const sensors::PpiView view = sensors::ppi_view(sensor, sensors::PpiView::Up::track, 700, 0.0);
    const core::Picture8 ppi = noise(view.columns, view.rows, 3);
    const core::ColourPicture figure = plan_figure(sensor, some_facts(sensor), view, ppi);
    const PlanFigureLayout layout = plan_figure_layout(view);
    CHECK(figure.columns == layout.columns);
    CHECK(figure.rows == layout.rows);
    CHECK(figure.columns % 2 == 0);
    CHECK(figure.rows % 2 == 0);
    CHECK(cut_out(figure, layout.ppi, view.columns, view.rows).pixels == ppi.pixels);
  }
}

TEST_CASE("HiVision's figure doubles the columns, as pair does", "[figure]") {
  const FigureLayout layout = figure_layout(hivision());
  CHECK(layout.bscope.columns == 328);
  CHECK(layout.bscope.rows == 524);
  CHECK(layout.cscope.columns == 328);
  CHECK(layout.cscope.rows == 524);
}

TEST_CASE("Ticks stand beside the cells that they name", "[figure]") {
  const sensors::Sensor sensor = hivision();
  const FigureFacts facts = some_facts(sensor);
  const FigureLayout layout = figure_layout(sensor);
  const core::ColourPicture figure =
      frame_figure(sensor, facts, noise(164, 524, 1), noise(164, 524, 2));
  const core::Colour background = pixel(figure, 0, 0);
  // Azimuth 5 k deg: 8 pixels a degree from -20.5 deg.
  for (int k = -4; k <= 4; ++k) {
    const int x = layout.bscope.left + 164 + 40 * k;
    for (const int beside : {-1, 0, 1}) {
      CAPTURE(k, beside);
      CHECK((pixel(figure, x + beside, layout.bscope.bottom() + 3) == background) == (beside != 0));
    }
  }
  // 500 m steps from the far end, 3695.08 m, in rows of 6.67 m.
  for (int k = 1; k <= 7; ++k) {
    const int y = layout.bscope.top + static_cast<int>((3695.08 - 500.0 * k) / 6.67);
    for (const int beside : {-1, 0, 1}) {
      CAPTURE(k, beside);
      CHECK((pixel(figure, layout.bscope.left - 4, y + beside) == background) == (beside != 0));
    }
  }
  // Grey 0 and 255 are -55 and 5 dB: the bar's darkest and lightest ends.
  const FigureScales scales = figure_scales(sensor, facts.unit);
  CHECK(scales.level_dB.first == 5.0);
  CHECK(scales.level_dB.last == -55.0);
  CHECK(pixel(figure, layout.bar.left, layout.bar.top).red == 255);
  CHECK(pixel(figure, layout.bar.left, layout.bar.bottom() - 1).red == 0);
}

TEST_CASE("The range scale is in km beyond 2 km, in m below, or as asked", "[figure]") {
  CHECK(figure_scales(hivision(), range_unit("", hivision().range)).range.label == "range, km");
  const sensors::Sensor street = shipped_sensor("automotive-76.toml");
  CHECK(figure_scales(street, range_unit("", street.range)).range.label == "range, m");
  const FigureScales miles = figure_scales(hivision(), range_unit("NM", hivision().range));
  CHECK(miles.range.first == Approx(3695.08 / 1852.0));
  CHECK(miles.range.last == Approx(200.0 / 1852.0));
  CHECK(length_text(3210.4, {"km", 1000.0}) == "3.21 km");
  CHECK(length_text(1852.0, {"NM", 1852.0}) == "1.00 NM");
  CHECK(length_text(84.26, {"m", 1.0}) == "84.3 m");
  CHECK(length_text(870.4, {"m", 1.0}) == "870 m");
}

// It stood at the picture's edge for a runway that lies across the view.
TEST_CASE("A wedge points at the nearest point of a runway, wherever along it", "[figure]") {
  RunwayView across;
  for (const double azimuth_deg : {-20.0, -10.0, -1.0, 9.0, 18.0})
    across.seen.push_back({2000.0 / std::cos(radians(azimuth_deg + 1.0)), radians(azimuth_deg)});
  const Axis scale{-20.5, 20.5, 41, ""};
  const auto mark = runway_mark(
      across, scale, [](const SeenPoint& point) { return core::degrees(point.azimuth_rad); });
  REQUIRE(mark);
  CHECK(mark->from == pixel_of(scale, -20.0));
  CHECK(mark->tip == pixel_of(scale, -1.0));
  CHECK(mark->to == pixel_of(scale, 18.0));
}

TEST_CASE("A runway's place in the picture: range, azimuth, elevation of what the sensor sees",
          "[figure]") {
  // 1000 m before the threshold, 100 m high, straight ahead.
  RunwayView view = seen_from(1000.0, 100.0, 0.0).at(0);
  CHECK(view.name == "36");
  REQUIRE(view.threshold_ahead);
  CHECK(view.threshold.range_m == Approx(std::hypot(1000.0, 100.0)));
  CHECK(view.threshold.azimuth_rad == Approx(0.0).epsilon(0.0).margin(1e-12));
  CHECK(view.threshold.elevation_rad == Approx(-std::atan(0.1)));
  CHECK(view.seen.front().range_m == Approx(view.threshold.range_m));
  CHECK(view.seen.back().range_m == Approx(std::hypot(3000.0, 100.0)));

  // 10 deg to the left of the nose, when that points 10 deg to the right.
  view = seen_from(1000.0, 100.0, 10.0).at(0);
  CHECK(view.threshold.azimuth_rad == Approx(radians(-10.0)));
  // Outside the sector of +-20.5 deg.
  CHECK(seen_from(1000.0, 100.0, 25.0).at(0).seen.empty());
  // From the other side it is runway 18.
  CHECK(seen_from(-3000.0, 100.0, 180.0).at(0).name == "18");

  // Over the runway: the threshold lies behind, what is seen begins at 200 m.
  view = seen_from(-500.0, 50.0, 0.0).at(0);
  CHECK_FALSE(view.threshold_ahead);
  CHECK(view.threshold.range_m == Approx(std::hypot(500.0, 50.0)));
  CHECK(view.seen.front().range_m == Approx(200.0).epsilon(0.0).margin(2000.0 / 256.0));
}

TEST_CASE("Elevations from the local horizontal do not tilt with the antenna", "[figure]") {
  const RunwayView level = seen_from(1000.0, 100.0, 0.0).at(0),
                   tilted = seen_from(1000.0, 100.0, 0.0, 5.0).at(0);
  const double down_rad = -std::atan(0.1);
  CHECK(level.threshold.above_level_rad == Approx(down_rad));
  CHECK(tilted.threshold.elevation_rad ==
        Approx(down_rad - radians(5.0)).epsilon(0.0).margin(1e-3));
  CHECK(tilted.threshold.above_level_rad == Approx(down_rad).epsilon(0.0).margin(1e-3));
}

TEST_CASE("Marks beside a C-scope drawn from ranges count from the local horizontal", "[figure]") {
  sensors::Sensor sensor = hivision();
  const FigureLayout layout = figure_layout(sensor);
  // The marks of `facts` beside the C-scope, drawn from ranges or not.
  const auto marks_of = [&](const FigureFacts& facts, sensors::Display::CScopeMode mode) {
    sensor.display.cscope_mode = mode;
    const auto picture =
        frame_figure(sensor, facts, noise(sensor.scan.columns, sensor.range.cells, 1),
                     noise(sensor.scan.columns, sensor.display.cscope_rows, 2));
    std::vector<core::Colour> pixels;
    for (int y = layout.cscope.top; y < layout.cscope.bottom(); ++y)
      for (int x = layout.cscope.right(); x < layout.bar.left; ++x)
        pixels.push_back(pixel(picture, x, y));
    return pixels;
  };
  FigureFacts level = some_facts(sensor), tilted = level;
  for (FigureFacts* facts : {&level, &tilted}) {
    facts->boresight_above_level_rad = radians(-2.0);
    for (RunwayView& runway : facts->runways)
      for (SeenPoint& point : runway.seen) point.above_level_rad = radians(-1.5);
  }
  tilted.horizon_left_rad = tilted.horizon_right_rad = radians(-3.0);
  for (RunwayView& runway : tilted.runways)
    for (SeenPoint& point : runway.seen) point.elevation_rad -= radians(3.0);
  using Mode = sensors::Display::CScopeMode;
  for (const Mode mode : {Mode::flat_earth, Mode::shadow})
    CHECK((marks_of(level, mode) == marks_of(tilted, mode)));
  CHECK_FALSE((marks_of(level, Mode::true_elevation) == marks_of(tilted, Mode::true_elevation)));
}

TEST_CASE("render --products figure holds the bytes of bscope and cscope, in any unit",
          "[figure]") {
  const TemporaryFolder folder;
  const std::string words = "render flat-grass -q --frames 0 --rays-per-cell 1 -o " +
                            quoted(folder.path() / "out") + " --products bscope,cscope,figure";
  const Result result = run_fanbeam(words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  const auto read = [&](const char* product) {
    return core::read_image(folder.path() / "out" / product / "00000.png");
  };
  const core::Image figure = read("figure");
  REQUIRE(figure.layers.size() == 3);
  core::ColourPicture picture{figure.columns, figure.rows, {}};
  for (std::size_t i = 0; i < figure.layers[0].values.size(); ++i)
    picture.pixels.push_back({static_cast<std::uint8_t>(figure.layers[0].values[i]),
                              static_cast<std::uint8_t>(figure.layers[1].values[i]),
                              static_cast<std::uint8_t>(figure.layers[2].values[i])});
  const FigureLayout layout = figure_layout(hivision());
  for (const auto& [product, box] :
       {std::pair{"bscope", layout.bscope}, std::pair{"cscope", layout.cscope}}) {
    CAPTURE(product);
    const core::Image scope = read(product);
    const core::Picture8 cut = cut_out(picture, box, scope.columns, scope.rows);
    CHECK(std::equal(cut.pixels.begin(), cut.pixels.end(), scope.layers[0].values.begin(),
                     scope.layers[0].values.end()));
  }

  // Another unit is another picture: an interrupted run does not take the old one over.
  const std::string before = bytes_of(folder.path() / "out/figure/00000.png");
  REQUIRE(run_fanbeam(words + " --resume").exit_code == 0);
  CHECK(bytes_of(folder.path() / "out/figure/00000.png") == before);
  REQUIRE(run_fanbeam(words + " --range-unit NM --resume").exit_code == 0);
  CHECK(bytes_of(folder.path() / "out/figure/00000.png") != before);
  CHECK(run_fanbeam("render flat-grass --range-unit NM --products bscope").exit_code == 2);
  CHECK(run_fanbeam("render flat-grass --range-unit ly --products figure").exit_code == 2);
  const Result idle = run_fanbeam("render flat-grass --preview-format gif --range-unit NM");
  CHECK(idle.exit_code == 2);
  CHECK(idle.output.find("E-REF --range-unit = NM") != std::string::npos);
  CHECK(idle.output.find("E-REF --preview-format = gif: expected preview among --products") !=
        std::string::npos);
}
