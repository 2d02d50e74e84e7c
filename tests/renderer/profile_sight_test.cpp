// Lines of sight: the horizon of a slice gives the answer of a ray.
#include <catch2/catch.hpp>

#include "tests/renderer/profile_closed_form.h"

namespace {

using namespace fanbeam;

constexpr double kHeight_m = 60.0;
constexpr double kGround_m = 800.0;  // half its extent
constexpr double kSlices = 64.0;
const materials::PhongNrcs kGrass(0.0325, 0.136, 1.99);

// Ranges to 600 m.
sensors::Sensor short_sensor() {
  sensors::Sensor sensor = tests::hivision(6);
  sensor.range.cells = 60;
  return sensor;
}

// A number in (low, high) for each world, thing and draw.
struct Draws {
  std::uint64_t world, thing;
  double operator()(std::uint32_t draw, double low, double high) const {
    return low + (high - low) * tests::uniform(50 + world, thing, draw);
  }
};

constexpr std::uint64_t kBuildings = 60;

// Rough ground with ridges, and buildings in and beside the fan, many of which overlap; some are
// sunk into the ground, some rise over the sensor.
renderer::World random_world(std::uint64_t number) {
  std::uint64_t post = 0;
  terrain::HeightField field = tests::ground(kGround_m, 20.0, [&](double, double) {
    return Draws{number, 1000 + ++post}(0, -15.0, 15.0);
  });
  std::vector<tests::Body> bodies;
  for (std::uint64_t i = 0; i < kBuildings; ++i) {
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
  return tests::world(short_sensor(), std::move(field), {kGrass}, std::move(bodies));
}

// The same place above the scene, at heading `heading_rad` from north.
glm::dvec3 at_heading(const glm::dvec3& sensor_m, const glm::dvec3& to_m, double heading_rad) {
  const double distance_m = std::hypot(to_m.x - sensor_m.x, to_m.y - sensor_m.y);
  return {sensor_m.x + distance_m * std::sin(heading_rad),
          sensor_m.y + distance_m * std::cos(heading_rad), to_m.z};
}

double heading_rad(const glm::dvec3& sensor_m, const glm::dvec3& to_m) {
  return std::atan2(to_m.x - sensor_m.x, to_m.y - sensor_m.y);
}

// Places are put where `place` moves them to before their heights are chosen.
template <class Place>
std::vector<glm::dvec3> random_points(const renderer::World& world, std::uint64_t number,
                                      std::size_t count, const Place& place) {
  const terrain::HeightField& ground = *world.surfaces->terrain();
  const auto ground_m = [&](const glm::dvec3& at) {
    return ground.height_at(at.x, at.y).value_or(0.0);
  };
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Draws draw{number, 100000 + i};
    const double distance_m = draw(0, 20.0, i % 6 == 4 ? kGround_m : 620.0);
    const double azimuth_rad = core::radians(i % 6 == 5 ? draw(1, -8.0, 8.0) : draw(1, -2.0, 2.0));
    glm::dvec3 at = place({distance_m * std::sin(azimuth_rad), distance_m * std::cos(azimuth_rad), 0.0});
    const auto& solid = world.solids.prisms[static_cast<std::size_t>(
        draw(2, 0.0, static_cast<double>(world.solids.prisms.size())))];
    if (i % 6 == 1 || i % 6 == 2) {
      const std::vector<glm::dvec2>& ring = solid.rings_m.front();
      at = place(glm::dvec3(ring[0] + draw(3, 0.05, 0.95) * (ring[1] - ring[0]) +
                                draw(4, 0.05, 0.95) * (ring[3] - ring[0]),
                            0.0));
    }
    at.z = i % 6 == 1   ? solid.top_m + draw(5, 0.3, 3.0)
           : i % 6 == 2 ? solid.top_m - draw(5, 0.3, 10.0)
           : i % 6 == 3 ? ground_m(at) + 0.3
                        : ground_m(at) + draw(5, 0.3, 30.0);
    points.push_back(at);
  }
  return points;
}

std::vector<glm::dvec3> random_points(const renderer::World& world, std::uint64_t number,
                                      std::size_t count) {
  return random_points(world, number, count, [](const glm::dvec3& at) { return at; });
}

struct Answers {
  renderer::FanSums sums;
  std::vector<std::uint8_t> clear;
};

Answers ask_slices(const renderer::World& world, const sensors::AntennaFrame& antenna,
                   const std::vector<glm::dvec3>& to_m) {
  Answers answers;
  renderer::SightLines sight;
  sight.to_m = to_m;
  renderer::ProfileCaster(world, renderer::profile_sampling_for(kSlices))
      .cast(antenna, false, answers.sums, sight);
  answers.clear = sight.clear;
  return answers;
}

bool ray_clear(const renderer::World& world, const glm::dvec3& sensor_m, const glm::dvec3& to_m) {
  return !world.surfaces->occluded(sensor_m, to_m, renderer::kSightClearance_m);
}

// Whether the ray to a point within 1 mm of `to_m` answers `clear`.
bool clear_within_1_mm(const renderer::World& world, const glm::dvec3& sensor_m,
                       const glm::dvec3& to_m, bool clear) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double moved_m : {-1e-3, 0.0, 1e-3}) {
      glm::dvec3 at = to_m;
      at[axis] += moved_m;
      if (ray_clear(world, sensor_m, at) == clear) return true;
    }
  return false;
}

struct Count {
  int asked = 0, clear = 0, differ = 0, unexplained = 0;
};

