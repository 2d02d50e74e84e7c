// From elevation and azimuth in the antenna's frame to the direction of a ray in the scene.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/series.h"
#include "renderer/casting/ray_batch.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

// A direction, or its derivative, as weights of the antenna's axes.
struct AxisWeights {
  double forward, right, up;
};
inline AxisWeights direction_weights(bool cone, double ce, double se, double ca, double sa) {
  return cone ? AxisWeights{ca * ce, sa, ca * se} : AxisWeights{ce * ca, ce * sa, se};
}
inline AxisWeights elevation_derivative(bool cone, double ce, double se, double ca, double sa) {
  return cone ? AxisWeights{-ca * se, 0.0, ca * ce} : AxisWeights{-se * ca, -se * sa, ce};
}
inline AxisWeights azimuth_derivative(bool cone, double ce, double se, double ca, double sa) {
  return cone ? AxisWeights{-sa * ce, ca, -sa * se} : AxisWeights{-ce * sa, ce * ca, 0.0};
}

class RayAim {
 public:
  RayAim(const sensors::AntennaFrame& antenna, bool cone, bool level)
      : antenna_(antenna), cone_(cone), level_(level) {}

  // Fills directions and Jacobians.
  void point(RayBatch& batch) const {
    unsigned wide = 0;
    for (const double offset_rad : batch.offset_rad)
      wide |= std::abs(offset_rad) > kSmallOffset_rad ? 1U : 0U;
    if (wide != 0) {
      point_any<true>(batch);
    } else {
      point_any<false>(batch);
    }
  }

 private:
  // To there the second order leaves 2e-8, no more than floats do.
  static constexpr double kSmallOffset_rad = 5e-3;

  // From cosine and sine of an angle to those of one `by_rad` larger.
  template <bool wide>
  static void turn(double by_rad, double& cosine, double& sine) {
    const double c = cosine, s = sine, d = by_rad;
    if constexpr (wide) {
      const double cd = std::cos(d), sd = std::sin(d);
      cosine = c * cd - s * sd;
      sine = s * cd + c * sd;
    } else {
      cosine = c - s * d - c * d * d / 2;
      sine = s + c * d - s * d * d / 2;
    }
  }

  template <bool wide>
  void point_any(RayBatch& batch) const {
    if (cone_) {
      point_all<true, false, wide>(batch);
    } else if (level_) {
      point_all<false, true, wide>(batch);
    } else {
      point_all<false, false, wide>(batch);
    }
  }

  template <bool cone, bool level, bool wide>
  void point_all(RayBatch& batch) const {
    const glm::dvec3 f = antenna_.forward, r = antenna_.right, u = antenna_.up;
    for (int i = 0; i < kBatchRays; ++i) {
      const double c = batch.column_cosine[i], s = batch.column_sine[i], d = batch.offset_rad[i];
      double ca = c, sa = s;
      turn<wide>(d, ca, sa);
      double ce = 0.0, se = 0.0;
      core::series_cosine_sine(batch.elevation_rad[i], ce, se);  // finer than the floats below
      if constexpr (!level) follow_range<cone, wide>(c, s, d, ce, se);
      const AxisWeights w = direction_weights(cone, ce, se, ca, sa);
      batch.direction_x[i] = static_cast<float>(w.forward * f.x + w.right * r.x + w.up * u.x);
      batch.direction_y[i] = static_cast<float>(w.forward * f.y + w.right * r.y + w.up * u.y);
      batch.direction_z[i] = static_cast<float>(w.forward * f.z + w.right * r.z + w.up * u.z);
      const AxisWeights h = elevation_derivative(cone, ce, se, ca, sa);
      batch.higher_x[i] = static_cast<float>(h.forward * f.x + h.right * r.x + h.up * u.x);
      batch.higher_y[i] = static_cast<float>(h.forward * f.y + h.right * r.y + h.up * u.y);
      batch.higher_z[i] = static_cast<float>(h.forward * f.z + h.right * r.z + h.up * u.z);
      // ray_caster.h says why not cos(e). Beyond 90 deg a cone has no directions.
      batch.jacobian[i] = cone ? std::max(ca, 0.0) : 1.0;
    }
  }

  // Where the antenna is tilted, or the scan a cone, a step in azimuth alone would change the range
  // of level ground: the elevation then goes along with it, so that rays of one interval stay in
  // its cells.
  template <bool cone, bool wide>
  void follow_range(double column_cosine, double column_sine, double offset_rad, double& ce,
                    double& se) const {
    const auto upwards = [this](const AxisWeights& w) {
      return w.forward * antenna_.forward.z + w.right * antenna_.right.z + w.up * antenna_.up.z;
    };
    const double by_azimuth = upwards(azimuth_derivative(cone, ce, se, column_cosine, column_sine));
    const double by_elevation =
        upwards(elevation_derivative(cone, ce, se, column_cosine, column_sine));
    // Rolled on its side, range no longer follows elevation.
    const bool upright = std::abs(by_elevation) >= 0.1;
    turn<wide>(upright ? -by_azimuth / by_elevation * offset_rad : 0.0, ce, se);
  }

  const sensors::AntennaFrame& antenna_;
  bool cone_;
  bool level_;  // azimuth alone does not change the range of level ground
};

}  // namespace fanbeam::renderer
