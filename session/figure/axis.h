// Scales beside a picture: where a value lies, which values get a tick, and how they are drawn.
#pragma once

#include <string>
#include <vector>

#include "session/figure/canvas.h"

namespace fanbeam::session {

// A linear scale over a row of pixels. `first` belongs to the outer edge of the first pixel, left or
// top, `last` to that of the last one; either may be the larger.
struct Axis {
  double first = 0.0, last = 1.0;
  int pixels = 1;
  std::string label{};
};

// The pixel that holds a value, counted from the first; -1 outside. The last edge belongs to the
// last pixel.
int pixel_of(const Axis& axis, double value);

// The least of 1, 2 and 5 times a power of ten that is no smaller; `value` above 0.
double rounded_up(double value);

// Such a step whose ticks are at least `spacing_px` apart.
double tick_step(const Axis& axis, int spacing_px);

struct Tick {
  double value = 0.0;
  int pixel = 0;
  std::string text;
};
// Multiples of tick_step inside the axis, in pixel order, with as many decimals as the step needs.
std::vector<Tick> ticks(const Axis& axis, int spacing_px);

struct AxisStyle {
  core::Colour ink{};
  int spacing_px = 40;
};
inline constexpr int kTick_px = 5;

// Below a picture; (left, top) is the scale's upper left corner. The label stands below its left
// end: the middle is free for what lies ahead. 37 rows in all.
void draw_axis_below(Canvas& canvas, const Axis& axis, int left, int top, const AxisStyle& style);
// Left of a picture, ending at column `right`; the label stands upright, `width` columns away.
void draw_axis_left(Canvas& canvas, const Axis& axis, int right, int top, int width,
                    const AxisStyle& style);
// Right of a picture, beginning at column `left`; no label.
void draw_axis_right(Canvas& canvas, const Axis& axis, int left, int top, const AxisStyle& style);

}  // namespace fanbeam::session
