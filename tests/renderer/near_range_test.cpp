// R02, R03: echoes from no distance at all, and from straight below.
#include <catch2/catch.hpp>

#include "core/units.h"
#include "renderer/casting/echo_density.h"
#include "renderer/casting/interval_deposit.h"
#include "renderer/casting/packet_sender.h"
#include "renderer/casting/ray_aim.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using tests::kGrass;
using tests::kHeight_m;
using tests::same_bytes;

namespace {

// Rays of one sub-column from below up: `near_m` first, then level ground from 205 m on.
renderer::RayChain chain_over_ground(const std::vector<float>& near_m, bool near_is_hit) {
  renderer::RayChain chain;
  const int count = static_cast<int>(near_m.size()) + 60;
  chain.append(count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const bool near = i < near_m.size();
    const double range_m = near ? 0.0 : 205.0 + 5.0 * static_cast<double>(i - near_m.size());
    chain.elevation_rad[i] =
        near ? -0.4 + 0.01 * static_cast<double>(i) : -std::asin(60.0 / range_m);
    const bool hit = near_is_hit || !near;
    chain.range_m[i] = near ? (hit ? near_m[i] : 0.0F) : static_cast<float>(range_m);
    // A facet straight across the ray but for a hair: its piece stays where it is.
    chain.range_slope[i] =
        near ? 1e-9F : static_cast<float>(std::sqrt(range_m * range_m / 3600.0 - 1.0));
    const double square_m2 = std::max(
        static_cast<double>(chain.range_m[i]) * static_cast<double>(chain.range_m[i]), 1e-30);
    chain.density_W_per_rad2[i] = hit ? static_cast<float>(0.01 / square_m2) : 0.0F;
    chain.surface[i] = !hit ? terrain::kNoHit : near ? 100U + static_cast<std::uint32_t>(i) : 2U;
    chain.azimuth[i] = 0;
    chain.next[i] = i + 1 < static_cast<std::size_t>(count) ? static_cast<std::int32_t>(i) + 1
                                                            : renderer::RayChain::kEnd;
  }
  return chain;
}

struct Deposited {
  std::vector<double> range_W, elevation_W_m3;
  int blanked = 0;
};

Deposited deposited(const renderer::RayChain& chain, const sensors::Sensor& sensor) {
  renderer::DepositBins bins;
  Deposited result;
  renderer::IntervalDeposit deposit(sensor, true, 8.0, -0.41, 0.0, bins);
  result.blanked = deposit.add(chain, 0);
  result.range_W.resize(static_cast<std::size_t>(sensor.range.cells));
  result.elevation_W_m3.resize(static_cast<std::size_t>(sensor.display.cscope_rows));
  bins.range.copy_to(result.range_W.data());
  bins.elevation.copy_to(result.elevation_W_m3.data());
  return result;
}

// A sheet across the way of every ray, 10 m to each side of `centre_m`; `up`: level, else facing
// the sensor in the south.
terrain::PlacedMesh sheet(const glm::dvec3& centre_m, bool up) {
  const glm::dvec3 right(10.0, 0.0, 0.0),
      other = up ? glm::dvec3(0.0, 10.0, 0.0) : glm::dvec3(0.0, 0.0, 10.0);
  terrain::PlacedMesh placed;
  placed.mesh.vertices_m = {centre_m - right - other, centre_m + right - other,
                            centre_m + right + other, centre_m - right + other};
  placed.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  placed.mesh.triangle_material = {0, 0};
  placed.mesh.material_names = {"sheet"};
  placed.material_of_name = {0};
  return placed;
}

renderer::Frame frame_of(const sensors::Sensor& sensor, std::vector<tests::Body> bodies,
                         const renderer::Sampling& sampling, double height_m) {
  const renderer::World world = tests::world(sensor, std::nullopt, {kGrass}, std::move(bodies));
  return renderer::render_frame(world, sampling, {}, {{core::EffectId::thermal_noise}},
                                tests::level_pose(height_m));
}

// Straight down: three metres of range before the ground and three behind it.
sensors::Sensor looking_down(int cells) {
  sensors::Sensor sensor = tests::even_hivision(1);
  sensor.range.minimum_m = 57.0;
  sensor.range.cell_m = 6.0 / cells;
  sensor.range.cells = cells;
  return sensor;
}

}  // namespace

