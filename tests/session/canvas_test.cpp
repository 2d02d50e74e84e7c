// Drawing with whole pixels, letters, and where ticks stand.
#include "session/figure/canvas.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "session/figure/axis.h"
#include "session/figure/font.h"
#include "session/figure/margin_marks.h"

using namespace fanbeam;
using namespace fanbeam::session;
using core::Colour;

namespace {

constexpr Colour kPaper{0, 0, 0}, kInk{200, 100, 50};

Colour at(const Canvas& canvas, int x, int y) {
  return canvas.picture().pixels.at(static_cast<std::size_t>(y * canvas.columns() + x));
}

// Inked pixels as rows of # and dots.
std::vector<std::string> drawing(const Canvas& canvas) {
  std::vector<std::string> rows;
  for (int y = 0; y < canvas.rows(); ++y) {
    rows.emplace_back();
    for (int x = 0; x < canvas.columns(); ++x) rows.back() += at(canvas, x, y) == kInk ? '#' : '.';
  }
  return rows;
}

std::vector<std::string> text_drawing(const std::string& text, int scale = 1) {
  Canvas canvas(text_width(text, scale), kGlyphRows * scale, kPaper);
  canvas.text(0, 0, text, {kInk, Align::left, scale});
  return drawing(canvas);
}

}  // namespace

TEST_CASE("A filled box covers its pixels and no other, and stays inside the picture", "[canvas]") {
  Canvas canvas(4, 3, kPaper);
  canvas.fill({1, 1, 2, 1}, kInk);
  CHECK(drawing(canvas) == std::vector<std::string>{"....", ".##.", "...."});
  canvas.fill({-5, 2, 100, 100}, kInk);
  CHECK(drawing(canvas) == std::vector<std::string>{"....", ".##.", "####"});
  canvas.set(-1, 0, kInk);
  canvas.set(4, 0, kInk);
  CHECK(drawing(canvas)[0] == "....");
}

TEST_CASE("A line holds both ends and is the same drawn backwards along an axis or a diagonal",
          "[canvas]") {
  Canvas canvas(5, 5, kPaper);
  canvas.line(0, 0, 4, 4, kInk);
  canvas.line(4, 0, 0, 4, kInk);
  CHECK(drawing(canvas) == std::vector<std::string>{"#...#", ".#.#.", "..#..", ".#.#.", "#...#"});
  Canvas flat(5, 1, kPaper);
  flat.line(4, 0, 1, 0, kInk);
  CHECK(drawing(flat) == std::vector<std::string>{".####"});
}

TEST_CASE("A pasted pixel becomes a block of equal ones", "[canvas]") {
  Canvas canvas(7, 4, kInk);
  canvas.paste({2, 1, {7, 250}}, 1, 1, 3, 2);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 7; ++x) {
      CAPTURE(x, y);
      const bool inside = x >= 1 && y >= 1 && y < 3;
      const auto grey = static_cast<std::uint8_t>(x < 4 ? 7 : 250);
      CHECK(at(canvas, x, y) == (inside ? Colour{grey, grey, grey} : kInk));
    }
}

TEST_CASE("Letters have the pixels of the shipped font, twice as large at scale 2", "[canvas]") {
  // The L of 7x13: a stem of 9 pixels and a foot of 6.
  std::vector<std::string> expected(13, ".......");
  for (std::size_t row = 2; row < 10; ++row) expected[row] = "#......";
  expected[10] = "######.";
  CHECK(text_drawing("L") == expected);
  const std::vector<std::string> twice = text_drawing("L", 2);
  REQUIRE(twice.size() == 26);
  for (std::size_t row = 0; row < 26; ++row)
    for (std::size_t column = 0; column < 14; ++column)
      CHECK(twice[row][column] == expected[row / 2][column / 2]);
}

