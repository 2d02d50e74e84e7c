// Finds the gaps of a chain: where neighbours are farther apart than a range cell, hit different
// surfaces, or see two materials: the border of two grounds. By nothing that depends on losses, noise or
// power: an effect left out would move rays, and pixels by more than it is worth. A gap is filled by
// halving, and only its halves can be gaps of the next level.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/ray_chain.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

class GapFinder {
 public:
  // Neighbours farther apart than `limit_m` are not one piece of surface. Borders of materials are
  // sought to `edge_rad` of elevation.
  GapFinder(double limit_m, double edge_rad) : limit_m_(limit_m), edge_rad_(edge_rad) {}

  // Into `gaps`, all of a fan just linked, from the lowest step in elevation up.
  void search_fan(const RayChain& rays, bool horizon_only, std::vector<std::uint8_t>& marks,
                  std::vector<RayGap>& gaps) const {
    const int count = rays.count() - kGroupAzimuths;
    gaps.clear();
    if (count <= 0) return;
    marks.resize(static_cast<std::size_t>(count));
    gaps.resize(static_cast<std::size_t>(count));
    if (horizon_only) {
      mark<true>(rays, count, marks.data());
    } else {
      mark<false>(rays, count, marks.data());
    }
    RayGap* found = gaps.data();
    const std::uint8_t* const mark_of = marks.data();
    for (std::int32_t i = 0; i < count; ++i) {
      *found = {i, i + kGroupAzimuths};
      found += mark_of[i];
    }
    gaps.resize(static_cast<std::size_t>(found - gaps.data()));
  }

  // Into `halves`, those of `gaps` filled by the rays from `first` on.
  void search_halves(const RayChain& rays, bool horizon_only, const std::vector<RayGap>& gaps,
                     int first, std::vector<RayGap>& halves) const {
    halves.resize(2 * gaps.size());
    std::size_t found = 0;
    for (const RayGap& gap : gaps) {
      const std::int32_t between = first++;
      halves[found] = {gap.below, between};
      found += is_gap(rays, gap.below, between, horizon_only) ? 1 : 0;
      halves[found] = {between, gap.above};
      found += is_gap(rays, between, gap.above, horizon_only) ? 1 : 0;
    }
    halves.resize(found);
  }

 private:
  static constexpr double kSmallestStep_rad = 1e-5;  // 4 cm at 3.7 km: finer than any surface

  bool is_gap(const RayChain& rays, std::int32_t below, std::int32_t above,
              bool horizon_only) const {
    const auto b = static_cast<std::size_t>(below), a = static_cast<std::size_t>(above);
    return differ(Columns(rays), b, a, horizon_only);
  }
  template <bool horizon_only>
  void mark(const RayChain& rays, int count, std::uint8_t* marks) const {
    const Columns of(rays);
    for (int i = 0; i < count; ++i) {
      const auto below = static_cast<std::size_t>(i);
      marks[i] = differ(of, below, below + kGroupAzimuths, horizon_only) ? 1 : 0;
    }
  }

  struct Columns {
    explicit Columns(const RayChain& rays)
        : elevation_rad(rays.elevation_rad.data()),
          range_m(rays.range_m.data()),
          surface(rays.surface.data()),
          material(rays.material.data()) {}
    const double* elevation_rad;
    const float* range_m;
    const std::uint32_t* surface;
    const terrain::MaterialId* material;
  };
  bool differ(const Columns& of, std::size_t below, std::size_t above, bool horizon_only) const {
    const double step_rad = of.elevation_rad[above] - of.elevation_rad[below];
    const unsigned horizon =
        (of.surface[below] == terrain::kNoHit) != (of.surface[above] == terrain::kNoHit);
    const unsigned apart =
        static_cast<double>(std::abs(of.range_m[above] - of.range_m[below])) > limit_m_;
    const unsigned other = of.surface[below] != of.surface[above];
    const unsigned edge = static_cast<unsigned>(step_rad > edge_rad_) &
                          static_cast<unsigned>(of.material[below] != of.material[above]);
    return (static_cast<unsigned>(step_rad >= kSmallestStep_rad) &
            (edge | (horizon_only ? horizon : apart | other))) != 0;
  }

  double limit_m_;
  double edge_rad_;
};

}  // namespace fanbeam::renderer
