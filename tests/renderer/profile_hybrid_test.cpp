// Models among the slices: the azimuths in which they stand are left to rays, all others keep their
// slices.
#include <catch2/catch.hpp>

#include "core/parallel.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/frame_renderer.h"
#include "tests/renderer/converged_rays.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

enum YardMaterial : terrain::MaterialId { kYardGround, kYardWall, kYardRoof, kCanopyMetal };

std::vector<materials::NrcsCurve> yard_library() {
  return {tests::kGrass, tests::kWall, materials::PhongNrcs(0.02, 0.2, 3.0),
          materials::PhongNrcs(0.2, 0.3, 2.0)};
}

// A closed body between four corners, counter-clockwise from above, and the same ones lower down.
struct Slab {
  std::array<glm::dvec3, 4> top_m;
  double down_m;
};

tests::Body metal(const std::vector<Slab>& slabs) {
  terrain::TriangleMesh mesh;
  mesh.material_names = {"metal"};
  for (const Slab& slab : slabs) {
    const auto first = static_cast<glm::uint>(mesh.vertices_m.size());
    for (const double lower_m : {slab.down_m, 0.0})
      for (const glm::dvec3& corner : slab.top_m)
        mesh.vertices_m.push_back(corner - glm::dvec3(0.0, 0.0, lower_m));
    const auto add_face = [&](glm::uint a, glm::uint b, glm::uint c, glm::uint d) {
      mesh.triangles.emplace_back(first + a, first + b, first + c);
      mesh.triangles.emplace_back(first + a, first + c, first + d);
    };
    add_face(4, 5, 6, 7);
    add_face(3, 2, 1, 0);
    for (glm::uint i = 0; i < 4; ++i) add_face(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4);
  }
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  return terrain::PlacedMesh{std::move(mesh), {kCanopyMetal}};
}

Slab upright(glm::dvec3 low, glm::dvec3 high) {
  return {{{{low.x, low.y, high.z}, {high.x, low.y, high.z}, high, {low.x, high.y, high.z}}},
          high.z - low.z};
}

// A roof on four posts that rises away from the sensor and to the right; air under it.
tests::Body canopy() {
  std::vector<Slab> slabs{
      {{{{-12.0, 440.0, 14.0}, {-2.0, 440.0, 15.0}, {-2.0, 470.0, 21.0}, {-12.0, 470.0, 20.0}}},
       0.8}};
  for (const glm::dvec2 at :
       {glm::dvec2(-12.0, 440.0), {-2.6, 440.0}, {-2.6, 469.4}, {-12.0, 469.4}})
    slabs.push_back(upright({at, -30.0}, {at + 0.6, at.y > 450.0 ? 19.6 : 13.6}));
  return metal(slabs);
}

// Independent heights from post to post; level behind 800 m, as rays end with the range gate.
terrain::HeightField rough_ground() {
  std::uint64_t post = 0;
  return tests::ground(1000.0, 10.0, [&](double x, double y) {
    const double relief_m = std::clamp((800.0 - std::hypot(x, y)) / 10.0, 0.0, 14.0);
    return relief_m * (tests::uniform(41, ++post) - 0.5);
  });
}

// Seen from 60 m: the first building hides the left half of the canopy, the canopy all but the foot
// and the roof's edge of the second; the third stands in azimuths without a model.
renderer::World yard(bool with_canopy) {
  std::vector<tests::Body> bodies;
  const auto add_building = [&](const terrain::Ring_m& outline_m, double top_m) {
    bodies.push_back(tests::building({outline_m, {}, -30.0, top_m}, kYardWall, kYardRoof));
  };
  add_building({{-14.0, 380.0}, {-8.0, 379.0}, {-7.0, 400.0}, {-14.0, 401.0}}, 24.0);
  add_building({{-7.0, 500.0}, {4.0, 502.0}, {3.0, 520.0}, {-7.0, 518.0}}, 18.0);
  add_building({{7.0, 560.0}, {18.0, 556.0}, {19.0, 570.0}, {8.0, 575.0}}, 16.0);
  if (with_canopy) bodies.push_back(canopy());
  return tests::world(tests::narrow(12), rough_ground(), yard_library(), std::move(bodies));
}

renderer::World level_world(std::vector<tests::Body> bodies,
                            const sensors::Sensor& sensor = tests::narrow(12)) {
  return tests::world(sensor, tests::ground(1000.0, 50.0, [](double, double) { return 0.0; }),
                      yard_library(), std::move(bodies));
}

