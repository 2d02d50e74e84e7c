// A reflector surveyed in latitude, longitude and height appears where an independent calculation
// says it must.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/pose.h"
#include "core/units.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/stages/azimuth_beam.h"
#include "renderer/stages/point_targets.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "terrain/local_frame.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

struct Expected {
  double range_m, azimuth_rad, elevation_rad;
};

// By Earth-centred coordinates and textbook rotation at the sensor; shares nothing with the
// renderer's frames.
Expected seen_from(const core::Geodetic& sensor, double heading_rad, const core::Geodetic& target) {
  const auto ecef = [](const core::Geodetic& g) {
    constexpr double kA = 6378137.0, kF = 1.0 / 298.257223563;
    const double e2 = kF * (2.0 - kF);
    const double n = kA / std::sqrt(1.0 - e2 * std::sin(g.latitude_rad) * std::sin(g.latitude_rad));
    return glm::dvec3((n + g.height_m) * std::cos(g.latitude_rad) * std::cos(g.longitude_rad),
                      (n + g.height_m) * std::cos(g.latitude_rad) * std::sin(g.longitude_rad),
                      (n * (1.0 - e2) + g.height_m) * std::sin(g.latitude_rad));
  };
  const glm::dvec3 d = ecef(target) - ecef(sensor);
  const double sp = std::sin(sensor.latitude_rad), cp = std::cos(sensor.latitude_rad);
  const double sl = std::sin(sensor.longitude_rad), cl = std::cos(sensor.longitude_rad);
  const double east = -sl * d.x + cl * d.y;
  const double north = -sp * cl * d.x - sp * sl * d.y + cp * d.z;
  const double up = cp * cl * d.x + cp * sl * d.y + sp * d.z;
  const double range_m = std::sqrt(east * east + north * north + up * up);
  return {range_m, std::remainder(std::atan2(east, north) - heading_rad, 2.0 * core::kPi),
          std::asin(up / range_m)};
}

}  // namespace

TEST_CASE("A trihedral at a known position has the right row, column and watts from ten poses",
          "[target]") {
  const terrain::LocalFrame frame({core::radians(47.26), core::radians(11.35), 600.0});
  const core::Geodetic reflector{core::radians(47.2612), core::radians(11.3301), 583.0};
  constexpr double kEdge_m = 0.25;
  renderer::World world = tests::world(tests::hivision(), std::nullopt, {});
  const sensors::Sensor& sensor = world.sensor;
  // A trihedral turned to each pose in the loop has its peak RCS there: 4 pi a^4 / (3 lambda^2).
  const double peak_m2 =
      4.0 * core::kPi * std::pow(kEdge_m, 4) / (3.0 * std::pow(sensor.wavelength_m(), 2));

  for (int i = 0; i < 10; ++i) {
    const double heading_rad = core::radians(20.0 + 33.0 * i);
    const core::Geodetic ground = terrain::geodesic_point(
        reflector, heading_rad + core::kPi + core::radians(-16.0 + 3.7 * i), 350.0 + 320.0 * i);
    const core::Geodetic aircraft{ground.latitude_rad, ground.longitude_rad, 640.0 + 25.0 * i};
    const Expected expected = seen_from(aircraft, heading_rad, reflector);

    const glm::dvec3 at_m = frame.to_local_m(reflector);
    const glm::dvec3 to_radar = glm::normalize(frame.to_local_m(aircraft) - at_m);
    const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), to_radar));
    world.targets = {{"trihedral",
                      materials::TriangularTrihedral{kEdge_m},
                      {{0.0, at_m}},
                      glm::dmat3(to_radar, side, glm::cross(to_radar, side))}};

    renderer::FramePose pose;
    pose.position_m = frame.to_local_m(aircraft);
    pose.north_east_down = frame.north_east_down_at(aircraft);
    // Roll and pitch must not matter: the scan is stabilised.
    pose.q_NB =
        core::quaternion_from({core::radians(2.0 * i - 9.0), core::radians(3.0), heading_rad});
    const renderer::Frame picture = renderer::render_frame(world, {}, {}, {}, pose);

    double total_W = 0.0, peak_W = 0.0;
    int row = -1, column = -1;
    for (int k = 0; k < sensor.range.cells; ++k) {
      for (int c = 0; c < sensor.scan.columns; ++c) {
        const double power_W =
            picture.bscope_W[static_cast<std::size_t>(k * sensor.scan.columns + c)];
        total_W += power_W;
        if (power_W > peak_W) {
          peak_W = power_W;
          row = k;
          column = c;
        }
      }
    }
    INFO("pose " << i << " range " << expected.range_m);
    const double width_rad = sensor.scan.column_width_rad();
    CHECK(row ==
          static_cast<int>((expected.range_m - sensor.range.minimum_m) / sensor.range.cell_m));
    CHECK(column ==
          static_cast<int>((expected.azimuth_rad + sensor.scan.field_of_view_rad / 2) / width_rad));
    const double offset_rad =
        (column + 0.5) * width_rad - sensor.scan.field_of_view_rad / 2 - expected.azimuth_rad;
    const double expected_W =
        sensor.radar_constant_W_m2() * peak_m2 *
        sensors::two_way_gain(sensor.antenna.azimuth,
                              offset_rad * std::cos(expected.elevation_rad)) *
        sensors::two_way_gain(sensor.antenna.elevation,
                              expected.elevation_rad - sensor.antenna.boresight_elevation_rad) /
        std::pow(expected.range_m, 4);
    CHECK(10.0 * std::log10(peak_W / expected_W) == Approx(0.0).epsilon(0.0).margin(0.05));
    // Summed over columns: phi_eff in columns.
    const double summed_W = expected_W /
                            sensors::two_way_gain(sensor.antenna.azimuth,
                                                  offset_rad * std::cos(expected.elevation_rad)) *
                            sensors::two_way_width(sensor.antenna.azimuth) / width_rad /
                            std::cos(expected.elevation_rad);
    CHECK(10.0 * std::log10(total_W / summed_W) == Approx(0.0).epsilon(0.0).margin(0.05));
  }
}

