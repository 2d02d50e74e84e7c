// Difference maps: colours at known differences, and what the command line makes of them.
#include "session/figure/difference_map.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/errors.h"
#include "core/image_compare.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::session;
using namespace fanbeam::tests;
using core::Colour;

namespace {

constexpr auto kGrey = DifferenceUnit::grey;
constexpr auto kdB = DifferenceUnit::dB;
const Colour kNeutral = diverging_colour(0.0);

int lightness(const Colour& colour) { return colour.red + colour.green + colour.blue; }

core::Image layer(int columns, int rows, std::vector<double> values) {
  return {columns, rows, {{"Y", std::move(values)}}};
}

// The cells of a map of an image that fills 360 pixels or less: what lies inside its frame.
std::size_t count(const core::ColourPicture& picture, const Colour& colour) {
  return static_cast<std::size_t>(std::count(picture.pixels.begin(), picture.pixels.end(), colour));
}

core::ColourPicture read_colours(const std::filesystem::path& file) {
  const core::Image image = core::read_image(file);
  REQUIRE(image.layers.size() == 3);
  core::ColourPicture picture{image.columns, image.rows, {}};
  for (std::size_t i = 0; i < image.layers[0].values.size(); ++i)
    picture.pixels.push_back({static_cast<std::uint8_t>(image.layers[0].values[i]),
                              static_cast<std::uint8_t>(image.layers[1].values[i]),
                              static_cast<std::uint8_t>(image.layers[2].values[i])});
  return picture;
}

}  // namespace

TEST_CASE("Colours of differences: signed, deeper with the square root, neutral for equal only",
          "[difference_map]") {
  CHECK(difference_colour(7.0, 7.0, kGrey, 10.0) == kNeutral);
  CHECK(difference_colour(0.0, 10.0, kGrey, 10.0) == diverging_colour(1.0));
  CHECK(difference_colour(10.0, 0.0, kGrey, 10.0) == diverging_colour(-1.0));
  CHECK(difference_colour(0.0, 2.5, kGrey, 10.0) == diverging_colour(0.5));
  CHECK(difference_colour(0.0, 50.0, kGrey, 10.0) == diverging_colour(1.0));
  // One grey level of two hundred is no neutral cell.
  CHECK(difference_colour(100.0, 101.0, kGrey, 200.0) != kNeutral);
  // Orange is red before blue, blue the other way round: apart without red or without green.
  for (const double depth : {0.25, 0.5, 1.0}) {
    const Colour higher = diverging_colour(depth), lower = diverging_colour(-depth);
    CHECK(higher.red > higher.blue + 40);
    CHECK(lower.blue > lower.red + 40);
    CHECK(lightness(diverging_colour(0.5 * depth)) > lightness(higher));
    CHECK(lightness(diverging_colour(-0.5 * depth)) > lightness(lower));
  }

  CHECK(difference_colour(1.0, 10.0, kdB, 10.0) == diverging_colour(1.0));
  CHECK(difference_colour(10.0, 1.0, kdB, 40.0) == diverging_colour(-0.5));
  CHECK(difference_colour(0.0, 0.0, kdB, 10.0) == kNeutral);
  CHECK(difference_colour(0.0, 1e-20, kdB, 10.0) == diverging_colour(1.0));
  CHECK(difference_colour(1e-20, 0.0, kdB, 10.0) == diverging_colour(-1.0));
  const Colour black{0, 0, 0};
  CHECK(difference_colour(-1.0, 2.0, kdB, 10.0) == black);
  CHECK(difference_colour(std::nan(""), 2.0, kGrey, 10.0) == black);
}

TEST_CASE("A scale ends at 1, 2 or 5 times a power of ten that holds the largest difference",
          "[difference_map]") {
  CHECK(difference_limit(0.0, kGrey) == 1.0);
  CHECK(difference_limit(1.0, kGrey) == 1.0);
  CHECK(difference_limit(3.0, kGrey) == 5.0);
  CHECK(difference_limit(98.0, kGrey) == 100.0);
  CHECK(difference_limit(255.0, kGrey) == 500.0);
  CHECK(difference_limit(1e-9, kdB) == Approx(0.1));
  CHECK(difference_limit(0.3, kdB) == Approx(0.5));
}

TEST_CASE("A map shows every cell in its colour, and nothing on top", "[difference_map]") {
  // 40 x 20 cells of 9 x 16 pixels (360 over 40, at most 16).
  std::vector<double> a(800, 100.0), b(800, 100.0);
  b[5 * 40 + 7] = 104.0;
  b[10 * 40 + 8] = 99.0;
  const core::ColourPicture map =
      difference_map(layer(40, 20, a), layer(40, 20, b), "t.png", {"t"});
  std::size_t cells = 0;
  for (const auto& [value, differing] : {std::pair{104.0, 1U}, std::pair{99.0, 1U}}) {
    const std::size_t found = count(map, difference_colour(100.0, value, kGrey, 5.0));
    // The scale's bar, 16 pixels wide, may hold a few rows of the same colour.
    CHECK(found >= differing * 9 * 16);
    CHECK(found <= differing * 9 * 16 + 16 * 40);
    cells += differing;
  }
  CHECK(count(map, kNeutral) >= (800 - cells) * 9 * 16);
}

