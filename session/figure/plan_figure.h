// The product "ppi_figure": the track-up plan view of a frame as product ppi writes it, with scales
// in lengths right of and ahead of the antenna, the grey scale in dB, and the text of frame_figure.h.
#pragma once

#include "core/colour_picture.h"
#include "sensors/display/ppi.h"
#include "session/figure/canvas.h"
#include "session/figure/figure_facts.h"

namespace fanbeam::session {

struct PlanFigureLayout {
  int columns = 0, rows = 0;  // even
  Box ppi, bar;               // each pixel of the plan view is one of the figure
};
PlanFigureLayout plan_figure_layout(const sensors::PpiView& view);

core::ColourPicture plan_figure(const sensors::Sensor& sensor, const FigureFacts& facts,
                                const sensors::PpiView& view, const core::Picture8& ppi);

}  // namespace fanbeam::session