template <class Caster>
renderer::FanSums cast(const renderer::World& world, const renderer::Sampling& sampling,
                       const sensors::AntennaFrame& antenna) {
  renderer::FanSums sums;
  Caster(world, sampling).cast(antenna, true, sums);
  return sums;
}

renderer::FanSums hybrid(const renderer::World& world, double slices,
                         const sensors::AntennaFrame& antenna) {
  return cast<renderer::ProfileCaster>(world, renderer::profile_sampling_for(slices), antenna);
}

bool same_sub_column(const renderer::FanSums& a, const renderer::FanSums& b, int sub_column) {
  const auto same = [&](const std::vector<double>& x, const std::vector<double>& y, int bins) {
    const std::ptrdiff_t first = std::ptrdiff_t{sub_column} * bins;
    return std::equal(x.begin() + first, x.begin() + first + bins, y.begin() + first);
  };
  return same(a.range_W_per_rad, b.range_W_per_rad, a.cells) &&
         same(a.elevation_W_m3_per_rad, b.elevation_W_m3_per_rad, a.rows);
}

// Headings from which `box` is met, against the antenna's, by points all over it.
struct Span {
  double left_rad = 10.0, right_rad = -10.0;  // empty when left is more

  bool meets(const renderer::FanSums& sums, int sub_column, double widened = 0.0) const {
    const double sub_left_rad = sums.first_azimuth_rad + sub_column * sums.step_rad;
    return sub_left_rad <= right_rad + widened * sums.step_rad &&
           sub_left_rad + sums.step_rad >= left_rad - widened * sums.step_rad;
  }
};

Span span_of(const terrain::Box_m& box, const sensors::AntennaFrame& antenna, double far_m) {
  constexpr int kSteps = 100;
  Span span;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const glm::dvec3 at = box.low + (box.high - box.low) * glm::dvec3(i, j, 0) / (1.0 * kSteps) -
                            antenna.position_m;
      const double ahead_m = glm::dot(at, antenna.forward);
      if (ahead_m <= 0.0 || std::hypot(at.x, at.y) > far_m) continue;
      const double heading_rad = std::atan2(glm::dot(at, antenna.right), ahead_m);
      span = {std::min(span.left_rad, heading_rad), std::max(span.right_rad, heading_rad)};
    }
  return span;
}

// Power of all sub-columns in the cells that lie wholly between two ranges.
double power_between(const renderer::FanSums& sums, const sensors::Sensor& sensor, double near_m,
                     double far_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sums.range_W_per_rad.size(); ++i) {
    const auto cell = static_cast<double>(i % static_cast<std::size_t>(sums.cells));
    const double range_m = sensor.range.minimum_m + sensor.range.cell_m * cell;
    if (range_m >= near_m && range_m + sensor.range.cell_m <= far_m) sum += sums.range_W_per_rad[i];
  }
  return sum;
}

}  // namespace

TEST_CASE("A canopy among buildings looks as converged rays see it", "[profile]") {
  // Over such ground the azimuths left to rays are only as good as the rays: converged ones here.
  renderer::Sampling sampling = renderer::reference_sampling(9);
  sampling.caster = renderer::CasterKind::profile;
  sampling.slices_per_sub_column = 16;
  const renderer::World world = yard(true);
  const renderer::FramePose pose = tests::level_pose(kHeight_m);
  tests::check_same_picture(tests::difference(world.sensor, tests::render(world, sampling, pose),
                                              tests::converged_rays(world, pose)));
}

