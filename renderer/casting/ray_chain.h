// The rays of a group of sub-columns after their cast, in order of elevation.
//
// The fan is stored row by row, all azimuths of a step in elevation side by side, as it is cast.
// Rays that refinement puts between two others go to the end and are linked in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/fan_layout.h"
#include "terrain/height_field.h"

namespace fanbeam::renderer {

// Two neighbours of one sub-column between which a ray is wanted.
struct RayGap {
  std::int32_t below = 0, above = 0;
};

// Neighbours of equal surface may be one piece. Steep facets of a mesh or of the ground, walls among
// them, are a surface of their own.
inline std::uint32_t surface_of(std::uint32_t geometry, std::uint32_t steep) {
  return 2U * geometry + steep;
}
inline bool is_steep(std::uint32_t surface) { return (surface & 1U) != 0; }

class RayChain {
 public:
  static constexpr std::int32_t kEnd = -1;

  int count() const { return count_; }
  void clear() { count_ = 0; }
  // Makes room for `count` more rays and returns the first; their contents are the caller's.
  int append(int count) {
    const int first = count_;
    count_ += count;
    const auto wanted = static_cast<std::size_t>(count_);
    if (wanted > next.size()) grow(wanted + wanted / 2);
    return first;
  }
  // Neighbours of a fan that fills the chain, [row][azimuth].
  void link_fan() {
    std::int32_t* const higher = next.data();
    std::uint8_t* const of_group = azimuth.data();
    const int count = count_;
    for (int i = 0; i < count; ++i) higher[i] = i + kGroupAzimuths;
    for (int i = 0; i < count; ++i) of_group[i] = static_cast<std::uint8_t>(i % kGroupAzimuths);
    for (int i = count - kGroupAzimuths; i < count; ++i) higher[i] = kEnd;
  }
  void link(const RayGap& gap, std::int32_t between) {
    next[static_cast<std::size_t>(gap.below)] = between;
    next[static_cast<std::size_t>(between)] = gap.above;
    azimuth[static_cast<std::size_t>(between)] = azimuth[static_cast<std::size_t>(gap.below)];
  }

  // By ray.
  std::vector<double> elevation_rad;
  std::vector<double> offset_rad;  // in azimuth, from the middle of the sub-column
  std::vector<float> range_m;      // 0 without a hit
  std::vector<float>
      range_slope;  // q: the facet's plane lies at R / (1 + q de) for a ray de higher
  std::vector<float> density_W_per_rad2;      // dP / (de daz)
  std::vector<std::uint32_t> surface;         // surface_of(), terrain::kNoHit without a hit
  std::vector<terrain::MaterialId> material;  // 0 without an echo
  std::vector<std::uint8_t> azimuth;          // sub-column of the group
  std::vector<std::int32_t> next;             // the next higher ray of the same sub-column

 private:
  void grow(std::size_t size) {
    elevation_rad.resize(size);
    offset_rad.resize(size);
    range_m.resize(size);
    range_slope.resize(size);
    density_W_per_rad2.resize(size);
    surface.resize(size);
    material.resize(size);
    azimuth.resize(size);
    next.resize(size);
  }

  int count_ = 0;
};

}  // namespace fanbeam::renderer
