// How samples become maps and detections.
#pragma once

#include <optional>

#include "signal/angle/source_directions.h"
#include "signal/detection/cfar_factor.h"
#include "signal/fourier/window.h"
#include "signal/receiver/mitigation.h"

namespace fanbeam::session {

// Cells to either side of the one that is judged.
struct CellSpan {
  int range = 0, doppler = 0;  // 0 to 64 each
};

struct ProcessingSettings {
  // Echoes of a street span more than the 35 dB of the usual Taylor window.
  signal::Window range_window{
      .kind = signal::WindowKind::chebyshev, .level_dB = 60.0, .symmetric = true};
  signal::Window doppler_window{
      .kind = signal::WindowKind::chebyshev, .level_dB = 60.0, .symmetric = true};
  signal::Window angle_window{.kind = signal::WindowKind::taylor, .symmetric = true};
  signal::Mitigation mitigation = signal::Mitigation::none;  // of other radars' chirps
  double mitigation_threshold =
      signal::kCrossedOverMedian;  // over the median of a chirp; above 1 to 1e6
  signal::CfarKind cfar = signal::CfarKind::ordered_statistic;
  CellSpan cfar_guard{2, 2};
  CellSpan cfar_training{4, 2};           // beyond the guard cells; not 0 in both
  double false_alarm_probability = 1e-6;  // of a cell, 1e-12 to 0.1
  signal::AngleMethod angle_method = signal::AngleMethod::beamforming;
  // Distances within which detections are neighbours; missing: four widths between half powers.
  std::optional<double> cluster_place_m;    // above 0 to 1000
  std::optional<double> cluster_speed_mps;  // above 0 to 1000
  int cluster_neighbours = 2;  // a detection with as many, itself included, is a core; 1 to 100
  bool unfold = false;         // speeds of detections, by transmitters that take turns
  std::optional<double> most_range_m;  // of the maps; missing: the sensor's, or all there is
};

}  // namespace fanbeam::session