TEST_CASE("A building hides the sign behind it, the sign a building, and ground shows under it",
          "[profile]") {
  const tests::Body front = tests::box({-60.0, 400.0, -5.0}, {60.0, 420.0, 36.0}, kYardWall);
  const tests::Body behind = tests::box({-60.0, 540.0, -5.0}, {60.0, 560.0, 20.0}, kYardWall);
  const tests::Body sign = metal({upright({-60.0, 500.0, 3.0}, {60.0, 501.0, 30.0})});
  const auto seen = [](std::vector<tests::Body> bodies, double near_m, double far_m) {
    const renderer::World world = level_world(std::move(bodies));
    const renderer::FanSums sums = hybrid(world, 8.0, tests::level_antenna({0.0, 0.0, kHeight_m}));
    CHECK((sums.slices == 0) == !world.solids().others.empty());
    return power_between(sums, world.sensor, near_m, far_m);
  };
  // The sign is 501 to 504 m away; the line over the front building meets the ground at 1050 m.
  CHECK(seen({front, sign}, 425.0, 1000.0) == 0.0);
  CHECK(seen({sign}, 495.0, 512.0) > 2.0 * seen({}, 495.0, 512.0));
  // The line under the sign meets the ground at 527 m, the line over it at 1002 m.
  CHECK(seen({sign, behind}, 538.0, 1000.0) == 0.0);
  CHECK(seen({behind}, 538.0, 570.0) > seen({}, 538.0, 570.0));
  CHECK(seen({sign, behind}, 508.0, 526.0) == Approx(seen({}, 508.0, 526.0)).epsilon(0.01));
}

TEST_CASE("Azimuths without a model keep the bytes of their slices, the others are rays'",
          "[profile]") {
  const renderer::World with = yard(true), without = yard(false);
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  for (const double slices : {1.0, 4.0, 64.0}) {
    const renderer::Sampling sampling = renderer::profile_sampling_for(slices);
    const renderer::FanSums found = hybrid(with, slices, antenna);
    const renderer::FanSums alone = hybrid(without, slices, antenna);
    const renderer::FanSums rays = cast<renderer::RayCaster>(with, sampling, antenna);
    const Span span = span_of(with.solids().others.front(), antenna, with.sensor.range.maximum_m());
    std::uint64_t sliced = 0;
    for (int sub = 0; sub < found.sub_columns; ++sub) {
      const bool as_alone = same_sub_column(found, alone, sub);
      INFO(slices << " slices, sub-column " << sub);
      if (span.meets(found, sub)) CHECK_FALSE(as_alone);
      // A whole group of four goes to rays, with a neighbour of the canopy's on each side and the
      // 2 mrad by which a level antenna may lean.
      if (!span.meets(found, sub, 5.0 + 2e-3 / found.step_rad)) CHECK(as_alone);
      CHECK((as_alone || same_sub_column(found, rays, sub)));
      if (as_alone) sliced += static_cast<std::uint64_t>(sampling.slices_per_sub_column);
    }
    CHECK(found.rays > 0);
    CHECK(found.rays < rays.rays);
    CHECK(found.slices == sliced);
    CHECK(found.slices < alone.slices);
  }
}

TEST_CASE("No heading and no place of a box escapes the rays", "[profile]") {
  // Boxes without a mesh: what matters is who casts. Slices and rays never round alike.
  sensors::Sensor sensor = tests::hivision(8);
  sensor.range.cells = 60;
  renderer::World world = level_world({}, sensor);
  int met = 0, sliced = 0;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const auto random = [&](std::uint32_t draw) { return tests::uniform(42, trial, draw); };
    const sensors::AntennaFrame antenna =
        tests::level_antenna({7.0, -11.0, kHeight_m}, 2.0 * core::kPi * random(0));
    const double wide_m = trial % 2 == 0 ? 30.0 : 400.0, away_m = trial % 3 == 0 ? 60.0 : 700.0;
    const glm::dvec3 low(away_m * (2.0 * random(1) - 1.0), away_m * (2.0 * random(2) - 1.0), 0.0);
    const terrain::Box_m box{low, low + glm::dvec3(wide_m * random(3), wide_m * random(4), 9.0)};
    tests::solids_of(world).others = {box};
    const renderer::FanSums found = hybrid(world, 4.0, antenna);
    const renderer::FanSums rays =
        cast<renderer::RayCaster>(world, renderer::profile_sampling_for(4.0), antenna);
    const Span span = span_of(box, antenna, sensor.range.maximum_m());
    INFO("trial " << trial);
    for (int sub = 0; sub < found.sub_columns; ++sub) {
      const bool ray = same_sub_column(found, rays, sub);
      sliced += !ray;
      if (!span.meets(found, sub)) continue;
      CHECK(ray);
      ++met;
    }
  }
  CHECK(met > 500);
  CHECK(sliced > 500);
}

