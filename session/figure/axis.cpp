#include "session/figure/axis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "session/figure/font.h"

namespace fanbeam::session {
namespace {

// A value that rounding has put beside an edge still belongs to it.
constexpr double kRounding_px = 1e-6;

double place_px(const Axis& axis, double value) {
  return (value - axis.first) / (axis.last - axis.first) * axis.pixels;
}

}  // namespace

int pixel_of(const Axis& axis, double value) {
  const double place = place_px(axis, value);
  if (!(place >= -kRounding_px && place <= axis.pixels + kRounding_px)) return -1;
  return std::clamp(static_cast<int>(std::floor(place + kRounding_px)), 0, axis.pixels - 1);
}

double rounded_up(double value) {
  double power = 1.0;
  while (power > value) power /= 10.0;
  while (power * 10.0 <= value) power *= 10.0;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

double tick_step(const Axis& axis, int spacing_px) {
  return rounded_up(std::abs(axis.last - axis.first) / axis.pixels * spacing_px);
}

std::vector<Tick> ticks(const Axis& axis, int spacing_px) {
  const double step = tick_step(axis, spacing_px);
  int decimals = 0;
  for (double unit = step; unit < 1.0 - 1e-9 && decimals < 9; unit *= 10.0) ++decimals;
  const double low = std::min(axis.first, axis.last), high = std::max(axis.first, axis.last);
  std::vector<Tick> found;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1.0) {
    const double value = k * step + 0.0;
    found.push_back({value, pixel_of(axis, value), fmt::format("{:.{}f}", value, decimals)});
  }
  std::sort(found.begin(), found.end(),
            [](const Tick& a, const Tick& b) { return a.pixel < b.pixel; });
  return found;
}

void draw_axis_below(Canvas& canvas, const Axis& axis, int left, int top, const AxisStyle& style) {
  for (const Tick& tick : ticks(axis, style.spacing_px)) {
    canvas.fill({left + tick.pixel, top, 1, kTick_px}, style.ink);
    canvas.text(left + tick.pixel + 1, top + kTick_px + 2, tick.text, {style.ink, Align::middle});
  }
  canvas.text(left, top + kTick_px + kGlyphRows + 6, axis.label, {style.ink});
}

void draw_axis_left(Canvas& canvas, const Axis& axis, int right, int top, int width,
                    const AxisStyle& style) {
  for (const Tick& tick : ticks(axis, style.spacing_px)) {
    canvas.fill({right - kTick_px, top + tick.pixel, kTick_px, 1}, style.ink);
    canvas.text(right - kTick_px - 3, top + tick.pixel - kGlyphRows / 2, tick.text,
                {style.ink, Align::right});
  }
  canvas.upright_text(right - width, top + axis.pixels / 2, axis.label, {style.ink, Align::middle});
}

void draw_axis_right(Canvas& canvas, const Axis& axis, int left, int top, const AxisStyle& style) {
  for (const Tick& tick : ticks(axis, style.spacing_px)) {
    canvas.fill({left, top + tick.pixel, kTick_px, 1}, style.ink);
    canvas.text(left + kTick_px + 3, top + tick.pixel - kGlyphRows / 2, tick.text, {style.ink});
  }
}

}  // namespace fanbeam::session
