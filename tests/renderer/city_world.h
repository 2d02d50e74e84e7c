// A city for both casters, and single levels of samples (CastPass) of it.
#pragma once

#include <functional>
#include <memory>
#include <numeric>

#include "renderer/casting/fan_layout.h"
#include "renderer/casting/ray_caster.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

namespace fanbeam::tests {

enum CityMaterial : terrain::MaterialId { kCityGround, kCityWall, kCityRoof };

inline std::vector<materials::NrcsCurve> city_library() {
  return {kGrass, kWall, materials::PhongNrcs(0.02, 0.2, 3.0)};
}

inline terrain::HeightField level_ground() {
  return ground(1300.0, 50.0, [](double, double) { return 0.0; });
}

// Buildings on a `share` of the plots of a grid of 40 m, where `built` allows: lengths, heights and
// directions are drawn.
inline Body city(const std::function<bool(double, double)>& built, double share) {
  std::vector<terrain::Prism> prisms;
  std::uint64_t plot = 0;
  for (double x = -1000.0; x <= 1000.0; x += 40.0)
    for (double y = -1000.0; y <= 1000.0; y += 40.0) {
      ++plot;
      const auto random = [plot](std::uint32_t draw) { return uniform(5, plot, draw); };
      if (!built(x, y) || random(0) >= share) continue;
      const double turn_rad = core::kPi * random(1);
      const terrain::SurfacePatch outline =
          terrain::rectangle_patch({x, y}, {std::cos(turn_rad), std::sin(turn_rad)},
                                   12.0 + 20.0 * random(2), 8.0 + 12.0 * random(3), kCityRoof);
      prisms.push_back({outline.outline_m, {}, -5.0, 5.0 + 20.0 * random(4)});
    }
  core::ProblemList problems;
  terrain::Extrusion extrusion = terrain::extrude(prisms, "city", {}, problems);
  problems.throw_if_errors();
  terrain::Solids solids;
  std::vector<terrain::ObjectId> objects(prisms.size());
  std::iota(objects.begin(), objects.end(), 1U);
  terrain::add_solids(prisms, extrusion, kCityWall, kCityRoof, objects, solids);
  return {{std::move(extrusion.mesh), {kCityWall, kCityRoof}, std::move(objects)},
          std::move(solids)};
}

inline renderer::World city_world(const sensors::Sensor& sensor,
                                  const std::function<bool(double, double)>& built,
                                  double share = 0.5) {
  std::vector<Body> bodies;
  bodies.push_back(city(built, share));
  return world(sensor, level_ground(), city_library(), std::move(bodies));
}

inline bool everywhere(double, double) { return true; }

inline renderer::Sampling slices(int per_column) {
  return renderer::profile_sampling_for(per_column);
}

inline std::unique_ptr<renderer::Caster> caster_of(const renderer::World& world,
                                                   const renderer::Sampling& sampling) {
  if (sampling.caster == renderer::CasterKind::profile)
    return std::make_unique<renderer::ProfileCaster>(world, sampling);
  return std::make_unique<renderer::RayCaster>(world, sampling);
}

inline renderer::FanSums cast_level(const renderer::Caster& caster, int level,
                                    const sensors::AntennaFrame& antenna) {
  renderer::FanSums sums;
  renderer::SightLines none;
  caster.cast(antenna, true, {level, nullptr}, sums, none);
  return sums;
}

inline void mix_in(const renderer::FanSums& other, double share, renderer::FanSums& sums) {
  renderer::combine_groups(other, share, renderer::groups_of(sums), 1.0 - share, sums);
}

}  // namespace fanbeam::tests
