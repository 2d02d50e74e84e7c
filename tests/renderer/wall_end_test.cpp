// The end of an oblique wall that reaches a little into a range cell.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include "renderer/casting/sub_column.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

constexpr double kHeightBeforeWall_m = 75.0;
const glm::dvec3 kNearTop_m(5.0, 1000.0, 12.0);

// A wall that nearly faces the antenna, on black ground; a cell's far border is `deep_m` behind the
// wall's nearest point.
renderer::World oblique_wall(double deep_m) {
  sensors::Sensor sensor = tests::hivision(24);
  const double nearest_m = glm::distance(kNearTop_m, glm::dvec3(0.0, 0.0, kHeightBeforeWall_m));
  sensor.range.minimum_m = nearest_m + deep_m - 51.0 * sensor.range.cell_m;
  const glm::dvec3 along_m(40.0, 4.0, 0.0), down_m(0.0, 0.0, -kNearTop_m.z);
  return tests::world(sensor, tests::ground(4000.0, 250.0, [](double, double) { return 0.0; }),
                      {materials::PhongNrcs(0.0, 0.0, 1.0), materials::PhongNrcs(0.3, 0.0, 1.0)},
                      {tests::quad({kNearTop_m + down_m, kNearTop_m + down_m + along_m,
                                    kNearTop_m + along_m, kNearTop_m},
                                   1)});
}

// Of the cell that the wall's end reaches into, in all columns.
double end_W(const renderer::World& world, const renderer::Sampling& sampling) {
  const renderer::Frame frame =
      renderer::render_frame(world, sampling, {}, {}, tests::level_pose(kHeightBeforeWall_m));
  double sum_W = 0.0;
  for (int column = 0; column < world.sensor.scan.columns; ++column)
    sum_W += frame.bscope_W[static_cast<std::size_t>(50 * world.sensor.scan.columns + column)];
  return sum_W;
}

}  // namespace

// Half way to the range of a neighbour, which has another azimuth, few rays reach the wall's end:
// the cell would get 0.6 and 0.8 of its power, in every frame the same. Which rays are added
// between those that meet the wall and those that pass it costs a tenth still.
TEST_CASE("The end of an oblique wall in a range cell shows with its power", "[rays]") {
  for (const double deep_m : {0.1, 0.2}) {
    const renderer::World world = oblique_wall(deep_m);
    const double converged_W = end_W(world, renderer::reference_sampling(1));
    REQUIRE(converged_W > 0.0);
    INFO("end " << deep_m << " m inside the cell");
    CHECK(end_W(world, renderer::sampling_for(8.0)) / converged_W ==
          Approx(1.0).epsilon(0.0).margin(0.15));
  }
}

// A level edge that is high in many azimuths gets its share of each step only if these differ.
TEST_CASE("Sub-columns side by side look at elevations that fill a step evenly", "[rays]") {
  for (const int first : {0, 1, 17, 655})
    for (const int count : {2, 4, 8, 16, 32}) {
      std::vector<double> places;
      for (int i = 0; i < count; ++i) places.push_back(renderer::elevation_place(first + i, 0.5));
      std::sort(places.begin(), places.end());
      double widest = places.front() + 1.0 - places.back();
      for (std::size_t i = 1; i < places.size(); ++i)
        widest = std::max(widest, places[i] - places[i - 1]);
      INFO(count << " from " << first);
      CHECK(places.front() >= 0.0);
      CHECK(places.back() < 1.0);
      CHECK(widest < 4.0 / count);  // with equal ones 1
    }
  CHECK(renderer::elevation_place(0, 0.5) == 0.5);
}