TEST_CASE("Images that are equal give a neutral map in which no cell is marked",
          "[difference_map]") {
  const core::Image image = layer(40, 20, std::vector<double>(800, 3.0));
  const core::ColourPicture same = difference_map(image, image, "t.png", {"t"});
  CHECK(count(same, kNeutral) >= 800 * 9 * 16);
  CHECK(same.pixels !=
        difference_map(image, layer(40, 20, std::vector<double>(800, 4.0)), "t.png", {"t"}).pixels);
}

TEST_CASE("Maps of different sizes, other layers and absurd sizes are refused",
          "[difference_map]") {
  CHECK_THROWS_AS(difference_map(layer(2, 1, {1, 2}), layer(1, 2, {1, 2}), "t.png", {"t"}),
                  core::InputError);
  const core::Image line = layer(20000, 1, std::vector<double>(20000, 1.0));
  CHECK_THROWS_AS(difference_map(line, line, "t.png", {"t"}), core::InputError);
}

TEST_CASE("compare --heat-map draws two images, and of two folders the pairs that differ",
          "[compare]") {
  const TemporaryFolder folder;
  const auto picture = [](std::uint8_t grey) {
    core::Picture8 p{6, 4, std::vector<std::uint8_t>(24, 50)};
    p.pixels[9] = grey;
    return p;
  };
  const std::filesystem::path root = folder.path();
  for (const char* side : {"a", "b"}) {
    core::write_png(root / side / "same.png", picture(50), {});
    core::write_png(root / side / "sub/other.png", picture(side[0] == 'a' ? 50 : 60), {});
    core::write_exr(root / side / "power.exr", {1, 1, {{"W", {side[0] == 'a' ? 1.0 : 2.0}}}}, {});
  }
  const std::string in = "cd " + quoted(root) + " && ";
  const Result maps = run_fanbeam("compare a b --heat-map maps", in);
  INFO(maps.output);
  CHECK(maps.exit_code == 1);
  std::set<std::string> files;
  for (const auto& [name, bytes] : contents(root / "maps"))
    if (!bytes.empty()) files.insert(name);
  CHECK(files == std::set<std::string>{"power.exr.png", "sub/other.png"});
  const core::ColourPicture other = read_colours(root / "maps/sub/other.png");
  CHECK(count(other, difference_colour(50, 60, kGrey, 10.0)) >= 16 * 16);

  // A difference that the tolerance allows is still worth a look.
  CHECK(run_fanbeam("compare a b --rms 20 -q --heat-map allowed", in).exit_code == 0);
  CHECK(std::filesystem::exists(root / "allowed/sub/other.png"));
  CHECK_FALSE(std::filesystem::exists(root / "allowed/same.png"));

  // The map of an earlier comparison does not outlive what it showed.
  core::write_png(root / "b/sub/other.png", picture(50), {});
  CHECK(run_fanbeam("compare a b --heat-map maps", in).exit_code == 1);
  CHECK(count(read_colours(root / "maps/sub/other.png"), difference_colour(50, 60, kGrey, 10.0)) <
        16 * 16);

  CHECK(run_fanbeam("compare a/same.png b/same.png --heat-map one.png", in).exit_code == 0);
  CHECK(count(read_colours(root / "one.png"), kNeutral) >= 24 * 16 * 16);

  const std::string before = bytes_of(root / "a/same.png");
  for (const char* bad : {"one.jpg", "a/same.png", "b/../a/same.png"}) {
    const Result refused =
        run_fanbeam("compare a/same.png b/same.png --heat-map " + std::string(bad), in);
    INFO(refused.output);
    CHECK(refused.exit_code == 2);
  }
  CHECK(run_fanbeam("compare a b --heat-map a/maps", in).exit_code == 2);
  CHECK(bytes_of(root / "a/same.png") == before);
}

TEST_CASE("compare tells every pair that it cannot read, and compares the others", "[compare]") {
  const TemporaryFolder folder;
  const std::filesystem::path root = folder.path();
  const core::Picture8 picture{6, 4, std::vector<std::uint8_t>(24, 50)};
  for (const char* side : {"a", "b"}) {
    for (const char* name : {"1.png", "2.png", "9.png"})
      core::write_png(root / side / name, picture, {});
    folder.write(std::string(side) + "/3.png", "no picture");
    std::filesystem::create_symlink("nowhere.png", root / side / "4.png");
    std::filesystem::create_symlink("5.exr", root / side / "5.exr");
  }
  folder.write("a/1.png", "no picture either");
  core::write_png(root / "b/9.png", core::Picture8{5, 4, std::vector<std::uint8_t>(20, 50)}, {});
  const std::string in = "cd " + quoted(root) + " && ";
  const Result result = run_fanbeam("compare a b", in);
  INFO(result.output);
  CHECK(result.exit_code == 3);
  CHECK(result.output.find("same   2.png") != std::string::npos);
  for (const char* told :
       {"a/1.png: E-PARSE", "a/3.png: E-PARSE", "b/3.png: E-PARSE", "a/4.png: E-IO",
        "b/4.png: E-IO", "a/5.exr: E-IO", "b/5.exr: E-IO", "E-REF", "8 errors"})
    CHECK(result.output.find(told) != std::string::npos);
  std::filesystem::create_symlink("loop", root / "loop");
  for (const char* words : {"compare loop loop", "regress run loop",
                            "compare a/2.png b/2.png --heat-map loop/map.png"}) {
    const Result loop = run_fanbeam(words, in);
    INFO(loop.output);
    CHECK(loop.output.find("E-IO") != std::string::npos);
    CHECK(loop.output.find("filesystem error") == std::string::npos);
  }
}
