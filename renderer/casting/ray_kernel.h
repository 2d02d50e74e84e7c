// The work on one group of sub-columns: place, cast, refine, deposit. Private to the ray caster.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/interval_deposit.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_chain.h"
#include "renderer/casting/sampling.h"
#include "renderer/casting/sub_column.h"
#include "renderer/world.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// Where the rays of one pass over a fan lie beside those of the others.
struct RayPlaces {
  // The strip of every sub-column that the rays are spread over, as parts of its width. Neighbours
  // in elevation share an interval of ranges on the ground, so a narrow strip is a sharper cut.
  double strip_begin = 0.0, strip_width = 1.0;
  std::uint32_t dither_shift = 0;  // inside the strip, in parts of 2^32
  double first_elevation = 0.5;    // of each step, from its lower end, in sub-column 0

  double azimuth_place(std::uint32_t index, int sub_column) const {
    return strip_begin + strip_width * dither(index, sub_column, dither_shift);
  }
};

// What all groups of a frame share.
struct RayFrame {
  const World& world;
  const Sampling& sampling;
  const ElevationFan& fan;
  const sensors::AntennaFrame& antenna;
  const sensors::TwoWayTable& elevation_gain;
  const PathLossTable& path_loss;
  bool with_cscope = false;
  RayPlaces places{};
};

// Buffers of one thread, kept from group to group so that the ray loop does not allocate.
struct RayScratch {
  std::vector<double> edges;
  RayChain rays;
  std::vector<std::uint8_t> marks;
  std::vector<RayGap> gaps, halves;
  DepositBins bins;
  std::uint64_t ray_count = 0, hit_count = 0, blanked_count = 0;
};

// Casts sub-columns [4 group, 4 group + 4) and writes their part of `sums`, whatever it held. The
// packet size of `record` is the one used; when not null it receives a copy of every packet as it
// was sent.
void cast_group(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
                std::vector<terrain::RayPacket<8>>* record);
void cast_group(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
                std::vector<terrain::RayPacket<16>>* record);

}  // namespace fanbeam::renderer
