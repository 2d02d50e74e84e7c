// Where rays of sub-columns of any width point.
#include "renderer/casting/ray_aim.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;

namespace {

renderer::RayBatch batch_of(const renderer::SubColumn& column, double elevation_rad) {
  renderer::RayBatch batch{};
  for (int i = 0; i < renderer::kBatchRays; ++i) {
    batch.set_column(i, column);
    batch.elevation_rad[i] = elevation_rad;
    batch.offset_rad[i] = column.offset_rad((i + 0.5) / renderer::kBatchRays);
  }
  batch.close(renderer::kBatchRays);
  return batch;
}

glm::dvec3 direction_of(const renderer::RayBatch& batch, int i) {
  return {batch.direction_x[i], batch.direction_y[i], batch.direction_z[i]};
}

}  // namespace

// The caster takes their length for one: by the second order in an offset of half a radian ranges were
// 0.8 % short.
TEST_CASE("Rays have their own azimuth and length one, however wide their sub-column is",
          "[ray_aim]") {
  const sensors::AntennaFrame antenna = tests::antenna_at(60.0);
  for (const bool cone : {false, true})
    for (const double width_deg : {0.06, 0.25, 2.0, 30.0, 120.0}) {
      const double centre_rad = core::radians(cone ? 5.0 : 20.0);
      const renderer::SubColumn column{centre_rad, std::cos(centre_rad), std::sin(centre_rad),
                                       core::radians(width_deg)};
      const double elevation_rad = core::radians(-8.0);
      renderer::RayBatch batch = batch_of(column, elevation_rad);
      renderer::RayAim(antenna, cone, !cone).point(batch);
      for (int i = 0; i < renderer::kBatchRays; ++i) {
        const double azimuth_rad = centre_rad + batch.offset_rad[i];
        INFO("cone " << cone << ", " << width_deg << " deg wide, ray " << i);
        CHECK(glm::length(direction_of(batch, i)) == Approx(1.0).epsilon(0.0).margin(3e-7));
        // Of a cone the elevation goes along with the azimuth, to keep its range.
        if (!cone)
          CHECK(glm::distance(direction_of(batch, i),
                              sensors::direction(antenna, azimuth_rad, elevation_rad,
                                                 sensors::ScanSurface::plane)) < 3e-7);
      }
    }
}
