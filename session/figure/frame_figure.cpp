#include "session/figure/frame_figure.h"

#include <algorithm>

#include "core/units.h"
#include "session/figure/figure_page.h"

namespace fanbeam::session {

using namespace figure_style;

namespace {

constexpr int kLeastScope = 300, kLeastRows = 240;
constexpr int kWantedColumns = 380, kWantedRows = 600, kMostBlock = 8;

int even(int pixels) { return pixels + pixels % 2; }

int block(int wanted, int cells) { return std::clamp(wanted / cells, 1, kMostBlock); }

const char* cscope_name(sensors::Display::CScopeMode mode) {
  using Mode = sensors::Display::CScopeMode;
  if (mode == Mode::true_elevation) return "true elevation (ground truth)";
  return mode == Mode::flat_earth ? "elevation of flat ground" : "heights from shadows";
}

double azimuth_deg(const SeenPoint& point) { return core::degrees(point.azimuth_rad); }
double elevation_deg(const SeenPoint& point) { return core::degrees(point.elevation_rad); }
double above_level_deg(const SeenPoint& point) { return core::degrees(point.above_level_rad); }

void mark_bscope(Canvas& canvas, const Box& scope, const FigureScales& scales,
                 const FigureFacts& facts) {
  std::vector<Mark> above, right;
  for (const RunwayView& runway : facts.runways) {
    const auto azimuth = runway_mark(runway, scales.azimuth_deg, azimuth_deg);
    const auto range = runway_mark(runway, scales.range, [&](const SeenPoint& point) {
      return point.range_m / facts.unit.metres;
    });
    if (azimuth) above.push_back(*azimuth);
    if (range) right.push_back(*range);
  }
  draw_marks_above(canvas, scope, above);
  draw_marks_right(canvas, scope, right);
}

void mark_cscope(Canvas& canvas, const Box& scope, const FigureScales& scales,
                 const FigureFacts& facts, const sensors::Sensor& sensor) {
  // A picture drawn from ranges alone knows no tilt of the antenna.
  const bool level = sensor.display.cscope_mode != sensors::Display::CScopeMode::true_elevation;
  std::vector<Mark> above, right;
  for (const RunwayView& runway : facts.runways) {
    const auto azimuth = runway_mark(runway, scales.azimuth_deg, azimuth_deg);
    const auto elevation =
        runway_mark(runway, scales.elevation_deg, level ? above_level_deg : elevation_deg);
    if (!elevation || !azimuth) continue;  // above or below the window
    above.push_back(*azimuth);
    right.push_back(*elevation);
  }
  const auto mark_at = [&](double angle_rad, const char* text, const core::Colour& ink) {
    const int pixel = pixel_of(scales.elevation_deg, core::degrees(angle_rad));
    if (pixel >= 0) right.push_back({pixel, pixel, pixel, text, ink});
  };
  mark_at(level ? 0.0 : facts.horizon_right_rad, "horizon", kHorizon);
  mark_at(level ? facts.boresight_above_level_rad : sensor.antenna.boresight_elevation_rad,
          "boresight", kInk);
  draw_marks_above(canvas, scope, above);
  draw_marks_right(canvas, scope, right);
  const int left =
      pixel_of(scales.elevation_deg, level ? 0.0 : core::degrees(facts.horizon_left_rad));
  if (left >= 0) draw_wedge_left(canvas, scope, left, kHorizon);
}

}  // namespace

FigureLayout figure_layout(const sensors::Sensor& sensor) {
  const int columns = sensor.scan.columns * block(kWantedColumns, sensor.scan.columns);
  const int slot = std::max(columns, kLeastScope);
  const int cscope_rows = sensor.display.cscope_rows;
  FigureLayout layout;
  layout.bscope = {kMargin + kLeftScale, kHeader + kAbove, columns,
                   sensor.range.cells * block(kWantedRows, sensor.range.cells)};
  layout.cscope = {layout.bscope.left + slot + kRightMarks + kLeftScale, layout.bscope.top, columns,
                   cscope_rows * block(kWantedRows, cscope_rows)};
  const int rows = std::max({layout.bscope.rows, layout.cscope.rows, kLeastRows});
  layout.bar = {layout.cscope.left + slot + kRightMarks, layout.bscope.top, kBar, rows};
  layout.columns = even(layout.bar.right() + kBarScale + kMargin);
  layout.rows = even(layout.bscope.top + rows + kBelow);
  return layout;
}

FigureScales figure_scales(const sensors::Sensor& sensor, const RangeUnit& unit) {
  const FigureLayout layout = figure_layout(sensor);
  const double half_deg = 0.5 * core::degrees(sensor.scan.field_of_view_rad);
  const double top_deg = core::degrees(sensor.display.cscope_top_rad);
  const double bottom_deg = top_deg - core::degrees(sensor.display.cscope_span_rad);
  return {{-half_deg, half_deg, layout.bscope.columns, "azimuth, deg"},
          {sensor.range.maximum_m() / unit.metres, sensor.range.minimum_m / unit.metres,
           layout.bscope.rows, std::string("range, ") + unit.name},
          {top_deg, bottom_deg, layout.cscope.rows, "elevation, deg"},
          level_axis(sensor, layout.bar.rows)};
}

core::ColourPicture frame_figure(const sensors::Sensor& sensor, const FigureFacts& facts,
                                 const core::Picture8& bscope, const core::Picture8& cscope) {
  const FigureLayout layout = figure_layout(sensor);
  const FigureScales scales = figure_scales(sensor, facts.unit);
  FigurePage page(facts, layout.columns, layout.rows);
  page.draw_text();
  page.draw_scope(bscope, layout.bscope, "B-scope", "range over azimuth", scales.azimuth_deg,
                  scales.range);
  page.draw_scope(cscope, layout.cscope, "C-scope", cscope_name(sensor.display.cscope_mode),
                  scales.azimuth_deg, scales.elevation_deg);
  page.draw_bar(layout.bar, scales.level_dB);
  page.draw_own_ship(layout.bscope, layout.bscope.left + pixel_of(scales.azimuth_deg, 0.0));
  mark_bscope(page.canvas(), layout.bscope, scales, facts);
  mark_cscope(page.canvas(), layout.cscope, scales, facts, sensor);
  return page.canvas().picture();
}

}  // namespace fanbeam::session
