// Draws into a coloured picture with whole pixels: no smoothing, so that the bytes are the same on
// every machine. What falls outside the picture is left out.
#pragma once

#include <string>
#include <string_view>

#include "core/colour_picture.h"

namespace fanbeam::session {

struct Box {
  int left = 0, top = 0, columns = 0, rows = 0;

  int right() const { return left + columns; }  // both one beyond the last pixel
  int bottom() const { return top + rows; }
};

enum class Align { left, middle, right };

struct TextStyle {
  core::Colour ink{};
  Align align = Align::left;  // where x lies in the text
  int scale = 1;              // pixels of a glyph's pixel
  bool bold = false;
};

// Pixels from the first letter's left edge to the last one's right edge.
int text_width(std::string_view utf8, int scale = 1);

// The text, or as much of it as fits into `width_px`, with three points at the end.
std::string shortened(std::string_view utf8, int width_px);

class Canvas {
 public:
  Canvas(int columns, int rows, core::Colour background);

  const core::ColourPicture& picture() const { return picture_; }
  int columns() const { return picture_.columns; }
  int rows() const { return picture_.rows; }

  void set(int x, int y, core::Colour ink);
  void fill(const Box& box, core::Colour ink);
  // A line of one pixel around the outside of `box`.
  void frame(const Box& box, core::Colour ink);
  // Both ends included.
  void line(int from_x, int from_y, int to_x, int to_y, core::Colour ink);
  // A triangle of `size` rows, its tip of one pixel at (x, y); it widens in the direction named.
  enum class Widens { up, down, left, right };
  void wedge(int x, int y, int size, Widens widens, core::Colour ink);
  // `y` is the upper edge of the letters' cells, scale * kGlyphRows high.
  void text(int x, int y, std::string_view utf8, const TextStyle& style);
  // From the bottom up, turned left by a right angle; (x, y) is the lower left corner, of the middle
  // or the upper corner by `align`.
  void upright_text(int x, int y, std::string_view utf8, const TextStyle& style);
  // Each pixel becomes `across` x `down` equal ones.
  void paste(const core::Picture8& picture, int left, int top, int across, int down);

 private:
  core::ColourPicture picture_;
};

}  // namespace fanbeam::session