TEST_CASE("R01 a point target falls with R^-4: -12.0412 dB per doubling", "[target]") {
  sensors::Sensor sensor = tests::hivision(8);
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const auto power_W = [&](double range_m) {
    // On the boresight elevation, so that the pattern is the same at both ranges.
    const double e = sensor.antenna.boresight_elevation_rad;
    world.targets = {{"sphere",
                      materials::ConstantRcs{1.0},
                      {{0.0, {0.0, range_m * std::cos(e), 100.0 + range_m * std::sin(e)}}},
                      glm::dmat3(1.0)}};
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(100.0));
    double sum = 0.0;
    for (const double value : frame.bscope_W) sum += value;
    return sum;
  };
  CHECK(10.0 * std::log10(power_W(2000.0) / power_W(1000.0)) ==
        Approx(-12.0412).epsilon(0.0).margin(1e-3));
}

TEST_CASE("A moving target is where its waypoints say", "[target]") {
  const renderer::PointTarget target{"car",
                                     materials::ConstantRcs{1.0},
                                     {{10.0, {0.0, 0.0, 0.0}}, {20.0, {100.0, 50.0, 0.0}}},
                                     glm::dmat3(1.0)};
  CHECK(target.position_at(0.0).x == 0.0);
  CHECK(target.position_at(15.0).x == Approx(50.0));
  CHECK(target.position_at(15.0).y == Approx(25.0));
  CHECK(target.position_at(99.0).x == 100.0);
}

TEST_CASE("A target and a small patch share one azimuth profile under an uneven beam", "[target]") {
  sensors::Sensor sensor = tests::hivision(40);
  sensors::BeamCut& cut = sensor.antenna.azimuth;
  cut.shape = sensors::BeamCut::Shape::table;
  cut.cut_rad = core::radians(1.0);
  cut.table_angle_rad = {core::radians(-1.0), 0.0, core::radians(0.5), core::radians(1.0)};
  cut.table_gain = {0.0, 1.0, 0.5, 0.25};

  // Unit power in one sub-column right of the middle.
  constexpr int kParts = 4;
  renderer::FanSums fan;
  fan.step_rad = sensor.scan.column_width_rad() / kParts;
  const int margin = renderer::margin_sub_columns(sensor, kParts);
  fan.sub_columns = 40 * kParts + 2 * margin;
  fan.first_azimuth_rad = -sensor.scan.field_of_view_rad / 2 - margin * fan.step_rad;
  fan.cells = 1;
  const int lit = margin + 20 * kParts + 1;
  std::vector<double> sums(static_cast<std::size_t>(fan.sub_columns), 0.0);
  sums[static_cast<std::size_t>(lit)] = 1.0 / fan.step_rad;
  const std::vector<double> patch = renderer::apply_azimuth_beam(sums, 1, fan, sensor, kParts);

  core::Echo echo;
  echo.range_m = sensors::range_middle_m(sensor.range, 100);
  echo.azimuth_rad = fan.first_azimuth_rad + (lit + 0.5) * fan.step_rad;
  echo.power_W = 1.0;
  std::vector<double> bscope_W(static_cast<std::size_t>(sensor.range.cells) * 40), none;
  renderer::add_echoes({echo}, sensor, bscope_W, none);
  for (std::size_t column = 0; column < 40; ++column) {
    INFO("column " << column);
    CHECK(bscope_W[100 * 40 + column] == Approx(patch[column]).epsilon(0.0).margin(1e-3));
  }
}

