// R01 in closed form: every point scatterer falls with R^-4, whatever its shape.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "renderer/stages/point_targets.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

TEST_CASE("R01 every shape falls by 12.0412 dB per doubling of the range, to 1e-6 dB", "[R01]") {
  const sensors::Sensor sensor = tests::hivision(8);
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const double elevation_rad = sensor.antenna.boresight_elevation_rad;
  const glm::dvec3 sight(0.0, std::cos(elevation_rad), std::sin(elevation_rad));
  // x towards the radar: the same aspect at every range.
  const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), -sight));
  const glm::dmat3 axes(-sight, side, glm::cross(-sight, side));
  const sensors::AntennaFrame antenna{
      {0.0, 0.0, 200.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const materials::RcsModel& model : std::initializer_list<materials::RcsModel>{
           materials::ConstantRcs{3.0}, materials::Sphere{0.05},
           materials::TriangularTrihedral{0.2}, materials::SquareTrihedral{0.2},
           materials::Dihedral{0.1, 0.2}, materials::RectangularPlate{0.1, 0.2},
           materials::Cylinder{0.05, 0.5}, materials::RoundWire{0.001, 0.5},
           materials::LobedRcs{1.0, {}}}) {
    INFO("shape " << model.index());
    const auto power_W = [&](double range_m) {
      world.targets = {{"target", model, {{0.0, antenna.position_m + range_m * sight}}, axes}};
      const std::vector<core::Echo> echoes = renderer::point_echoes(world, antenna, 0.0);
      REQUIRE(echoes.size() == 1);
      CHECK(echoes[0].range_m == Approx(range_m));
      return echoes[0].power_W;
    };
    for (const double range_m : {300.0, 750.0, 1800.0})
      CHECK(10.0 * std::log10(power_W(2.0 * range_m) / power_W(range_m)) ==
            Approx(-12.041199826559248).margin(1e-6));
  }
}