TEST_CASE("R02: hits at no range and before the first cell change no sum and are counted",
          "[near_range]") {
  const sensors::Sensor sensor = tests::hivision(1);
  const std::vector<float> near_m{0.0F, -0.0F, 1e-30F, 199.9999F};
  const Deposited without = deposited(chain_over_ground(near_m, false), sensor);
  const Deposited with = deposited(chain_over_ground(near_m, true), sensor);
  CHECK(without.blanked == 0);
  CHECK(with.blanked == 4);
  CHECK(same_bytes(with.range_W, without.range_W));
  CHECK(same_bytes(with.elevation_W_m3, without.elevation_W_m3));
  CHECK(with.range_W[5] > 0.0);
}

TEST_CASE("R02: a sensor on a sheet, a hair above one, and before a wall in the blind range",
          "[near_range]") {
  const sensors::Sensor sensor = tests::hivision(4);
  renderer::Sampling points = renderer::reference_sampling(1, 1);
  points.sub_columns = 4;
  points.largest_step_rad = 1e-3;
  for (const renderer::Sampling& sampling : {renderer::sampling_for(4.0), points}) {
    const renderer::Frame nothing = frame_of(sensor, {}, sampling, kHeight_m);
    struct Case {
      const char* name;
      glm::dvec3 centre_m;
      bool up;
      double sensor_m;
    };
    for (const Case& c : {Case{"t = -0", {0.0, 0.0, kHeight_m}, true, kHeight_m},
                          Case{"t = 1e-29", {0.0, 0.0, -1e-30}, true, 0.0},
                          Case{"just blind", {0.0, 199.0, kHeight_m}, false, kHeight_m}}) {
      INFO(c.name);
      const renderer::Frame frame =
          frame_of(sensor, {tests::Body(sheet(c.centre_m, c.up))}, sampling, c.sensor_m);
      CHECK(frame.blanked > 0);
      for (const double power_W : frame.bscope_W) REQUIRE(power_W == 0.0);
      for (const double power_W_m3 : frame.cscope_W_m3) REQUIRE(power_W_m3 == 0.0);
      CHECK(same_bytes(frame.bscope_grey, nothing.bscope_grey));
      CHECK(same_bytes(frame.cscope_grey, nothing.cscope_grey));
    }
    // The same wall one metre behind the border shows.
    const renderer::Frame seen =
        frame_of(sensor, {tests::Body(sheet({0.0, 201.0, kHeight_m}, false))}, sampling, kHeight_m);
    CHECK(*std::max_element(seen.bscope_W.begin(), seen.bscope_W.end()) > 0.0);
  }
}

TEST_CASE("R02: a point target in the blind range has no echo", "[near_range]") {
  renderer::World world = tests::world(tests::hivision(8), std::nullopt, {});
  const auto total_W = [&](double range_m) {
    world.targets = {
        {"post", materials::ConstantRcs{1.0}, {{0.0, {0.0, range_m, kHeight_m}}}, glm::dmat3(1.0)}};
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(kHeight_m));
    double sum_W = 0.0;
    for (const double power_W : frame.bscope_W) sum_W += power_W;
    return sum_W;
  };
  for (const double range_m : {0.0, 1e-30, 1e-3, std::nextafter(200.0, 0.0)})
    CHECK(total_W(range_m) == 0.0);
  CHECK(total_W(200.0) > 0.0);
}