namespace {

// Of 1 m2, 1 km away and as high as the antenna.
void add_spheres(std::initializer_list<double> bearings_deg, renderer::World& world) {
  for (const double bearing_deg : bearings_deg) {
    const double bearing_rad = core::radians(bearing_deg);
    world.targets.push_back(
        {"sphere",
         materials::ConstantRcs{1.0},
         {{0.0, {1000.0 * std::sin(bearing_rad), 1000.0 * std::cos(bearing_rad), 60.0}}},
         glm::dmat3(1.0)});
  }
}

}  // namespace

TEST_CASE("A scan all round shows targets behind it, and one at 179.9 deg on both sides of 180",
          "[target]") {
  sensors::Sensor sensor = tests::hivision(360);
  sensor.scan.field_of_view_rad = 2.0 * core::kPi;
  renderer::World world = tests::world(sensor, std::nullopt, {});
  add_spheres({90.4, 135.4, 179.9}, world);
  const renderer::FramePose pose = tests::level_pose(60.0);
  const renderer::TargetEchoes found = renderer::unobstructed_echoes(
      world, sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB, {}, true),
      0.0);
  CHECK(found.unprojected == 0);
  REQUIRE(found.echoes.size() == 3);
  CHECK(found.echoes[1].azimuth_rad == Approx(core::radians(135.4)));

  const renderer::Frame frame = renderer::render_frame(world, {}, {}, {}, pose);
  CHECK(frame.unprojected == 0);
  const int row = sensors::range_row(sensor.range, 1000.0);
  const auto power_W = [&](int column) {
    return frame.bscope_W[static_cast<std::size_t>(row * 360 + column)];
  };
  for (const int column : {270, 315, 359}) {
    CHECK(power_W(column) > power_W(column - 1));
    CHECK(power_W(column) > power_W((column + 1) % 360));
  }
  const auto gain = [&](double offset_deg) {
    return sensors::two_way_gain(sensor.antenna.azimuth, core::radians(offset_deg));
  };
  CHECK(power_W(0) / power_W(359) == Approx(gain(0.6) / gain(0.4)).epsilon(1e-6));
}

TEST_CASE("A target abeam is seen where the outer columns' beams reach it", "[target]") {
  sensors::Sensor sensor = tests::hivision(75);
  sensor.scan.surface = sensors::ScanSurface::plane;
  sensor.scan.field_of_view_rad = core::radians(150.0);
  sensor.antenna.azimuth.half_power_width_rad = core::radians(60.0);
  sensor.antenna.azimuth.cut_rad = core::radians(75.0);
  sensor.antenna.azimuth.side_lobe_gain = sensor.antenna.azimuth.side_lobe_extent_rad = 0.0;
  renderer::World world = tests::world(sensor, std::nullopt, {});
  add_spheres({100.0, 151.0}, world);
  const renderer::FramePose pose = tests::level_pose(60.0);
  const renderer::Frame frame = renderer::render_frame(world, {}, {}, {}, pose);
  CHECK(frame.unprojected == 0);
  const auto row = static_cast<std::size_t>(sensors::range_row(sensor.range, 1000.0));
  CHECK(frame.bscope_W[row * 75 + 74] > 0.0);
  CHECK(frame.bscope_W[row * 75] == 0.0);
  const renderer::TargetEchoes found =
      renderer::unobstructed_echoes(world, renderer::antenna_of(sensor, pose), 0.0);
  REQUIRE(found.echoes.size() == 1);
  CHECK(found.echoes[0].azimuth_rad == Approx(core::radians(100.0)));
}

