// The same local scene at other places of the Earth: what may change is the curvature of the
// ground, as its closed form says, and nothing else.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "core/units.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;
using core::radians;
using renderer::CasterKind;
using terrain::EarthModel;
using tests::TemporaryFolder;

namespace {

struct Site {
  double latitude_deg, longitude_deg;
};

constexpr Site kHome{52.0, 10.0};

// 1 / radius of curvature of WGS 84 along the meridian and across it (NIMA TR8350.2).
struct Curvature {
  double north_per_m, east_per_m;
};

Curvature curvature_at(double latitude_deg) {
  constexpr double kSemiMajorAxis_m = 6378137.0;
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
  const double w2 = 1.0 - kEccentricity2 * std::pow(std::sin(radians(latitude_deg)), 2);
  const double east_m = kSemiMajorAxis_m / std::sqrt(w2);
  return {w2 / (east_m * (1.0 - kEccentricity2)), 1.0 / east_m};
}

std::string place_text(const core::Geodetic& at) {
  std::ostringstream text;
  text.precision(17);
  text << "{ latitude_deg = " << core::degrees(at.latitude_rad)
       << ", longitude_deg = " << core::degrees(at.longitude_rad);
  return text.str();
}

// A scene by its local metres: level grass.
struct LocalScene {
  std::string ground{};   // more of [terrain]
  bool town = false;      // 60 boxes among which the radar looks
  double above_m = 60.0;  // of the radar
  double heading_deg = 0.0;
};

std::string text_at(const LocalScene& scene, const Site& site, EarthModel earth) {
  const core::Geodetic origin{radians(site.latitude_deg), radians(site.longitude_deg), 0.0};
  const terrain::LocalFrame frame(origin, earth);
  std::string text = "[scene]\nname = \"place\"\norigin = " + place_text(origin) +
                     ", height_m = 0.0 }\nvertical_datum = \"ellipsoid\"\nearth = \"" +
                     (earth == EarthModel::plane ? "plane" : "wgs84") +
                     "\"\n[terrain]\nhalf_extent_m = 4000.0\nspacing_m = 20.0\n" + scene.ground;
  for (int i = 0; scene.town && i < 60; ++i) {
    const double ahead_m = 250.0 + 55.0 * i;
    const double right_m = (i % 7 - 3) * 0.09 * ahead_m;
    const double c = std::cos(radians(scene.heading_deg)), s = std::sin(radians(scene.heading_deg));
    const core::Geodetic at =
        frame.to_geodetic({ahead_m * s + right_m * c, ahead_m * c - right_m * s, 0.0});
    text += "[[box]]\nname = \"box " + std::to_string(i) + "\"\nat = " + place_text(at) +
            " }\nlength_m = 30.0\nwidth_m = 20.0\nheight_m = 8.0\nheading_deg = " +
            std::to_string((i * 11) % 360) + ".0\n";
  }
  return text + "[trajectory.fixed]\nat = " + place_text(origin) +
         " }\nheading_deg = " + core::number_text(scene.heading_deg) +
         "\nabove_ground_m = " + core::number_text(scene.above_m) + "\n";
}

struct Rendered {
  std::unique_ptr<scenes::Scene> scene;
  renderer::Frame frame;
};

Rendered rendered(const TemporaryFolder& folder, const std::string& text, CasterKind kind) {
  Rendered result{tests::good_scene(folder, text), {}};
  result.frame = renderer::render_frame(
      result.scene->world, renderer::default_sampling(kind), {.bscope = true, .cscope = false},
      renderer::effects_of(result.scene->plan, 1), result.scene->frame_pose(0));
  return result;
}

renderer::Frame frame_at(const LocalScene& scene, const Site& site, EarthModel earth,
                         CasterKind kind) {
  const TemporaryFolder folder;
  return rendered(folder, text_at(scene, site, earth), kind).frame;
}

// The same on ground that is bent at `site` as that of home is.
renderer::Frame bent_as_at_home(LocalScene scene, const Site& site, CasterKind kind) {
  const Curvature here = curvature_at(site.latitude_deg);
  const Curvature home = curvature_at(kHome.latitude_deg);
  const terrain::LocalFrame frame({radians(site.latitude_deg), radians(site.longitude_deg), 0.0});
  const int half_rows = 42;
  const int half_columns =
      static_cast<int>(std::ceil(half_rows / std::cos(radians(site.latitude_deg))));
  const tests::AsciiGrid grid{2 * half_columns, 2 * half_rows,
                              site.longitude_deg - 0.001 * half_columns,
                              site.latitude_deg - 0.001 * half_rows, 0.001};
  const TemporaryFolder folder;
  grid.write(folder, "bent", [&](int column, int row) {
    const glm::dvec3 at_m =
        frame.to_local_m({radians(grid.post_y(row)), radians(grid.post_x(column)), 0.0});
    std::ostringstream height_m;
    height_m.precision(12);
    height_m << 0.5 * ((here.north_per_m - home.north_per_m) * at_m.y * at_m.y +
                       (here.east_per_m - home.east_per_m) * at_m.x * at_m.x);
    return height_m.str();
  });
  scene.ground += "elevation = \"bent.asc\"\n";
  return rendered(folder, text_at(scene, site, EarthModel::wgs84), kind).frame;
}

// Of the cells that receive anything in either picture, by how much they differ.
struct Difference {
  double above_thousandth = 0.0, above_half = 0.0;  // shares, of 0.001 dB and 0.5 dB
};

Difference difference(const renderer::Frame& a, const renderer::Frame& b) {
  double lit = 0.0;
  Difference shares;
  for (std::size_t i = 0; i < a.bscope_W.size(); ++i) {
    if (a.bscope_W[i] == 0.0 && b.bscope_W[i] == 0.0) continue;
    lit += 1.0;
    const double change_dB = std::abs(10.0 * std::log10(b.bscope_W[i] / a.bscope_W[i]));
    if (!(change_dB <= 0.001)) shares.above_thousandth += 1.0;
    if (!(change_dB <= 0.5)) shares.above_half += 1.0;
  }
  shares.above_thousandth /= lit;
  shares.above_half /= lit;
  return shares;
}

const LocalScene kTown{.town = true};

// Coordinates rounded elsewhere turn a few rays at edges: at most 0.15 % and 0.005 % of the cells
// were found.
void check_same(const Difference& shares, CasterKind kind) {
  CHECK(shares.above_thousandth < (kind == CasterKind::rays ? 0.005 : 0.001));
  CHECK(shares.above_half < (kind == CasterKind::rays ? 0.0005 : 0.00005));
}

TEST_CASE(
    "T05 moved along its parallel, across the date line or to the other hemisphere a town is "
    "the same picture",
    "[place_on_earth]") {
  for (const CasterKind kind : {CasterKind::rays, CasterKind::profile}) {
    const renderer::Frame home = frame_at(kTown, kHome, EarthModel::wgs84, kind);
    for (const Site& site : {Site{52.0, 110.0}, Site{52.0, 180.0}, Site{-52.0, 10.0}}) {
      INFO(site.latitude_deg << ", " << site.longitude_deg);
      check_same(difference(home, frame_at(kTown, site, EarthModel::wgs84, kind)), kind);
    }
  }
}

TEST_CASE(
    "T03 at another latitude a town changes by the curvature of its ground alone: bent back, "
    "it is the same picture",
    "[place_on_earth]") {
  for (const CasterKind kind : {CasterKind::rays, CasterKind::profile}) {
    const renderer::Frame home = frame_at(kTown, kHome, EarthModel::wgs84, kind);
    for (const Site& site : {Site{0.0, 10.0}, Site{70.0, 10.0}}) {
      INFO(site.latitude_deg << ", " << site.longitude_deg);
      check_same(difference(home, bent_as_at_home(kTown, site, kind)), kind);
      const Difference round = difference(home, frame_at(kTown, site, EarthModel::wgs84, kind));
      CHECK(round.above_thousandth > 0.002);
      // Rays miss the edge of a roof or meet it. Slices cut edges in closed form.
      CHECK(round.above_half < (kind == CasterKind::rays ? 0.03 : 0.0001));
    }
  }
}

TEST_CASE("T05 on a plane Earth a town is the same picture anywhere, at the poles too",
          "[place_on_earth]") {
  for (const CasterKind kind : {CasterKind::rays, CasterKind::profile}) {
    const renderer::Frame home = frame_at(kTown, kHome, EarthModel::plane, kind);
    for (const Site& site : {Site{0.0, 10.0}, Site{52.0, 180.0}, Site{89.99, -20.0},
                             Site{90.0, 10.0}, Site{-90.0, 10.0}}) {
      INFO(site.latitude_deg << ", " << site.longitude_deg);
      check_same(difference(home, frame_at(kTown, site, EarthModel::plane, kind)), kind);
    }
  }
}

TEST_CASE("T05 a radar that stands on a pole looks along the meridian that its longitude names",
          "[place_on_earth]") {
  const LocalScene level;
  for (const EarthModel earth : {EarthModel::wgs84, EarthModel::plane})
    for (const double latitude_deg : {90.0, -90.0}) {
      const TemporaryFolder folder;
      const auto scene = tests::good_scene(folder, text_at(level, {latitude_deg, 77.0}, earth));
      const renderer::FramePose pose = scene->frame_pose(0);
      CHECK(glm::distance(pose.position_m, glm::dvec3(0.0, 0.0, 60.0)) < 1e-6);
      CHECK(glm::distance(pose.north_east_down[0], glm::dvec3(0.0, 1.0, 0.0)) < 1e-9);
      CHECK(glm::distance(pose.north_east_down[1], glm::dvec3(1.0, 0.0, 0.0)) < 1e-9);
    }
}

// Of level ground at a range, from the triangle of sensor, ground and the centre of curvature.
struct LevelGround {
  double sin_grazing, elevation_rad;
};

LevelGround level_ground(double above_m, double range_m, double curvature_per_m) {
  const double radius_m = 1.0 / curvature_per_m;
  const double drop = above_m * (2.0 * radius_m + above_m);  // (R + h)^2 - R^2
  return {(drop - range_m * range_m) / (2.0 * radius_m * range_m),
          -std::asin((drop + range_m * range_m) / (2.0 * (radius_m + above_m) * range_m))};
}

}  // namespace

