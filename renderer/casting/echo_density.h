// What comes back from the facets that a batch of rays hit: power per solid angle by the radar
// equation of ray_caster.h, and the facet's plane as far as deposition needs it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/series.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_batch.h"
#include "renderer/casting/ray_chain.h"
#include "renderer/surfaces/nrcs_table.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class EchoDensity {
 public:
  EchoDensity(const World& world, const PathLossTable& path_loss, const glm::dvec3& antenna_m)
      : surfaces_(world.surfaces()),
        nrcs_(world.nrcs.tables()),
        path_loss_(path_loss),
        antenna_m_(antenna_m),
        radar_constant_W_m2_(world.sensor.radar_constant_W_m2()) {}

  // Fills the rays of `chain` from `first` on with all that the batch's hits tell. Returns the
  // number of hits.
  int shade(const RayBatch& batch, int first, RayChain& chain) const {
    Facets facets;
    measure(batch, facets);
    Factors factors;
    look_up(batch, facets, factors);
    alignas(64) float density[kBatchRays];
    for (int i = 0; i < kBatchRays; ++i) {
      const auto range_m = static_cast<double>(facets.range_m[i]);
      const double nrcs = factors.nrcs[i] + factors.nrcs_step[i] * factors.nrcs_share[i];
      const double nepers_per_m = factors.loss[i] + factors.loss_step[i] * factors.loss_share[i];
      density[i] = static_cast<float>(
          radar_constant_W_m2_ * nrcs * batch.gain[i] * batch.jacobian[i] *
          core::series_decay(nepers_per_m * range_m) / std::max(range_m * range_m, 1e-30));
    }
    const auto to = static_cast<std::size_t>(first);
    const int count = batch.count;
    std::copy_n(batch.elevation_rad, count, chain.elevation_rad.data() + to);
    std::copy_n(facets.range_m, count, chain.range_m.data() + to);
    std::copy_n(facets.range_slope, count, chain.range_slope.data() + to);
    std::copy_n(density, count, chain.density_W_per_rad2.data() + to);
    std::copy_n(facets.surface, count, chain.surface.data() + to);
    std::copy_n(factors.material, count, chain.material.data() + to);
    return static_cast<int>(std::count_if(batch.geometry, batch.geometry + count,
                                          [](auto id) { return id != terrain::kNoHit; }));
  }

 private:
  // Floats: the normal comes in floats.
  struct Facets {
    alignas(64) float x_m[kBatchRays], y_m[kBatchRays], z_m[kBatchRays];
    alignas(64) float range_m[kBatchRays];      // 0 without a hit
    alignas(64) float sin_grazing[kBatchRays];  // 0 without a hit and for the back of a facet
    alignas(64) float range_slope[kBatchRays];
    alignas(64) std::uint32_t surface[kBatchRays];
  };

  // A table's value, the step to its next one and the share of that step.
  struct Factors {
    alignas(64) terrain::MaterialId material[kBatchRays];  // of what echoes
    alignas(64) double nrcs[kBatchRays], nrcs_step[kBatchRays], nrcs_share[kBatchRays];
    alignas(64) double loss[kBatchRays], loss_step[kBatchRays], loss_share[kBatchRays];
  };

  void measure(const RayBatch& batch, Facets& facets) const {
    const auto x_m = static_cast<float>(antenna_m_.x), y_m = static_cast<float>(antenna_m_.y),
               z_m = static_cast<float>(antenna_m_.z);
    for (int i = 0; i < kBatchRays; ++i) {
      const float nx = batch.normal_x[i], ny = batch.normal_y[i], nz = batch.normal_z[i];
      const float along =
          nx * batch.direction_x[i] + ny * batch.direction_y[i] + nz * batch.direction_z[i];
      const float square = nx * nx + ny * ny + nz * nz;
      const float sin_grazing = -along / std::sqrt(square);
      const float slope =
          (nx * batch.higher_x[i] + ny * batch.higher_y[i] + nz * batch.higher_z[i]) / along;
      const bool hit = batch.geometry[i] != terrain::kNoHit;
      const bool front = static_cast<unsigned>(hit) & static_cast<unsigned>(sin_grazing > 0.0F);
      facets.range_m[i] = hit ? batch.distance_m[i] : 0.0F;
      facets.sin_grazing[i] = front ? sin_grazing : 0.0F;
      facets.range_slope[i] = front ? slope : 0.0F;
      // Steeper than 45.6 degrees: neither do walls share intervals with roofs of their mesh.
      const std::uint32_t steep = nz * nz < 0.49F * square ? 1U : 0U;
      facets.surface[i] = hit ? surface_of(batch.geometry[i], steep) : terrain::kNoHit;
      facets.x_m[i] = x_m + batch.direction_x[i] * batch.distance_m[i];
      facets.y_m[i] = y_m + batch.direction_y[i] * batch.distance_m[i];
      facets.z_m[i] = z_m + batch.direction_z[i] * batch.distance_m[i];
    }
  }

  void look_up(const RayBatch& batch, const Facets& facets, Factors& factors) const {
    alignas(64) int nrcs_index[kBatchRays], loss_index[kBatchRays];
    for (int i = 0; i < kBatchRays; ++i)
      nrcs_index[i] =
          NrcsTable::index_of(static_cast<double>(facets.sin_grazing[i]), factors.nrcs_share[i]);
    for (int i = 0; i < kBatchRays; ++i) {
      factors.nrcs[i] = factors.nrcs_step[i] = 0.0;
      factors.material[i] = 0;
      if (facets.sin_grazing[i] <= 0.0F) continue;
      const terrain::MaterialId material = surfaces_.material(batch.geometry[i], batch.primitive[i],
                                                              static_cast<double>(facets.x_m[i]),
                                                              static_cast<double>(facets.y_m[i]));
      factors.material[i] = material;
      const double* const value = nrcs_[material].values() + nrcs_index[i];
      factors.nrcs[i] = value[0];
      factors.nrcs_step[i] = value[1] - value[0];
    }
    if (path_loss_.clear()) {
      std::fill_n(factors.loss, kBatchRays, 0.0);
      std::fill_n(factors.loss_step, kBatchRays, 0.0);
      std::fill_n(factors.loss_share, kBatchRays, 0.0);
      return;
    }
    for (int i = 0; i < kBatchRays; ++i)
      loss_index[i] =
          path_loss_.index_of(static_cast<double>(facets.z_m[i]), factors.loss_share[i]);
    const double* const nepers_per_m = path_loss_.nepers_per_m();
    for (int i = 0; i < kBatchRays; ++i) {
      factors.loss[i] = nepers_per_m[loss_index[i]];
      factors.loss_step[i] = nepers_per_m[loss_index[i] + 1] - nepers_per_m[loss_index[i]];
    }
  }

  const terrain::RayScene& surfaces_;
  const std::vector<NrcsTable>& nrcs_;
  const PathLossTable& path_loss_;
  glm::dvec3 antenna_m_;
  double radar_constant_W_m2_;
};

}  // namespace fanbeam::renderer