TEST_CASE("Text from files: UTF-8 is read, what cannot be drawn is a question mark", "[canvas]") {
  CHECK(code_points("a\u00b0\u20ac") == U"a\u00b0\u20ac");
  CHECK(text_drawing("Z\u00fcrich").size() == 13);
  CHECK(text_width("Z\u00fcrich") == 6 * kGlyphColumns);
  CHECK(text_drawing("\u00fc") != text_drawing("?"));
  const auto question_mark = text_drawing("?");
  // No glyph, a control character, an escape, a lone byte, a cut sequence, one longer than need be.
  for (const char* text : {"\u4e2d", "\n", "\x1b", "\x7f", "\xff", "\xc3", "\x80"}) {
    CAPTURE(text);
    CHECK(text_drawing(text) == question_mark);
  }
  CHECK(text_drawing("\xc0\xaf") == text_drawing("??"));
  CHECK(text_drawing("\xe2\x82z") == text_drawing("??z"));
}

TEST_CASE("Text that does not fit ends in three points", "[canvas]") {
  CHECK(shortened("runway 26", 9 * kGlyphColumns) == "runway 26");
  CHECK(shortened("runway 26", 9 * kGlyphColumns - 1) == "runwa...");
  CHECK(text_width(shortened("\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc", 5 * kGlyphColumns)) ==
        5 * kGlyphColumns);
  CHECK(shortened("runway", 2 * kGlyphColumns) == "..");
  CHECK(shortened("runway", -1).empty());
}

TEST_CASE("A value's pixel is the one that holds it, edges and rounding included", "[axis]") {
  const Axis axis{10.0, 20.0, 5};  // 2 a pixel
  CHECK(pixel_of(axis, 10.0) == 0);
  CHECK(pixel_of(axis, 11.999) == 0);
  CHECK(pixel_of(axis, 12.0) == 1);
  CHECK(pixel_of(axis, 20.0) == 4);
  CHECK(pixel_of(axis, 9.99) == -1);
  CHECK(pixel_of(axis, 20.01) == -1);
  CHECK(pixel_of({0.0, 0.3, 3}, 0.1 + 0.1) == 2);
  CHECK(pixel_of({0.0, 0.3, 3}, 0.3 - 0.1 - 0.1) == 1);  // 0.09999999999999998
  const Axis downward{3.0, -1.0, 4};                     // highest first
  CHECK(pixel_of(downward, 3.0) == 0);
  CHECK(pixel_of(downward, 0.0) == 3);
}

TEST_CASE("Ticks are multiples of 1, 2 or 5 times a power of ten, as close as asked at most",
          "[axis]") {
  CHECK(tick_step({0.0, 100.0, 100}, 40) == Approx(50.0));
  CHECK(tick_step({0.0, 100.0, 100}, 20) == Approx(20.0));
  CHECK(tick_step({0.0, 100.0, 100}, 10) == Approx(10.0));
  CHECK(tick_step({0.0, 0.004, 100}, 40) == Approx(0.002));
  CHECK(tick_step({5.0, -55.0, 524}, 40) == Approx(5.0));

  // Azimuths of HiVision, 2 pixels of 0.25 deg each: 8 pixels a degree, 0 at 164.
  const std::vector<Tick> found = ticks({-20.5, 20.5, 328}, 40);
  REQUIRE(found.size() == 9);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(found[i].value == Approx(-20.0 + 5.0 * static_cast<double>(i)));
    CHECK(found[i].pixel == 4 + 40 * static_cast<int>(i));
  }
  CHECK(found[4].text == "0");
  CHECK(found[0].text == "-20");

  const std::vector<Tick> small = ticks({0.6, -0.6, 120}, 40);
  REQUIRE(small.size() == 3);
  CHECK(small[0].text == "0.5");
  CHECK(small[1].text == "0.0");
  CHECK(small[2].text == "-0.5");
  CHECK(small[2].pixel == 110);
}

TEST_CASE("Marks whose texts would overlap are moved apart", "[margin_marks]") {
  const Box picture{0, 0, 10, 60};
  Canvas canvas(120, 60, kPaper);
  const Colour blue{0, 0, 255};
  draw_marks_right(canvas, picture, {{30, 30, 30, "L", kInk}, {31, 31, 31, "L", blue}});
  // Each L shows its whole foot of 6 pixels: nothing lies over another.
  std::vector<int> feet(2, 0);
  for (int y = 0; y < 60; ++y)
    for (int x = 21; x < 120; ++x) {
      feet[0] += at(canvas, x, y) == kInk;
      feet[1] += at(canvas, x, y) == blue;
    }
  CHECK(feet == std::vector<int>{14, 14});
}