TEST_CASE("R03: the patch straight down is phi (R2^2 - max(R1, h)^2) / 2, by slices and rays",
          "[near_range]") {
  // On the sky a beam is 1 / cos e wider over the ground: what a cell holds per radian of it is
  // K sigma0 integral of R dR / (cos psi R^4), and with a two-way gain of cos psi just what it
  // holds per radian of ground azimuth, K sigma0 integral of dA / R^4 with dA = R dR dphi.
  const materials::PhongNrcs constant(0.0, 0.01, 0.0);
  sensors::Sensor sensor = looking_down(60);
  sensors::BeamCut& beam = sensor.antenna.elevation;
  beam.table_angle_rad.clear();
  beam.table_gain.clear();
  for (int i = -18000; i <= 18000; ++i) {
    const double angle_rad = core::radians(i * 0.005);
    beam.table_angle_rad.push_back(angle_rad);
    beam.table_gain.push_back(std::sqrt(std::max(std::cos(angle_rad), 0.0)));
  }
  const renderer::World world = tests::world(
      sensor, tests::ground(200.0, 10.0, [](double, double) { return 0.0; }), {constant});
  for (const bool slices : {true, false}) {
    renderer::FanSums sums;
    const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
    if (slices) {
      renderer::ProfileCaster(world, renderer::profile_sampling_for(1)).cast(antenna, false, sums);
    } else {
      renderer::Sampling fine = renderer::sampling_for(1.0);  // 1e4 rays a cell of 3 m
      fine.rays_per_cell = 500.0;
      renderer::RayCaster(world, fine).cast(antenna, false, sums);
    }
    const double* const cells_W =
        sums.range_W_per_rad.data() +
        static_cast<std::size_t>(sums.sub_columns / 2) * static_cast<std::size_t>(sums.cells);
    double first_m2 = 0.0, second_m2 = 0.0;  // per radian, of [57, 60) and [60, 63)
    for (int k = 0; k < sums.cells; ++k) {
      REQUIRE(std::isfinite(cells_W[k]));
      const double near_m = sensor.range.minimum_m + sensor.range.cell_m * k;
      const double far_m = near_m + sensor.range.cell_m;
      // dA / R^4 back to dA, exactly for a cell that lies behind the ground's nearest point.
      const double area_m2 =
          cells_W[k] / (sensor.radar_constant_W_m2() * 0.01) * (near_m * near_m) * (far_m * far_m);
      (k < sums.cells / 2 ? first_m2 : second_m2) += area_m2;
    }
    INFO((slices ? "slices " : "rays ") << first_m2 << " and " << second_m2 << " m^2 per radian");
    // A ray's interval may reach over the edge by the rounding of a range.
    CHECK(first_m2 <= (slices ? 0.0 : 1e-5 * second_m2));
    CHECK(second_m2 == Approx(184.5).epsilon(0.01));
  }
}

TEST_CASE("R03: nothing diverges at depressions of 89, 89.9, 89.99 and 90 degrees",
          "[near_range]") {
  const materials::PhongNrcs constant(0.0, 0.01, 0.0);
  const sensors::Sensor sensor = looking_down(2);
  const renderer::World world = tests::world(
      sensor, tests::ground(200.0, 10.0, [](double, double) { return 0.0; }), {constant});
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  const renderer::PathLossTable clear = renderer::FramePathLoss(world).from(kHeight_m);
  const std::vector<double> depressions_deg{89.0, 89.9, 89.99, 90.0};
  renderer::RayBatch batch{};
  for (int i = 0; i < 4; ++i) {
    batch.elevation_rad[i] = -core::radians(depressions_deg[static_cast<std::size_t>(i)]);
    batch.offset_rad[i] = 0.0;
    batch.gain[i] = batch.column_cosine[i] = 1.0;
    batch.column_sine[i] = 0.0;
  }
  batch.close(4);
  renderer::RayAim(antenna, false, true).point(batch);
  renderer::PacketSender<8>(world.surfaces(), sensor.range, antenna.position_m, nullptr)
      .cast(batch);
  renderer::RayChain chain;
  chain.append(4);
  CHECK(renderer::EchoDensity(world, clear, antenna.position_m).shade(batch, 0, chain) == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    // K sigma0 / (sin(psi) R^2) with R = h / sin(psi).
    const double sine = std::sin(core::radians(depressions_deg[i]));
    CHECK(
        static_cast<double>(chain.density_W_per_rad2[i]) ==
        Approx(sensor.radar_constant_W_m2() * 0.01 * sine / (kHeight_m * kHeight_m)).epsilon(1e-5));
  }
  // A whole beam of it, with cells as the case has them: [57, 60) and [60, 63). No more than the
  // beam's footprint: phi R wide and 19.2 m long.
  renderer::FanSums sums;
  renderer::RayCaster(world, renderer::sampling_for(64.0)).cast(antenna, false, sums);
  const double footprint_m2 = 63.0 * std::sqrt(63.0 * 63.0 - kHeight_m * kHeight_m);  // per radian
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double* const cells_W = sums.range_W_per_rad.data() + 2 * sub;
    CHECK(cells_W[1] > 0.0);
    CHECK(cells_W[0] <= 0.01 * cells_W[1]);
    CHECK(cells_W[1] <=
          sensor.radar_constant_W_m2() * 0.01 * footprint_m2 / std::pow(kHeight_m, 4));
  }
}
