// The rays of ground truth: what every azimuth of some columns meets, from the lowest up. Private
// to the layers.
#pragma once

#include <array>
#include <vector>

#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_line.h"
#include "renderer/stages/layer_hit.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

inline constexpr int kBlockColumns = 8;  // that one call casts, at most
inline constexpr int kBlockLines = kBlockColumns * kLayerAzimuths;

// Of one azimuth: as many as were cast, each with the strip that it stands for.
using LayerLine = std::vector<LayerHit>;

class LayerLines {
 public:
  LayerLines(const World& world, const sensors::AntennaFrame& antenna);

  // Columns [first, last): their azimuths one after the other, from the left. Those of columns that
  // are not marked may stay empty.
  void cast(int first, int last, const std::vector<std::uint8_t>& marked,
            std::array<LayerLine, kBlockLines>& lines) const;

  // Whether two neighbours on one surface own the range cells that they step over.
  bool one_slope(const LayerHit& a, const LayerHit& b) const;
  bool is_ground(const LayerHit& hit) const;

 private:
  // A ray that is wanted, and what it met.
  struct Wish {
    int line;
    std::size_t behind;  // of the line's hits
    double elevation_rad;
    LayerHit hit;
  };
  struct Block {
    int first_line = 0;
    std::array<SubColumn, kBlockLines> azimuths;
    std::vector<double> edges;
    std::vector<Wish> wishes;
  };
  void look(int line, int count, RayLine& rays, Block& block,
            std::array<LayerLine, kBlockLines>& lines) const;
  void look_between(int count, RayLine& rays, Block& block,
                    std::array<LayerLine, kBlockLines>& lines) const;
  bool untold(const LayerHit& a, const LayerHit& b) const;
  void see(const RayBatch& batch, const RayChain& chain, int lane, LayerHit& hit) const;
  int cell_of(double range_m) const;
  int row_of(double elevation_rad) const;

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  ElevationFan fan_;
  sensors::TwoWayTable elevation_gain_;
  PathLossTable path_loss_;
  double beam_rad_, row_rad_;
};

}  // namespace fanbeam::renderer