TEST_CASE("T03 level ground elsewhere on the ellipsoid changes as its curvature says, and not more",
          "[place_on_earth]") {
  LocalScene scene;
  scene.above_m = 5.0;  // the lower, the more curvature tells
  for (const CasterKind kind : {CasterKind::rays, CasterKind::profile})
    for (const double heading_deg : {0.0, 90.0}) {
      scene.heading_deg = heading_deg;
      const TemporaryFolder folder;
      const Rendered home = rendered(folder, text_at(scene, kHome, EarthModel::wgs84), kind);
      const Rendered away = rendered(folder, text_at(scene, {0.0, 10.0}, EarthModel::wgs84), kind);
      const sensors::Sensor& sensor = home.scene->world.sensor;
      const std::vector<std::string>& names = home.scene->world.geometry->material_names;
      const auto name = std::find(names.begin(), names.end(), "short_grass");
      REQUIRE(name != names.end());
      const materials::NrcsCurve& grass =
          home.scene->world.nrcs[static_cast<std::size_t>(name - names.begin())];
      const auto level_dB = [&](double latitude_deg, double range_m, double azimuth_rad) {
        const Curvature curvature = curvature_at(latitude_deg);
        const double bearing_rad = radians(heading_deg) + azimuth_rad;
        const LevelGround ground =
            level_ground(scene.above_m, range_m,  // Euler's theorem
                         curvature.north_per_m * std::pow(std::cos(bearing_rad), 2) +
                             curvature.east_per_m * std::pow(std::sin(bearing_rad), 2));
        return 10.0 * std::log10(grass.sigma0(ground.sin_grazing) *
                                 sensors::two_way_gain(sensor.antenna.elevation,
                                                       ground.elevation_rad -
                                                           sensor.antenna.boresight_elevation_rad));
      };
      double largest_dB = 0.0, worst_dB = 0.0, squares_dB2 = 0.0, cells = 0.0;
      for (int row = 30; row < sensor.range.cells; ++row)
        for (int column = 10; column < sensor.scan.columns - 10; ++column) {
          const auto cell = static_cast<std::size_t>(row * sensor.scan.columns + column);
          const double range_m = sensors::range_middle_m(sensor.range, row);
          const double azimuth_rad = sensors::column_middle_rad(sensor.scan, column);
          const double expected_dB = level_dB(0.0, range_m, azimuth_rad) -
                                     level_dB(kHome.latitude_deg, range_m, azimuth_rad);
          const double found_dB =
              10.0 * std::log10(away.frame.bscope_W[cell] / home.frame.bscope_W[cell]);
          largest_dB = std::max(largest_dB, std::abs(expected_dB));
          worst_dB = std::max(worst_dB, std::abs(found_dB - expected_dB));
          squares_dB2 += std::pow(found_dB - expected_dB, 2);
          cells += 1.0;
        }
      // North of the equator's radar the ground falls away fastest.
      CHECK(largest_dB == Approx(heading_deg == 0.0 ? 0.0073 : 0.0029).epsilon(0.05));
      // Rounding of floats in the ray caster: 3.5e-4 dB in the worst of 71 000 cells, 5e-5 RMS;
      // slices 4e-5.
      CHECK(worst_dB < (kind == CasterKind::rays ? 0.0007 : 0.0001));
      CHECK(std::sqrt(squares_dB2 / cells) < (kind == CasterKind::rays ? 0.0001 : 0.00002));
    }
}
