// What ways by mirrors bring back: the equations of bounce_tracer.h. Private to the bounce tracer.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/stages/bounce_kernel.h"
#include "renderer/surfaces/bistatic_nrcs.h"
#include "renderer/world.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// An echo with its power per solid angle of the first ray, at azimuth gain 1 around `azimuth_rad`,
// the mean of the first and the last direction; of it `left` comes through the air. The rates are
// derivatives by the first ray's elevation, on planes through the facets that were hit: what a ray
// stands for in elevation lies along them.
struct BounceEcho {
  std::size_t ray = 0;  // in the list that was traced
  double range_m = 0.0, range_m_per_rad = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0, elevation_rate = 0.0;
  double density_W_per_rad2 = 0.0, left = 1.0;
};

// Pairs that would show, and the rays back from their ends.
struct BounceReturns {
  std::vector<BounceEcho> pairs;
  CastRays rays;
};

class BounceWeights {
 public:
  // As BounceTracer.
  BounceWeights(const World& world, bool noise);

  // Less reflection than this brings nothing that shows.
  double faintest_mirror() const { return faintest_mirror_; }

  // Adds what all ways that end on a surface bring back, as echoes of first rays that are numbered
  // from `first` on: images that show to `images`, and pairs that would to `returns`.
  void weigh(const BounceView& view, const MirroredRays& ways, std::size_t first,
             std::vector<BounceEcho>& images, BounceReturns& returns) const;

 private:
  void weigh_one(const BounceView& view, const MirroredRays& ways, int k, std::size_t ray,
                 std::vector<BounceEcho>& images, BounceReturns& returns) const;
  double jacobian(const MirroredRays& ways, int k) const;
  BounceEcho image_of(const MirroredRays& ways, int k, const BistaticNrcs& nrcs) const;
  // Without asking whether B sees O.
  BounceEcho pair_of(const MirroredRays& ways, int k, const BistaticNrcs& nrcs) const;
  // Whether an echo can show, were the whole beam as bright.
  bool shows(const BounceEcho& echo) const;
  double loss_dB(const glm::dvec3& a_m, const glm::dvec3& b_m, double length_m) const;

  const World& world_;
  const std::vector<BistaticNrcs>& nrcs_;  // by material id
  sensors::TwoWayTable elevation_gain_, azimuth_gain_;
  double radar_constant_W_m2_ = 0.0;
  std::vector<double> faintest_W_per_rad2_;  // echo by range cell: less need not be followed
  double faintest_mirror_ = 0.0;
};

}  // namespace fanbeam::renderer
