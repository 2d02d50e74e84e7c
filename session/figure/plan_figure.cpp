#include "session/figure/plan_figure.h"

#include <algorithm>
#include <cmath>

#include "session/figure/figure_page.h"

namespace fanbeam::session {

using namespace figure_style;

PlanFigureLayout plan_figure_layout(const sensors::PpiView& view) {
  PlanFigureLayout layout;
  layout.ppi = {kMargin + kLeftScale, kHeader + kAbove, view.columns, view.rows};
  layout.bar = {layout.ppi.right() + kRightMarks, layout.ppi.top, kBar, view.rows};
  layout.columns = std::max(kLeastColumns, layout.bar.right() + kBarScale + kMargin);
  layout.rows = layout.ppi.bottom() + kBelow;
  layout.columns += layout.columns % 2;
  layout.rows += layout.rows % 2;
  return layout;
}

core::ColourPicture plan_figure(const sensors::Sensor& sensor, const FigureFacts& facts,
                                const sensors::PpiView& view, const core::Picture8& ppi) {
  const PlanFigureLayout layout = plan_figure_layout(view);
  const double pixel = view.metres_per_pixel / facts.unit.metres;
  const std::string unit = facts.unit.name;
  const Axis right{-view.antenna_column * pixel, (view.columns - view.antenna_column) * pixel,
                   view.columns, "right of the antenna, " + unit};
  const Axis ahead{view.antenna_row * pixel, (view.antenna_row - view.rows) * pixel, view.rows,
                   "ahead of the antenna, " + unit};
  FigurePage page(facts, layout.columns, layout.rows);
  page.draw_text();
  page.draw_scope(ppi, layout.ppi, "Plan view", "slant range drawn as distance, track up", right,
                  ahead);
  page.draw_bar(layout.bar, level_axis(sensor, layout.bar.rows));
  page.draw_own_ship(layout.ppi, layout.ppi.left + pixel_of(right, 0.0));
  std::vector<Mark> above, beside;
  for (const RunwayView& runway : facts.runways) {
    const auto across = runway_mark(runway, right, [&](const SeenPoint& point) {
      return point.range_m * std::sin(point.azimuth_rad) / facts.unit.metres;
    });
    const auto forward = runway_mark(runway, ahead, [&](const SeenPoint& point) {
      return point.range_m * std::cos(point.azimuth_rad) / facts.unit.metres;
    });
    if (across) above.push_back(*across);
    if (forward) beside.push_back(*forward);
  }
  draw_marks_above(page.canvas(), layout.ppi, above);
  draw_marks_right(page.canvas(), layout.ppi, beside);
  return page.canvas().picture();
}

}  // namespace fanbeam::session
