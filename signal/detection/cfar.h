// Constant false-alarm rate detection on a map of powers, along a line or in a rectangle.
//
// Around each cell lie guard cells, which the target may reach, and then reference cells that tell
// the background. The window reaches `guard + reference` cells to either side along columns (range)
// and rows (Doppler or angle); a reach of 0 along an axis makes the detector one-dimensional. In
// two dimensions the reference is the rectangle without the inner rectangle of guard cells. For the
// detectors of two halves, the halves are the cells nearer and farther in range (columns), those of the
// cell's own range by their row: a step of clutter in range lies in one of them. A cell is reported when power > factor x estimate, with the factor of
// signal/detection/cfar_factor.h for the reference cells that exist: at an edge these are fewer, or
// the window goes on at the other end where the axis wraps (Doppler). The ordered statistic keeps
// its rank's fraction of N, rounded to the nearest and at least 1. Where less than a quarter of one
// half is left, the other one alone is averaged. A cell without any reference cell is never reported.
//
// `design_probability` is that of independent reference cells. Windows and padding correlate cells;
// with signal/detection/cfar_calibration.h it becomes the one that gives the wanted rate.
//
// Inputs: `mean_estimate` above 0; finite powers, 0 or more (E-NONFINITE, E-RANGE otherwise). Any
// scale; equal cells and zeros give no detection as long as the factor is above 1. Neglected: steps
// of the background inside the window (use `greatest_of`) and targets inside it (use
// `ordered_statistic`). Cost: N operations per cell (N for the ordered statistic too, by selection);
// rows run on the loop of core/parallel.h.
#pragma once

#include <vector>

#include "signal/detection/cfar_factor.h"
#include "signal/transform/cube_maps.h"

namespace fanbeam::signal {

struct CfarReach {
  int guard = 2;      // on each side
  int reference = 8;  // beyond the guard cells, on each side
  bool wraps = false;
  bool operator==(const CfarReach&) const = default;
};

struct CfarSettings {
  CfarKind kind = CfarKind::cell_averaging;
  double design_probability = 1e-4;
  CfarReach along_columns = {};                                        // range
  CfarReach along_rows = {.guard = 0, .reference = 0, .wraps = true};  // Doppler or angle
  double rank_fraction = 0.75;  // ordered statistic, in (0, 1]
  // What the estimate is on average over the mean noise: the 75 % quantile of one look lies 1.4 dB
  // above it. Told by the calibration too.
  double mean_estimate = 1.0;
  bool operator==(const CfarSettings&) const = default;
};

struct CfarCell {
  int row = 0;
  int column = 0;
  double power_W = 0.0;
  double background_W = 0.0;  // the mean that the estimate tells of, without the factor
  // Power over threshold, above 1; infinite over an empty background.
  double margin = 0.0;
};

// In the order of the map.
std::vector<CfarCell> cfar_detections(const PowerMap& map, const CfarSettings& settings);

// What the detector uses for a cell far from the edges.
CfarReference cfar_reference(const CfarSettings& settings);

}  // namespace fanbeam::signal
