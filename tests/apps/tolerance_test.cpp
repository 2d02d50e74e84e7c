// Which differences a tolerance lets pass.
#include "measure/regress/tolerance.h"

#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/image.h"
#include "measure/regress/case_result.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::measure;
using fanbeam::session::DifferenceUnit;

namespace {

// 1000 cells: mean -0.3 grey, RMS 2, largest 9, 50 not equal.
core::LayerDifference grey_difference() {
  core::LayerDifference difference;
  difference.layer = "Y";
  difference.cells = 1000;
  difference.different = 50;
  difference.mean = -0.3;
  difference.rms = 2.0;
  difference.largest = 9.0;
  return difference;
}

std::vector<std::string> beyond(const LayerJudgement& judged) {
  std::vector<std::string> names;
  for (const Figure& figure : judged.figures)
    if (!figure.within) names.push_back(figure.name);
  CHECK(judged.within == names.empty());
  return names;
}

using Names = std::vector<std::string>;

// A hundred cells, each 1 but the first.
void write_cells(const std::filesystem::path& folder, const char* layer, double first) {
  std::filesystem::create_directories(folder);
  std::vector<double> values(100, 1.0);
  values[0] = first;
  core::write_exr(folder / "00000.exr", {10, 10, {{layer, values}}}, {});
}

}  // namespace

TEST_CASE("Each limit stands for its own figure, and what is absent limits nothing", "[regress]") {
  const auto judged = [](const Tolerance& tolerance) {
    return beyond(judge(grey_difference(), DifferenceUnit::grey, tolerance));
  };
  CHECK(judged({.mean = 0.3, .rms = 2.0, .largest = 9.0, .percent = 5.0}).empty());
  CHECK(judged({.mean = 0.29}) == Names{"mean"});  // whatever its sign
  CHECK(judged({.rms = 1.99}) == Names{"rms"});
  CHECK(judged({.largest = 8.9}) == Names{"largest"});
  CHECK(judged({.percent = 4.9}) == Names{"percent"});
  CHECK(judged({.rms = 100.0}).empty());
}

TEST_CASE("Without a tolerance every value has to be equal", "[regress]") {
  CHECK(beyond(judge(grey_difference(), DifferenceUnit::grey, std::nullopt)) == Names{"percent"});
  core::LayerDifference same;
  same.cells = 1000;
  CHECK(beyond(judge(same, DifferenceUnit::grey, std::nullopt)).empty());
}

TEST_CASE("Cells of power that are lit in one picture only are none, unless a limit says so",
          "[regress]") {
  core::LayerDifference difference;
  difference.cells = 1000;
  difference.different = difference.only_one_positive = 2;  // no decibels, so no RMS tells
  const auto judged = [&](const Tolerance& tolerance) {
    return beyond(judge(difference, DifferenceUnit::dB, tolerance));
  };
  CHECK(judged({.rms = 1.0}) == Names{"lit_in_one_percent"});
  CHECK(judged({.rms = 1.0, .lit_in_one_percent = 0.2}).empty());
}

TEST_CASE("Ground truth is judged in its own unit, and not by what is lit", "[regress]") {
  core::LayerDifference difference = grey_difference();
  difference.layer = "elevation_deg";
  difference.only_one_positive = 50;
  const LayerJudgement judged = judge(difference, DifferenceUnit::own, Tolerance{.rms = 1.0});
  CHECK(beyond(judged) == Names{"rms"});
  CHECK(judged.figures.front().unit == "deg");
}

TEST_CASE("Truth that went dark is told although its values are small", "[regress]") {
  core::Image before, after;
  before.columns = after.columns = 100;
  before.rows = after.rows = 10;
  before.layers = {{"double_bounce", std::vector<double>(1000, 1e-6)}};
  after.layers = before.layers;
  before.layers[0].values[7] = 0.02;
  after.layers[0].values[8] = 1e-5;  // as a library of mathematics rounds
  const core::LayerDifference difference = core::compare_images(before, after, "a", "b").front();
  CHECK(difference.different == 2);
  CHECK(difference.changed == 1);
  const auto judged = [&](const Tolerance& tolerance) {
    return beyond(judge(difference, DifferenceUnit::own, tolerance));
  };
  CHECK(judged({.changed_percent = 0.1}).empty());
  CHECK(judged({.changed_percent = 0.09}) == Names{"changed_percent"});
  CHECK(judged({.mean = 1e-3, .rms = 1e-3}).empty());  // which see nothing
}

TEST_CASE("A figure that is no number is within no limit", "[regress]") {
  core::LayerDifference difference = grey_difference();
  difference.rms = std::numeric_limits<double>::quiet_NaN();
  CHECK(beyond(judge(difference, DifferenceUnit::grey, Tolerance{.rms = 100.0})) == Names{"rms"});
}

// One cell was within any limit but that of the RMS, and within that too where it is in decibels.
TEST_CASE("A cell that is no number is within no limit, of regress and of compare", "[regress]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const tests::TemporaryFolder place;
  const auto a = place.path() / "a", b = place.path() / "b";
  // Of both layers: in its own unit, and in decibels.
  const auto written = [](const std::filesystem::path& folder, double first) {
    write_cells(folder / "layers", "elevation_deg", first);
    write_cells(folder / "power", "power_W", first);
  };
  const Tolerance limits[] = {{.mean = 1e6},
                              {.rms = 1e6},
                              {.largest = 1e6},
                              {.percent = 50.0},
                              {.changed_percent = 50.0},
                              {.percent = 50.0, .lit_in_one_percent = 50.0}};
  for (const auto& [before, now] : {std::pair{1.0, nan}, {nan, 1.0}, {nan, nan}}) {
    INFO(before << " against " << now);
    written(a, before);
    written(b, now);
    for (const Tolerance& limit : limits)
      for (const PictureResult& result :
           compare_pictures(a, b, {{"layers", limit}, {"power", limit}})) {
        INFO(sentence_of(result));
        REQUIRE(result.tolerance);
        CHECK(result.state == PictureState::differs);
        CHECK(what_of(result).find("not_finite 1 cells (0 allowed)") != std::string::npos);
      }
    for (const char* file : {"layers/00000.exr", "power/00000.exr"})
      for (const char* words : {"", "--exact", "--rms 1000", "--largest 1000", "--percent 50"}) {
        const tests::Result told =
            tests::run_fanbeam("compare " + std::string(words) + " " + tests::quoted(a / file) +
                               " " + tests::quoted(b / file));
        INFO(words << ": " << told.output);
        CHECK(told.exit_code == 1);
        CHECK(told.output.rfind("DIFFER", 0) == 0);
      }
  }
  // A number, however far off, is allowed where its share is.
  written(a, 1.0);
  written(b, 1e30);
  const Tolerance half{.percent = 50.0};
  for (const PictureResult& result : compare_pictures(a, b, {{"layers", half}, {"power", half}}))
    CHECK(result.state == PictureState::same);
}