TEST_CASE("A model behind the sensor, beyond the gate or beside the fan costs no ray",
          "[profile]") {
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  const renderer::FanSums alone = hybrid(level_world({}), 16.0, antenna);
  const double far_m = tests::narrow(12).range.maximum_m();
  const auto cost = [&](glm::dvec3 low, glm::dvec3 high) {
    const renderer::FanSums sums =
        hybrid(level_world({metal({upright(low, high)})}), 16.0, antenna);
    CHECK((sums.range_W_per_rad == alone.range_W_per_rad) == (sums.rays == 0));
    CHECK((sums.slices == alone.slices) == (sums.rays == 0));
    return sums.rays;
  };
  CHECK(cost({-30.0, -40.0, 0.0}, {30.0, -1.0, 20.0}) == 0);
  CHECK(cost({-30.0, far_m + 0.1, 0.0}, {30.0, far_m + 30.0, 20.0}) == 0);
  CHECK(cost({-80.0, 500.0, 0.0}, {-31.0, 600.0, 20.0}) == 0);
  CHECK(cost({10.0, -200.0, 0.0}, {40.0, 100.0, 20.0}) == 0);
  // And their likes that reach into the fan do.
  CHECK(cost({-30.0, -40.0, 0.0}, {30.0, 1.0, 20.0}) > 0);
  CHECK(cost({-30.0, far_m - 1.0, 0.0}, {30.0, far_m + 30.0, 20.0}) > 0);
  CHECK(cost({-80.0, 500.0, 0.0}, {-20.0, 600.0, 20.0}) > 0);
  CHECK(cost({3.0, -200.0, 0.0}, {40.0, 100.0, 20.0}) > 0);
}

TEST_CASE("A model around the sensor leaves everything to rays", "[profile]") {
  renderer::World world = yard(false);
  tests::solids_of(world).others = {{{-5.0, -5.0, 0.0}, {5.0, 5.0, 10.0}}};
  const sensors::AntennaFrame antenna = tests::level_antenna({1.0, 2.0, kHeight_m}, 0.1);
  const renderer::FanSums found = hybrid(world, 16.0, antenna);
  const renderer::FanSums rays =
      cast<renderer::RayCaster>(world, renderer::profile_sampling_for(16.0), antenna);
  CHECK(found.slices == 0);
  CHECK(found.rays == rays.rays);
  CHECK(found.range_W_per_rad == rays.range_W_per_rad);
}

TEST_CASE("A frame of a tilted antenna goes to rays alone, the next level one to slices again",
          "[profile]") {
  const renderer::World world = yard(true);
  const renderer::Sampling sampling = renderer::profile_sampling_for(4);
  const renderer::ProfileCaster slices(world, sampling);
  const renderer::RayCaster rays(world, sampling);
  const auto sums_of = [](const renderer::Caster& caster, const sensors::AntennaFrame& antenna) {
    renderer::FanSums sums;
    caster.cast(antenna, true, sums);
    return sums;
  };
  const sensors::AntennaFrame level = tests::level_antenna({0.0, 0.0, kHeight_m});
  sensors::AntennaFrame tilted = level;
  const double turn_rad = 1.2e-3;  // of the vertical, 7.6 km away
  tilted.up = {std::sin(turn_rad), 0.0, std::cos(turn_rad)};
  tilted.right = glm::cross(tilted.forward, tilted.up);
  const renderer::FanSums before = sums_of(slices, level), between = sums_of(slices, tilted);
  CHECK(before.slices > 0);
  CHECK(between.slices == 0);
  const renderer::FanSums expected = sums_of(rays, tilted);
  REQUIRE(between.range_W_per_rad.size() == expected.range_W_per_rad.size());
  CHECK(between.range_W_per_rad == expected.range_W_per_rad);
  CHECK(between.elevation_W_m3_per_rad == expected.elevation_W_m3_per_rad);
  CHECK(sums_of(slices, level).range_W_per_rad == before.range_W_per_rad);
}

TEST_CASE("R10 slices and rays together have the same bytes for 1 and 2 threads", "[profile]") {
  const renderer::World world = yard(true);
  const renderer::FrameRenderer frames(world, renderer::profile_sampling_for(16.0), {}, {});
  const renderer::Frame expected = frames.render(tests::level_pose(kHeight_m));
  CHECK(expected.rays > 0);
  CHECK(expected.slices > 0);
  for (const int threads : {1, 2}) {
    const core::ThreadLimit limit(threads);
    const renderer::Frame again = frames.render(tests::level_pose(kHeight_m));
    CHECK(again.bscope_W == expected.bscope_W);
    CHECK(again.cscope_W_m3 == expected.cscope_W_m3);
  }
}