// Azimuths lie close together there: 10 m from the point below, 91 deg are 0.7 deg from the last column
// on the sky. It vanished at 90.
TEST_CASE(
    "Nearly below, a target a hair behind the antenna fades with the beam as one before it does",
    "[target]") {
  sensors::Sensor sensor = tests::hivision();
  sensor.antenna.boresight_elevation_rad = core::radians(-85.0);
  const double outermost_rad =
      sensors::column_middle_rad(sensor.scan, sensor.scan.columns - 1);  // 20.375 deg
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const double sky = 10.0 / std::hypot(10.0, 1000.0);
  const auto power_W = [&](double bearing_deg) {
    const double bearing_rad = core::radians(bearing_deg);
    world.targets = {{"sphere",
                      materials::ConstantRcs{1.0},
                      {{0.0, {10.0 * std::sin(bearing_rad), 10.0 * std::cos(bearing_rad), 0.0}}},
                      glm::dmat3(1.0)}};
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(1000.0));
    CHECK(frame.unprojected == 0);
    return frame.bscope_W[static_cast<std::size_t>(
        (sensors::range_row(sensor.range, 1000.05) + 1) * sensor.scan.columns - 1)];
  };
  const auto gain = [&](double bearing_deg) {
    return sensors::two_way_gain(sensor.antenna.azimuth,
                                 sky * (core::radians(bearing_deg) - outermost_rad));
  };
  const double before_W = power_W(89.0);
  REQUIRE(before_W > 0.0);
  for (const double bearing_deg : {91.0, 120.0, 145.0}) {
    INFO(bearing_deg);
    CHECK(power_W(bearing_deg) / before_W == Approx(gain(bearing_deg) / gain(89.0)).epsilon(1e-6));
  }
  // The cut of 1.25 deg is reached at 145.4 deg.
  CHECK(power_W(147.0) == 0.0);
}

TEST_CASE("Side lobes that reach behind the antenna show a target there", "[target]") {
  sensors::Sensor sensor = tests::hivision();
  sensor.antenna.azimuth.side_lobe_gain = 1e-3;
  sensor.antenna.azimuth.side_lobe_extent_rad = core::radians(90.0);
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const auto power_W = [&](double bearing_deg) {
    world.targets.clear();
    add_spheres({bearing_deg}, world);
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(60.0));
    return frame.bscope_W[static_cast<std::size_t>(
        (sensors::range_row(sensor.range, 1000.0) + 1) * sensor.scan.columns - 1)];
  };
  const double abeam_W = power_W(89.0);
  REQUIRE(abeam_W > 0.0);
  // 90 deg from the last column, at 20.375 deg.
  CHECK(power_W(110.0) == Approx(abeam_W).epsilon(1e-9));
  CHECK(power_W(111.0) == 0.0);
}

// It vanished where its azimuth, not its angle on the sky, left the beam.
TEST_CASE("Steeply below, a target that leaves the outermost column fades with the beam",
          "[target]") {
  sensors::Sensor sensor = tests::hivision();
  sensor.antenna.boresight_elevation_rad = core::radians(-60.0);
  const double outermost_rad =
      sensors::column_middle_rad(sensor.scan, sensor.scan.columns - 1);  // 20.375 deg
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const auto power_W = [&](double azimuth_deg) {
    const double azimuth_rad = core::radians(azimuth_deg);
    const glm::dvec3 along(0.5 * std::sin(azimuth_rad), 0.5 * std::cos(azimuth_rad),
                           -std::sqrt(0.75));
    world.targets = {{"sphere",
                      materials::ConstantRcs{1.0},
                      {{0.0, glm::dvec3(0.0, 0.0, 3000.0) + 2000.0 * along}},
                      glm::dmat3(1.0)}};
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(3000.0));
    return frame.bscope_W[static_cast<std::size_t>(
        (sensors::range_row(sensor.range, 2000.0) + 1) * sensor.scan.columns - 1)];
  };
  const auto gain = [&](double azimuth_deg) {
    return sensors::two_way_gain(sensor.antenna.azimuth,
                                 0.5 * (core::radians(azimuth_deg) - outermost_rad));
  };
  const double inside_W = power_W(20.375);
  REQUIRE(inside_W > 0.0);
  // The cut of 1.25 deg is reached at 22.875 deg.
  for (const double azimuth_deg : {21.74, 21.76, 22.86}) {
    INFO(azimuth_deg);
    CHECK(power_W(azimuth_deg) / inside_W == Approx(gain(azimuth_deg)).epsilon(1e-6));
  }
  CHECK(power_W(22.89) == 0.0);
}
