// What the figures of a frame share: header, one scope with its scales, the grey scale, own ship and
// the text below. A figure is columns of these on a page.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sensors/sensor.h"
#include "session/figure/axis.h"
#include "session/figure/canvas.h"
#include "session/figure/figure_facts.h"
#include "session/figure/font.h"
#include "session/figure/margin_marks.h"

namespace fanbeam::session {

namespace figure_style {
inline constexpr core::Colour kInk{226, 230, 234}, kDim{136, 146, 156}, kRunway{90, 205, 255},
    kHorizon{255, 186, 60}, kAircraft{120, 235, 130};
inline constexpr int kMargin = 20, kLine = kGlyphRows + 5;
inline constexpr int kHeader = kMargin + 2 * kGlyphRows + 10 + kLine + 14;  // title and a line
inline constexpr int kAbove = kLine + kMarkRows + 2;                        // a scope: name, marks
inline constexpr int kLeftScale = 62, kRightMarks = 84, kBar = 18, kBarScale = 66;
inline constexpr int kTextLines = 3;
inline constexpr int kBelow = 58 + kTextLines * kLine + kMargin;  // the scopes
inline constexpr int kLeastColumns = 860;                         // that hold the text
}  // namespace figure_style

// Grey levels in dB along a bar, the highest first.
Axis level_axis(const sensors::Sensor& sensor, int pixels);

// Where a runway lies along a scale; the wedge points at its nearest point. Nothing where the scale
// holds no point of it.
template <class Value>
std::optional<Mark> runway_mark(const RunwayView& runway, const Axis& scale, const Value& value) {
  std::optional<Mark> mark;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const SeenPoint& point : runway.seen) {
    const int pixel = pixel_of(scale, value(point));
    if (pixel < 0) continue;
    if (!mark) mark = Mark{pixel, pixel, pixel, runway.name, figure_style::kRunway};
    if (point.range_m < nearest_m) {
      mark->tip = pixel;
      nearest_m = point.range_m;
    }
    mark->from = std::min(mark->from, pixel);
    mark->to = std::max(mark->to, pixel);
  }
  return mark;
}

class FigurePage {
 public:
  // `facts` must outlive the page.
  FigurePage(const FigureFacts& facts, int columns, int rows);

  Canvas& canvas() { return canvas_; }

  // Title, scene, sensor, frame and time on top; position, attitude and runways at the bottom.
  void draw_text();
  // The picture with a thin frame, its name, a scale below and one on the left.
  void draw_scope(const core::Picture8& picture, const Box& box, const char* name, const char* what,
                  const Axis& across, const Axis& upward);
  void draw_bar(const Box& bar, const Axis& level_dB);
  // Below a scope, its nose up at column `x`: an aircraft, or a triangle where the facts name none.
  void draw_own_ship(const Box& scope, int x);

 private:
  void draw_header();
  // Returns where the next column of text begins.
  int draw_column(int left, const std::vector<std::pair<std::string, std::string>>& lines);

  const FigureFacts& facts_;
  Canvas canvas_;
};

}  // namespace fanbeam::session