// Answers for random points, of which those that differ must agree with the ray to the same point
// at some heading of the wedge, half a slice to the left and right.
Count against_rays(const sensors::AntennaFrame& antenna, int worlds, std::size_t points) {
  Count count;
  for (int number = 0; number < worlds; ++number) {
    const auto seed = static_cast<std::uint64_t>(number);
    const renderer::World world = random_world(seed);
    const std::vector<glm::dvec3> to_m = random_points(world, seed, points);
    const Answers found = ask_slices(world, antenna, to_m);
    const double half_rad = found.sums.step_rad / 8.0 / 2.0;  // 8 slices per sub-column
    for (std::size_t i = 0; i < to_m.size(); ++i) {
      const glm::dvec3& sensor_m = antenna.position_m;
      const bool clear = found.clear[i] != 0;
      ++count.asked;
      count.clear += clear;
      if (ray_clear(world, sensor_m, to_m[i]) == clear) continue;
      ++count.differ;
      constexpr int kSteps = 40;
      bool agrees = false;
      for (int step = -kSteps; step <= kSteps && !agrees; ++step) {
        const double turned_rad = heading_rad(sensor_m, to_m[i]) + half_rad * step / kSteps;
        agrees = ray_clear(world, sensor_m, at_heading(sensor_m, to_m[i], turned_rad)) == clear;
      }
      if (agrees) continue;
      ++count.unexplained;
      UNSCOPED_INFO("world " << number << ", point " << i << " kind " << i % 6 << " at " << to_m[i].x << ", "
                             << to_m[i].y << ", " << to_m[i].z << " clear " << clear);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("On a slice's own heading a point is seen as its ray sees it", "[profile]") {
  const glm::dvec3 sensor_m(3.0, -2.0, kHeight_m);
  const sensors::AntennaFrame antenna = tests::level_antenna(sensor_m);
  int asked = 0, seen = 0, within_1_mm = 0;
  for (std::uint64_t number = 0; number < 16; ++number) {
    const renderer::World world = random_world(number);
    const Answers layout = ask_slices(world, antenna, {});
    const double width_rad = layout.sums.step_rad / 8.0;
    const auto to_slice = [&](const glm::dvec3& at) {
      const double slice = std::floor(
          (heading_rad(sensor_m, at) - layout.sums.first_azimuth_rad) / width_rad);
      return at_heading(sensor_m, at, layout.sums.first_azimuth_rad + (slice + 0.5) * width_rad);
    };
    const std::vector<glm::dvec3> to_m = random_points(world, number, 600, to_slice);
    const Answers found = ask_slices(world, antenna, to_m);
    for (std::size_t i = 0; i < to_m.size(); ++i) {
      const bool clear = found.clear[i] != 0;
      ++asked;
      seen += clear;
      if (ray_clear(world, sensor_m, to_m[i]) == clear) continue;
      ++within_1_mm;
      INFO("world " << number << ", point " << i << " kind " << i % 6 << " at " << to_m[i].x << ", " << to_m[i].y << ", "
                    << to_m[i].z << " clear " << clear);
      CHECK(clear_within_1_mm(world, sensor_m, to_m[i], clear));
    }
  }
  WARN(asked << " seen " << seen << " w " << within_1_mm);
  CHECK(seen > asked / 5);
  CHECK(seen < asked * 4 / 5);
  CHECK(within_1_mm < asked / 1000);
}

TEST_CASE("Anywhere a point is seen as the ray at some heading of its slice's wedge sees it",
          "[profile]") {
  const Count count = against_rays(tests::level_antenna({3.0, -2.0, kHeight_m}), 16, 600);
  WARN(count.asked << " clear " << count.clear << " differ " << count.differ << " unexpl " << count.unexplained);
  CHECK(count.unexplained == 0);
  CHECK(count.differ < count.asked / 100);
  CHECK(count.clear > count.asked / 5);
}

TEST_CASE("A rolled and pitched antenna's slices answer as rays do", "[profile]") {
  const sensors::AntennaFrame antenna = sensors::antenna_frame(
      {3.0, -2.0, kHeight_m}, tests::level_pose(0.0).north_east_down,
      core::quaternion_from({core::radians(10.0), core::radians(-5.0), 0.0}), {}, false);
  REQUIRE(antenna.up.z < 0.99);
  const Count count = against_rays(antenna, 16, 600);
  WARN(count.asked << " clear " << count.clear << " differ " << count.differ << " unexpl " << count.unexplained);
  CHECK(count.unexplained == 0);
  CHECK(count.differ < count.asked / 100);
  CHECK(count.clear > count.asked / 5);
}

TEST_CASE("Rays answer for what slices do not reach", "[profile]") {
  // Behind and beside the fan, beyond the gate, off the grid, and where a model stands.
  const sensors::AntennaFrame antenna = tests::level_antenna({3.0, -2.0, kHeight_m});
  for (const bool small_ground : {false, true}) {
    renderer::World world = random_world(3);
    const double far_m = world.sensor.range.maximum_m();
    world.solids.others = {{{-30.0, 100.0, 0.0}, {3.0, 120.0, 10.0}}};
    (void)small_ground;
    std::vector<glm::dvec3> beyond;
    for (const glm::dvec3& at : random_points(world, 4, 20000)) {
      const double heading = heading_rad(antenna.position_m, at);
      const bool model = heading > std::atan2(-33.0, 102.0) && heading < 0.0;
      const bool beside = std::abs(heading) > core::radians(2.2);
      const bool far = std::hypot(at.x - 3.0, at.y + 2.0) > far_m + renderer::kSightClearance_m;
      if (model || beside || far) beyond.push_back(at);
    }
    const Answers found = ask_slices(world, antenna, beyond);
    CHECK(beyond.size() > 5000);
    for (std::size_t i = 0; i < beyond.size(); ++i)
      CHECK((found.clear[i] != 0) == ray_clear(world, antenna.position_m, beyond[i]));
  }
}
