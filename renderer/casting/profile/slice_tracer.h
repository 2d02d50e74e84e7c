// Slices of one frame to power: each is swept once, and what it sees is deposited.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/sight_points.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/slice_power.h"
#include "renderer/casting/profile/slice_sweep.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

// What all slices of a frame share.
struct SliceFrame {
  const World& world;
  const sensors::AntennaFrame& antenna;
  const PowerTables& tables;
  const PathLossTable& path_loss;
  const std::vector<Slice>& slices;
  const EdgeIndex& edges;
  const PointsOfSlices& points;
  std::uint8_t* clear;  // SightLines
  std::size_t tile;     // slices that share their candidates
  double dark_below;    // tangent of the elevation at which the antenna's pattern begins
};

// For one thread at a time, and cheap to make: its buffers are the thread's.
class SliceTracer {
 public:
  explicit SliceTracer(const SliceFrame& frame);

  // Adds what slice `i` of the frame sees to `bins`.
  void cast(std::size_t i, const SliceBins& bins);

  std::uint64_t hits() const { return hits_; }
  std::uint64_t blanked() const { return power_.blanked(); }

 private:
  const SliceFrame& frame_;
  SlicePower power_;
  SliceSweep sweep_;
  std::uint64_t hits_ = 0;
};

}  // namespace fanbeam::renderer
