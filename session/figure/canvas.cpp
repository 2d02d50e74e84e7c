#include "session/figure/canvas.h"

#include <algorithm>
#include <cstdlib>

#include "session/figure/font.h"

namespace fanbeam::session {
namespace {

// Calls set(along, across) for each inked pixel of a text, counted from its upper left corner.
template <class Set>
void ink_of(std::string_view utf8, const TextStyle& style, const Set& set) {
  const int scale = style.scale;
  int begin = 0;
  for (const char32_t point : code_points(utf8)) {
    const Glyph& rows = glyph(point, style.bold);
    for (int row = 0; row < kGlyphRows * scale; ++row)
      for (int column = 0; column < kGlyphColumns * scale; ++column)
        if ((rows[static_cast<std::size_t>(row / scale)] >> (7 - column / scale) & 1) != 0)
          set(begin + column, row);
    begin += kGlyphColumns * scale;
  }
}

int shift(std::string_view utf8, const TextStyle& style) {
  if (style.align == Align::left) return 0;
  const int width = text_width(utf8, style.scale);
  return style.align == Align::right ? width : width / 2;
}

}  // namespace

int text_width(std::string_view utf8, int scale) {
  return static_cast<int>(code_points(utf8).size()) * kGlyphColumns * scale;
}

std::string shortened(std::string_view utf8, int width_px) {
  constexpr int kPoints = 3;
  const int letters = std::max(0, width_px / kGlyphColumns);
  if (static_cast<int>(code_points(utf8).size()) <= letters) return std::string(utf8);
  std::string kept(utf8.substr(0, static_cast<std::size_t>(4 * letters)));  // of 4 bytes at most
  while (!kept.empty() && static_cast<int>(code_points(kept).size()) > letters - kPoints)
    kept.pop_back();
  return kept + std::string(static_cast<std::size_t>(std::min(letters, kPoints)), '.');
}

Canvas::Canvas(int columns, int rows, core::Colour background) : picture_{columns, rows, {}} {
  picture_.pixels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                         background);
}

void Canvas::set(int x, int y, core::Colour ink) {
  if (x < 0 || y < 0 || x >= picture_.columns || y >= picture_.rows) return;
  picture_.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.columns) +
                  static_cast<std::size_t>(x)] = ink;
}

void Canvas::fill(const Box& box, core::Colour ink) {
  for (int y = std::max(0, box.top); y < std::min(rows(), box.bottom()); ++y)
    for (int x = std::max(0, box.left); x < std::min(columns(), box.right()); ++x) set(x, y, ink);
}

void Canvas::frame(const Box& box, core::Colour ink) {
  fill({box.left - 1, box.top - 1, box.columns + 2, 1}, ink);
  fill({box.left - 1, box.bottom(), box.columns + 2, 1}, ink);
  fill({box.left - 1, box.top, 1, box.rows}, ink);
  fill({box.right(), box.top, 1, box.rows}, ink);
}

void Canvas::line(int from_x, int from_y, int to_x, int to_y, core::Colour ink) {
  // Bresenham 1965, all octants.
  const int across = std::abs(to_x - from_x), down = -std::abs(to_y - from_y);
  const int step_x = from_x < to_x ? 1 : -1, step_y = from_y < to_y ? 1 : -1;
  int error = across + down;
  for (;;) {
    set(from_x, from_y, ink);
    if (from_x == to_x && from_y == to_y) return;
    const int doubled = 2 * error;
    if (doubled >= down) error += down, from_x += step_x;
    if (doubled <= across) error += across, from_y += step_y;
  }
}

void Canvas::wedge(int x, int y, int size, Widens widens, core::Colour ink) {
  for (int i = 0; i < size; ++i) {
    if (widens == Widens::up) fill({x - i, y - i, 2 * i + 1, 1}, ink);
    if (widens == Widens::down) fill({x - i, y + i, 2 * i + 1, 1}, ink);
    if (widens == Widens::left) fill({x - i, y - i, 1, 2 * i + 1}, ink);
    if (widens == Widens::right) fill({x + i, y - i, 1, 2 * i + 1}, ink);
  }
}

void Canvas::text(int x, int y, std::string_view utf8, const TextStyle& style) {
  const int left = x - shift(utf8, style);
  ink_of(utf8, style, [&](int column, int row) { set(left + column, y + row, style.ink); });
}

void Canvas::upright_text(int x, int y, std::string_view utf8, const TextStyle& style) {
  const int bottom = y + shift(utf8, style);
  ink_of(utf8, style, [&](int column, int row) { set(x + row, bottom - 1 - column, style.ink); });
}

void Canvas::paste(const core::Picture8& picture, int left, int top, int across, int down) {
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.columns; ++column) {
      const std::uint8_t grey =
          picture.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns) +
                         static_cast<std::size_t>(column)];
      fill({left + column * across, top + row * down, across, down}, {grey, grey, grey});
    }
}

}  // namespace fanbeam::session
