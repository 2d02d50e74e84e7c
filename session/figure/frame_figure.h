// The product "figure": the B-scope and the C-scope of a frame side by side, as `fanbeam render`
// writes them, with scales, the grey scale in dB, and what the picture was taken of.
//
// Every pixel of a scope becomes a block of equal pixels, and nothing is drawn over it: marks stand
// in the margins. The figure has one size per sensor.
#pragma once

#include "core/colour_picture.h"
#include "sensors/sensor.h"
#include "session/figure/axis.h"
#include "session/figure/canvas.h"
#include "session/figure/figure_facts.h"

namespace fanbeam::session {

// Where things lie in the figure. A scope's cells are bscope.columns / scan.columns pixels wide and
// bscope.rows / range.cells high (of the C-scope: cscope.rows / display.cscope_rows).
struct FigureLayout {
  int columns = 0, rows = 0;  // even, as films ask for
  Box bscope, cscope, bar;
};
FigureLayout figure_layout(const sensors::Sensor& sensor);

// The scales around the scopes: azimuth in degrees, range in a unit (the farthest first), elevation
// in degrees (the highest first), level in dB (the highest first).
struct FigureScales {
  Axis azimuth_deg, range, elevation_deg, level_dB;
};
FigureScales figure_scales(const sensors::Sensor& sensor, const RangeUnit& unit);

core::ColourPicture frame_figure(const sensors::Sensor& sensor, const FigureFacts& facts,
                                 const core::Picture8& bscope, const core::Picture8& cscope);

}  // namespace fanbeam::session
