// Product "spectrogram": how the speeds at a place change from frame to frame, micro-Doppler.
//
// A column a frame: of its range-Doppler map (sum over channels) the largest power of every Doppler cell over
// the range cells about a target of the scene, or over all. What moves within a body shows as lines about
// that of the body: the legs of a pedestrian swing from standing to twice the walking speed.
// Neglected: what happens within a frame, whose length is that of its chirps (5 to 15 ms).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/plots/heat_map.h"
#include "session/signal/chain.h"

namespace fanbeam::session {

class Spectrogram {
 public:
  // `target`: name or beginning of the names of targets; empty for all ranges.
  Spectrogram(const FmcwRadar& radar, std::string target)
      : radar_(radar), target_(std::move(target)) {}

  // Where no such target is seen the column is empty.
  void add(double time_s, const FmcwFrame& frame, const std::vector<double>& target_ranges_m);
  const std::string& target() const { return target_; }
  int columns() const { return static_cast<int>(columns_W_.size()); }

  // Row 0 the fastest closing; column after column. At least one column.
  signal::PowerMap powers() const;
  HeatMap picture(const std::string& scene, double dynamic_range_dB) const;

 private:
  const FmcwRadar& radar_;
  std::string target_;
  std::vector<double> times_s_;
  std::vector<std::vector<double>> columns_W_;
};

}  // namespace fanbeam::session
