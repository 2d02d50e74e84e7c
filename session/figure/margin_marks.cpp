#include "session/figure/margin_marks.h"

#include <algorithm>

#include "session/figure/font.h"

namespace fanbeam::session {
namespace {

constexpr int kGap = 2, kWedge = 5, kBarWidth = 2, kToText = 9;

// Bars side by side, where they may overlap along the picture.
int bar_offset(std::size_t i) { return static_cast<int>(i % 3) * (kBarWidth + 1); }

// Places of texts `size` long around wanted middles in rising order: as near as they may be to them
// without overlapping or leaving `room` pixels.
std::vector<int> spread_texts(const std::vector<int>& middles, const std::vector<int>& sizes,
                              int room) {
  std::vector<int> begins(middles.size());
  int free = 0;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    begins[i] = std::max(free, middles[i] - sizes[i] / 2);
    free = begins[i] + sizes[i];
  }
  int end = room;
  for (std::size_t i = middles.size(); i-- > 0;) {
    begins[i] = std::min(begins[i], end - sizes[i]);
    end = begins[i];
  }
  return begins;
}

template <class Size>
std::vector<int> places(std::vector<Mark>& marks, int room, const Size& size) {
  std::stable_sort(marks.begin(), marks.end(),
                   [](const Mark& a, const Mark& b) { return a.tip < b.tip; });
  std::vector<int> middles, sizes;
  for (const Mark& mark : marks) {
    middles.push_back(mark.tip);
    sizes.push_back(size(mark));
  }
  return spread_texts(middles, sizes, room);
}

}  // namespace

void draw_marks_above(Canvas& canvas, const Box& picture, std::vector<Mark> marks) {
  const std::vector<int> begins = places(marks, picture.columns, [](const Mark& mark) {
    return text_width(mark.text) + kGlyphColumns;
  });
  const int tip_y = picture.top - 1 - kGap;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Mark& mark = marks[i];
    if (mark.from < mark.to)
      canvas.fill({picture.left + mark.from, tip_y - bar_offset(i) - kBarWidth,
                   mark.to - mark.from + 1, kBarWidth},
                  mark.ink);
    canvas.wedge(picture.left + mark.tip, tip_y, kWedge, Canvas::Widens::up, mark.ink);
    canvas.text(picture.left + begins[i] + kGlyphColumns / 2, tip_y - kWedge - kGlyphRows,
                mark.text, {mark.ink});
  }
}

void draw_marks_right(Canvas& canvas, const Box& picture, std::vector<Mark> marks) {
  const std::vector<int> begins =
      places(marks, picture.rows, [](const Mark&) { return kGlyphRows; });
  const int tip_x = picture.right() + kGap;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Mark& mark = marks[i];
    const int y = picture.top + mark.tip;
    if (mark.from < mark.to)
      canvas.fill(
          {tip_x + 1 + bar_offset(i), picture.top + mark.from, kBarWidth, mark.to - mark.from + 1},
          mark.ink);
    canvas.wedge(tip_x, y, kWedge, Canvas::Widens::right, mark.ink);
    const int text_y = picture.top + begins[i];
    canvas.line(tip_x + kWedge, y, tip_x + kToText - 1, text_y + kGlyphRows / 2, mark.ink);
    canvas.text(tip_x + kToText + 2, text_y, mark.text, {mark.ink});
  }
}

void draw_wedge_left(Canvas& canvas, const Box& picture, int tip, core::Colour ink) {
  canvas.wedge(picture.left - 1 - kGap, picture.top + tip, kWedge, Canvas::Widens::left, ink);
}

}  // namespace fanbeam::session
