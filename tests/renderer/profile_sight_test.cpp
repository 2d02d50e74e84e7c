// Lines of sight: the horizon of a slice gives the answer of a ray.
#include <catch2/catch.hpp>
#include <numeric>

#include "core/pose.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;
using tests::kHeight_m;

namespace {

constexpr double kGround_m = 800.0;  // half its extent
constexpr std::uint64_t kWorlds = 16;
constexpr std::size_t kPoints = 5000;  // in each

// A number in (low, high) for each world, thing and draw.
struct Draws {
  std::uint64_t world, thing;
  double operator()(std::uint32_t draw, double low, double high) const {
    return low + (high - low) * tests::uniform(50 + world, thing, draw);
  }
};

// Rough ground with ridges, and buildings in and beside the fan, many of which overlap; some are
// sunk into the ground, some rise over the sensor.
renderer::World random_world(std::uint64_t number) {
  std::uint64_t post = 0;
  terrain::HeightField field = tests::ground(kGround_m, 20.0, [&](double, double) {
    return Draws{number, 1000 + ++post}(0, -15.0, 15.0);
  });
  std::vector<tests::Body> bodies;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const Draws draw{number, i};
    const glm::dvec2 centre_m(draw(0, -25.0, 25.0), draw(1, 40.0, 700.0));
    const double turn_rad = draw(2, 0.0, core::kPi);
    const glm::dvec2 along(std::cos(turn_rad), std::sin(turn_rad));
    const double length_m = draw(3, 4.0, 24.0), width_m = draw(4, 3.0, 12.0);
    const auto ring = [&](double share) {
      return terrain::rectangle_patch(centre_m, along, share * length_m, share * width_m, 0)
          .outline_m;
    };
    terrain::Prism prism{ring(1.0), {}, -40.0, i % 15 == 0 ? 75.0 : draw(5, -6.0, 22.0)};
    if (i % 5 == 0) prism.holes_m = {ring(0.6)};
    bodies.push_back(tests::building(prism, 0, 0));
  }
  sensors::Sensor sensor = tests::hivision(6);
  sensor.range.cells = 60;  // to 600 m
  return tests::world(sensor, std::move(field), {kGrass}, std::move(bodies));
}

double heading_rad(const sensors::AntennaFrame& antenna, const glm::dvec3& to_m) {
  return std::atan2(to_m.x - antenna.position_m.x, to_m.y - antenna.position_m.y);
}

// The point as far away and as high, at another heading from north.
glm::dvec3 at_heading(const sensors::AntennaFrame& antenna, const glm::dvec3& to_m,
                      double turned_rad) {
  const glm::dvec3& from_m = antenna.position_m;
  const double distance_m = std::hypot(to_m.x - from_m.x, to_m.y - from_m.y);
  return {from_m.x + distance_m * std::sin(turned_rad),
          from_m.y + distance_m * std::cos(turned_rad), to_m.z};
}

// Over the ground, on and in buildings, close behind ridges, beyond the gate and beside the fan.
// `move` has the last word on the place before the height there is chosen.
template <class Move>
std::vector<glm::dvec3> random_points(const renderer::World& world, std::uint64_t number,
                                      const Move& move) {
  enum Kind { in_air, on_roof, in_building, on_ground, beyond_gate, beside_fan, kinds };
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Draws draw{number, 100000 + i};
    const std::size_t kind = i % kinds;
    const double distance_m = draw(0, 20.0, kind == beyond_gate ? kGround_m : 620.0);
    const double azimuth_rad = core::radians(draw(1, -2.0, 2.0) * (kind == beside_fan ? 4.0 : 1.0));
    const terrain::Solid& solid = world.solids().prisms[static_cast<std::size_t>(
        draw(2, 0.0, static_cast<double>(world.solids().prisms.size())))];
    glm::dvec2 place = distance_m * glm::dvec2(std::sin(azimuth_rad), std::cos(azimuth_rad));
    if (kind == on_roof || kind == in_building) {
      const std::vector<glm::dvec2>& ring = solid.rings_m.front();
      place = ring[0] + draw(3, 0.05, 0.95) * (ring[1] - ring[0]) +
              draw(4, 0.05, 0.95) * (ring[3] - ring[0]);
    }
    glm::dvec3 at = move(glm::dvec3(place, 0.0));
    const double ground_m = world.surfaces().terrain()->height_at(at.x, at.y).value_or(0.0);
    at.z = kind == on_roof       ? solid.top_m + draw(5, 0.3, 3.0)
           : kind == in_building ? solid.top_m - draw(5, 0.3, 10.0)
           : kind == on_ground   ? ground_m + 0.3
                                 : ground_m + draw(5, 0.3, 30.0);
    points.push_back(at);
  }
  return points;
}

struct Answers {
  renderer::FanSums sums;
  std::vector<std::uint8_t> clear;
};

Answers ask_slices(const renderer::World& world, const sensors::AntennaFrame& antenna,
                   const std::vector<glm::dvec3>& to_m, double slices) {
  renderer::FanSums sums;
  renderer::SightLines sight{to_m, {}};
  renderer::ProfileCaster(world, renderer::profile_sampling_for(slices))
      .cast(antenna, false, renderer::CastPass{}, sums, sight);
  return {std::move(sums), std::move(sight.clear)};
}

