// Range response: the receiver spreads every echo along range by the point response of its sweep.
//
//     P'(row) = sum over rows k away of K_|k| P(row - k) ,
//     K_k = integral over u in [-1, 1] of (1 - |u|) h((k + u) cell) cell du
// with h the normalised point response (sensors/receiver/point_response.h): the power in a cell is
// taken as spread evenly across it, and K_k is what of it falls into the cell k away. The K of all
// k add up to 1, so power is conserved except for what leaves the range gate at its ends.
//
// Neglected: where in its cell a scatterer stands (a point target shows K, the mean over its
// places; scalloping is at most 3.9 dB for a rectangular window); correlation of speckle between
// cells; power that enters the gate from ranges outside it; the C-scope, whose sum over range keeps
// its power.
// Accuracy: Gauss-Legendre, 8 points per half bin, 1e-12 of the total; K ends where less than 1e-13
// is left. Cost: cells^2 x columns multiply-adds for windows with slow side lobes: 45 million, 10 ms
// for HiVision.
//
// Bound, dB. An echo keeps at least K_0 in its own cell, and fills the cells around it; with E the
// largest echo in each range cell of what the scene holds (largest_echo.h)
//     max(-10 log10 K_0, change of a pixel by sum over k away from 0 of K_|k| E(row - k))
// (display_floor.h), at most the window; the whole window where double bounce is possible. Where a bin
// is about a cell, K_1 is above 10 % and the effect always runs.
#pragma once

#include <vector>

#include "renderer/plan/scene_facts.h"
#include "renderer/stages/fluctuation.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

class RangeResponse {
 public:
  // The sensor must have a point response: sensors::has_point_response.
  explicit RangeResponse(const sensors::Sensor& sensor);

  // `image` [cell][column], in place. The same for any thread count.
  void apply(std::vector<double>& image) const;

  // Targets whose echoes are drawn one by one: what each gives to the cells around its own. Shares
  // below 1e-4 of an echo are too many to draw; they join the diffuse power in `image`.
  std::vector<TargetShare> spread(const std::vector<TargetShare>& targets,
                                  std::vector<double>& image) const;

  // K_0, K_1, ... of a column, as far as the gate is long.
  const std::vector<double>& shares(int column) const;

 private:
  int columns_ = 0;
  int cells_ = 0;
  std::vector<std::vector<double>> shares_;  // one for all columns, or one each
};

// Upper bound of `cell_W` [cell], in any column, whether the response runs or not.
std::vector<double> largest_spread(const sensors::Sensor& sensor, std::vector<double> cell_W);

bool has_range_response(const SceneFacts& facts);
double range_response_bound_dB(const SceneFacts& facts);

}  // namespace fanbeam::renderer
