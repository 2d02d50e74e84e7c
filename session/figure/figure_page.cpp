#include "session/figure/figure_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/units.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::session {

using namespace figure_style;

namespace {

constexpr core::Colour kBackground{18, 20, 24};

// Seen from above, nose up.
constexpr const char* kAircraftShape[] = {
    "       #       ", "       #       ", "      ###      ", "      ###      ", "      ###      ",
    "   #########   ", "###############", "###   ###   ###", "      ###      ", "      ###      ",
    "       #       ", "     #####     ", "    #######    ", "       #       "};

constexpr int kTriangle_px = 8;

const char* level_name(sensors::Display::Mapping mapping) {
  using Mapping = sensors::Display::Mapping;
  if (mapping == Mapping::stc) return "NRCS of flat ground, dB";
  return mapping == Mapping::log ? "received power, dBW" : "B-scope: received power, dBW";
}

std::string direction_text(double angle_rad, const char* positive, const char* negative) {
  const double tenths = std::round(core::degrees(angle_rad) * 10.0);
  return fmt::format("{:.1f}\u00b0 {}", std::abs(tenths) / 10.0,
                     tenths < 0.0 ? negative : positive);
}

std::string runway_text(const RunwayView& runway, const RangeUnit& unit) {
  const SeenPoint& at = runway.threshold;
  const std::string away = length_text(at.range_m, unit);
  if (!runway.threshold_ahead) return away + " behind";
  return away + ", " + direction_text(at.azimuth_rad, "right", "left") + ", " +
         direction_text(at.elevation_rad, "up", "down");
}

}  // namespace

Axis level_axis(const sensors::Sensor& sensor, int pixels) {
  const sensors::GreyScale grey(sensor);
  return {grey.high_dB(), grey.low_dB(), pixels, level_name(sensor.display.mapping)};
}

FigurePage::FigurePage(const FigureFacts& facts, int columns, int rows)
    : facts_(facts), canvas_(columns, rows, kBackground) {}

void FigurePage::draw_header() {
  const int room = canvas_.columns() - 2 * kMargin;
  const int scale = text_width(facts_.title, 2) <= room ? 2 : 1;
  canvas_.text(kMargin, kMargin + (2 - scale) * kGlyphRows / 2,
               shortened(facts_.title, room / scale), {kInk, Align::left, scale, true});
  const int y = kMargin + 2 * kGlyphRows + 10;
  const std::string frame = "frame " + facts_.frame + "   " + facts_.time;
  canvas_.text(canvas_.columns() - kMargin, y, frame, {kInk, Align::right});
  const int rest = room - text_width(frame) - 3 * kGlyphColumns;
  canvas_.text(kMargin, y, shortened(facts_.scene + "   " + facts_.sensor, rest), {kDim});
}

int FigurePage::draw_column(int left,
                            const std::vector<std::pair<std::string, std::string>>& lines) {
  int names = 0, values = 0;
  for (const auto& [name, value] : lines) {
    names = std::max(names, text_width(name) + 2 * kGlyphColumns);
    values = std::max(values, text_width(value));
  }
  int y = canvas_.rows() - kMargin - kTextLines * kLine;
  for (const auto& [name, value] : lines) {
    canvas_.text(left, y, name, {kDim});
    canvas_.text(left + names, y, value, {kInk});
    y += kLine;
  }
  return left + names + values + 4 * kGlyphColumns;
}

void FigurePage::draw_text() {
  draw_header();
  int left = draw_column(
      kMargin, {{"position", facts_.position}, {"height", facts_.height}, {"speed", facts_.speed}});
  left = draw_column(left,
                     {{"heading", facts_.heading}, {"pitch", facts_.pitch}, {"roll", facts_.roll}});
  std::vector<std::pair<std::string, std::string>> runways;
  for (const RunwayView& runway : facts_.runways) {
    if (runways.size() == kTextLines) break;
    runways.emplace_back("threshold " + shortened(runway.name, 8 * kGlyphColumns),
                         runway_text(runway, facts_.unit));
  }
  draw_column(left, runways);
}

void FigurePage::draw_scope(const core::Picture8& picture, const Box& box, const char* name,
                            const char* what, const Axis& across, const Axis& upward) {
  canvas_.paste(picture, box.left, box.top, box.columns / picture.columns, box.rows / picture.rows);
  canvas_.frame(box, kDim);
  const int y = box.top - kAbove;
  canvas_.text(box.left, y, name, {kInk, Align::left, 1, true});
  canvas_.text(box.left + text_width(name) + 2 * kGlyphColumns, y, what, {kDim});
  draw_axis_below(canvas_, across, box.left, box.bottom() + 1, {kInk, 40});
  draw_axis_left(canvas_, upward, box.left - 1, box.top, kLeftScale - 6, {kInk, 40});
}

void FigurePage::draw_bar(const Box& bar, const Axis& level_dB) {
  for (int row = 0; row < bar.rows; ++row) {
    // Of the row's middle, rounded.
    const int twice = 2 * (bar.rows - row) - 1;
    const auto grey = static_cast<std::uint8_t>((255 * twice + bar.rows) / (2 * bar.rows));
    canvas_.fill({bar.left, bar.top + row, bar.columns, 1}, {grey, grey, grey});
  }
  canvas_.frame(bar, kDim);
  draw_axis_right(canvas_, level_dB, bar.right() + 1, bar.top, {kInk, 40});
  canvas_.upright_text(bar.right() + kBarScale - kGlyphRows, bar.top + bar.rows / 2, level_dB.label,
                       {kInk, Align::middle});
}

void FigurePage::draw_own_ship(const Box& scope, int x) {
  constexpr int kHalf = 7;
  const int top = scope.bottom() + kTick_px + kGlyphRows + 6;
  if (!facts_.aircraft)
    return canvas_.wedge(x, top + 2, kTriangle_px, Canvas::Widens::down, kAircraft);
  for (int row = 0; row < static_cast<int>(std::size(kAircraftShape)); ++row)
    for (int column = 0; kAircraftShape[row][column] != '\0'; ++column)
      if (kAircraftShape[row][column] == '#') canvas_.set(x - kHalf + column, top + row, kAircraft);
}

}  // namespace fanbeam::session