bool ray_clear(const renderer::World& world, const sensors::AntennaFrame& antenna,
               const glm::dvec3& to_m) {
  return !world.surfaces().occluded(antenna.position_m, to_m, renderer::kSightClearance_m);
}

// Whether the ray to the point, or to one 1 mm beside, over or under it, answers `clear`: rays are
// floats.
bool clear_within_1_mm(const renderer::World& world, const sensors::AntennaFrame& antenna,
                       const glm::dvec3& to_m, bool clear) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double moved_m : {-1e-3, 0.0, 1e-3}) {
      glm::dvec3 at = to_m;
      at[axis] += moved_m;
      if (ray_clear(world, antenna, at) == clear) return true;
    }
  return false;
}

struct Count {
  int asked = 0, clear = 0, differ = 0, unexplained = 0;
};

// Answers for random points, of which those that differ must agree with the ray to the same point
// at some heading of its slice's wedge: at most half a slice to the left or right.
Count against_rays(const sensors::AntennaFrame& antenna, double slices) {
  const renderer::Sampling sampling = renderer::profile_sampling_for(slices);
  Count count;
  for (std::uint64_t number = 0; number < kWorlds; ++number) {
    const renderer::World world = random_world(number);
    const std::vector<glm::dvec3> to_m =
        random_points(world, number, [](const glm::dvec3& at) { return at; });
    const Answers found = ask_slices(world, antenna, to_m, slices);
    const double half_rad = found.sums.step_rad / sampling.slices_per_sub_column / 2;
    const auto agrees_within_wedge = [&](const glm::dvec3& at, bool clear) {
      constexpr int kSteps = 40;
      for (int step = -kSteps; step <= kSteps; ++step) {
        const double turned_rad = heading_rad(antenna, at) + half_rad * step / kSteps;
        if (clear_within_1_mm(world, antenna, at_heading(antenna, at, turned_rad), clear))
          return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < to_m.size(); ++i) {
      const bool clear = found.clear[i] != 0;
      const bool differs = ray_clear(world, antenna, to_m[i]) != clear;
      ++count.asked;
      count.clear += clear;
      count.differ += differs;
      count.unexplained += differs && !agrees_within_wedge(to_m[i], clear);
    }
  }
  return count;
}

// Of 80 000 points some hundred are seen past the side of what hides the middle of a wide slice, or
// the other way round: the fewer the narrower the slices.
void check_against_rays(const sensors::AntennaFrame& antenna) {
  for (const double slices : {4.0, 64.0}) {
    const Count count = against_rays(antenna, slices);
    INFO(slices << " slices");
    CHECK(count.unexplained == 0);
    CHECK(count.differ < count.asked * 0.01 / slices);
    CHECK(count.clear > count.asked / 5);
    CHECK(count.clear < count.asked * 4 / 5);
  }
}

// 10 m over the ground: no slice can show it.
tests::Body plate() {
  terrain::TriangleMesh mesh;
  mesh.vertices_m = {
      {5.0, 500.0, 10.0}, {15.0, 500.0, 10.0}, {15.0, 520.0, 10.0}, {5.0, 520.0, 10.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_material = {0, 0};
  mesh.material_names = {"metal"};
  return terrain::PlacedMesh{std::move(mesh), {0}};
}

}  // namespace

TEST_CASE("On a slice's own heading a point is seen as its ray sees it", "[profile]") {
  const sensors::AntennaFrame antenna = tests::level_antenna({3.0, -2.0, kHeight_m}, 0.01);
  int asked = 0, seen = 0, within_1_mm = 0;
  for (std::uint64_t number = 0; number < kWorlds; ++number) {
    const renderer::World world = random_world(number);
    const renderer::FanSums fan = ask_slices(world, antenna, {}, 64.0).sums;
    const double width_rad = fan.step_rad / 8.0;  // 8 slices per sub-column
    const auto to_slice = [&](const glm::dvec3& at) {
      const double first_rad = fan.first_azimuth_rad + 0.01;
      const double slice = std::floor((heading_rad(antenna, at) - first_rad) / width_rad);
      return at_heading(antenna, at, first_rad + (slice + 0.5) * width_rad);
    };
    const std::vector<glm::dvec3> to_m = random_points(world, number, to_slice);
    const Answers found = ask_slices(world, antenna, to_m, 64.0);
    for (std::size_t i = 0; i < to_m.size(); ++i) {
      const bool clear = found.clear[i] != 0;
      ++asked;
      seen += clear;
      if (ray_clear(world, antenna, to_m[i]) == clear) continue;
      ++within_1_mm;
      INFO("world " << number << ", point " << i << ", seen: " << clear);
      CHECK(clear_within_1_mm(world, antenna, to_m[i], clear));
    }
  }
  CHECK(seen > asked / 5);
  CHECK(seen < asked * 4 / 5);
  CHECK(within_1_mm < asked / 10000);
}

TEST_CASE("Elsewhere it is seen as the ray at some heading of its slice's wedge sees it",
          "[profile]") {
  check_against_rays(tests::level_antenna({3.0, -2.0, kHeight_m}));
}

TEST_CASE("A rolled and pitched antenna's slices answer as rays do", "[profile]") {
  check_against_rays(sensors::antenna_frame(
      {3.0, -2.0, kHeight_m}, tests::level_pose(kHeight_m).north_east_down,
      core::quaternion_from({core::radians(10.0), core::radians(-5.0), 0.0}), {}, false));
}

TEST_CASE("Rays answer for what slices do not reach", "[profile]") {
  // From the second place the ground ends inside the gate.
  for (const double north_m : {-2.0, 450.0}) {
    const sensors::AntennaFrame antenna = tests::level_antenna({3.0, north_m, kHeight_m});
    renderer::World world = random_world(3);
    // A box alone: azimuths 0 to 1.7 deg left of the sensor's.
    tests::solids_of(world).others = {{{0.0, north_m + 100.0, 0.0}, {3.0, north_m + 120.0, 10.0}}};
    const double far_m = world.sensor.range.maximum_m();
    std::vector<glm::dvec3> beyond;
    const auto move = [north_m](const glm::dvec3& at) {
      return at + glm::dvec3(0.0, north_m, 0.0);
    };
    for (const glm::dvec3& at : random_points(world, 3, move)) {
      const double azimuth_deg = core::degrees(heading_rad(antenna, at));
      const bool boxed = azimuth_deg < 0.0 && azimuth_deg > -1.7;
      const bool beside = std::abs(azimuth_deg) > 2.2;
      const bool far = std::hypot(at.x - 3.0, at.y - north_m) > far_m + renderer::kSightClearance_m;
      const bool off_grid = at.y > kGround_m + 2.0 * renderer::kSightClearance_m;
      if (boxed || beside || far || off_grid) beyond.push_back(at);
    }
    CHECK(beyond.size() > kPoints / 4);
    const Answers found = ask_slices(world, antenna, beyond, 4.0);
    for (std::size_t i = 0; i < beyond.size(); ++i)
      CHECK((found.clear[i] != 0) == ray_clear(world, antenna, beyond[i]));
  }
}

TEST_CASE("A frame of slices shows the targets that a frame of rays shows", "[profile]") {
  // Ground and walls that reflect nothing leave the targets' power alone in the picture. Lines of
  // sight from 60 m over the roof's far edge, 420 m away and 20 m high, meet the ground at 630 m.
  sensors::Sensor sensor = tests::hivision(12);
  renderer::World world =
      tests::world(sensor, tests::ground(1000.0, 50.0, [](double, double) { return 0.0; }),
                   {materials::PhongNrcs(0.0, 0.0, 1.0)},
                   {tests::box({-8.0, 400.0, -5.0}, {3.0, 420.0, 20.0}, 0), plate()});
  struct Light {
    glm::dvec3 at_m;
    bool seen;
  };
  const std::vector<Light> lights{
      {{0.0, 390.0, 0.3}, true},   {{1.0, 405.0, 10.0}, false},  // before and in the building
      {{0.0, 415.0, 20.3}, true},  {{1.0, 430.0, 0.3}, false},   // on its roof, behind it
      {{2.0, 440.0, 30.0}, true},  {{8.0, 460.0, 0.3}, true},    // over its shadow, beside it
      {{-1.0, 620.0, 0.3}, false}, {{-1.0, 640.0, 0.3}, true},   // in its shadow, beyond it
      {{10.0, 510.0, 0.3}, true},  {{10.0, 530.0, 9.0}, false},  // under the plate, behind it
      {{10.0, 570.0, 0.3}, true},  {{0.0, 1010.0, 0.3}, true}};  // beyond both, off the grid
  for (const Light& light : lights)
    world.targets.push_back(
        {"light", materials::ConstantRcs{1.0}, {{0.0, light.at_m}}, glm::dmat3(1.0)});
  const renderer::FramePose pose = tests::level_pose(kHeight_m);
  const auto render = [&](const renderer::Sampling& sampling) {
    return renderer::render_frame(world, sampling, {}, {}, pose);
  };
  const renderer::Frame rays = render({});
  const renderer::Frame slices =
      render(renderer::profile_sampling_for(renderer::kDefaultSlicesPerColumn));
  CHECK(slices.slices > 0);
  CHECK(slices.rays > 0);
  CHECK(slices.bscope_W == rays.bscope_W);
  CHECK(slices.cscope_W_m3 == rays.cscope_W_m3);
  for (const Light& light : lights) {
    const double range_m = glm::length(light.at_m - pose.position_m);
    const auto cell =
        static_cast<std::ptrdiff_t>((range_m - sensor.range.minimum_m) / sensor.range.cell_m);
    const auto row = slices.bscope_W.begin() + cell * sensor.scan.columns;
    INFO(light.at_m.x << ", " << light.at_m.y << ", " << light.at_m.z);
    CHECK((std::accumulate(row, row + sensor.scan.columns, 0.0) > 0.0) == light.seen);
  }
}
