// The echo of rain against closed forms:
//   P(cell) = K phi_az * integral over the cell of eta L(R) / R^2 [ integral over free elevations of g_el^2 de ] dR
// with K = Pt G0^2 lambda^2 / (4 pi)^3, phi_az the integral of the squared azimuth pattern.
#include "renderer/stages/rain_echo.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/pose.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/plan/plan.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kBlack;
using tests::kHeight_m;

namespace {

constexpr double kFrequency_Hz = 35e9;

atmosphere::Weather rain(double rate_mm_per_h) {
  atmosphere::Weather weather;
  weather.rain_rate_mm_per_h = rate_mm_per_h;
  weather.rain_top_m = 12000.0;  // the beam stays below it
  weather.simulate_gas = weather.simulate_fog = weather.simulate_rain = false;
  return weather;
}

renderer::World rainy_world(const sensors::Sensor& sensor, bool with_ground,
                            const atmosphere::Weather& weather) {
  std::optional<terrain::HeightField> ground;
  if (with_ground) ground = tests::ground(4000.0, 20.0, [](double, double) { return 0.0; });
  renderer::World world = tests::world(sensor, std::move(ground), {kBlack});
  world.attenuation = atmosphere::PathAttenuation(weather, kFrequency_Hz);
  world.volume_echo.emplace(weather, kFrequency_Hz);
  return world;
}

renderer::Frame render(const renderer::World& world, bool echo = true,
                       renderer::Products products = {true, false}) {
  return renderer::render_frame(world, renderer::sampling_for(2.0), products,
                                {core::EffectSet{}.with(core::EffectId::rain_echo, echo)},
                                tests::level_pose(kHeight_m));
}

double two_way_gain_above(const sensors::Sensor& sensor, double lowest_rad) {
  const sensors::Antenna& antenna = sensor.antenna;
  return sensors::two_way_integral(antenna.elevation, lowest_rad - antenna.boresight_elevation_rad,
                                   antenna.elevation.cut_rad);
}

// Simpson over the cell.
double closed_form_W(const renderer::World& world, int cell, bool with_ground,
                     double loss_dB_per_km) {
  const sensors::Sensor& sensor = world.sensor;
  const double eta = world.volume_echo->eta_m2_per_m3({0.0, 0.0, kHeight_m});
  const double from_m = sensors::range_edge_m(sensor.range, cell);
  const double step_m = sensor.range.cell_m / 20.0;
  double sum = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double range_m = from_m + step_m * i;
    const double lowest_rad = with_ground ? -std::asin(kHeight_m / range_m) : -1.0;
    const double loss = std::pow(10.0, -0.2 * loss_dB_per_km * range_m / 1000.0);
    sum += (i == 0 || i == 20 ? 1.0
            : i % 2 == 1      ? 4.0
                              : 2.0) *
           two_way_gain_above(sensor, lowest_rad) * loss / (range_m * range_m);
  }
  return sensor.radar_constant_W_m2() * eta * sensors::two_way_width(sensor.antenna.azimuth) * sum *
         step_m / 3.0;
}

void check_cells(const renderer::World& world, bool with_ground, double loss_dB_per_km,
                 double tolerance_dB) {
  const sensors::Sensor& sensor = world.sensor;
  const renderer::Frame frame = render(world);
  double largest_dB = 0.0;
  int worst_cell = -1;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double expected_W = closed_form_W(world, cell, with_ground, loss_dB_per_km);
    for (int column = 0; column < sensor.scan.columns; ++column) {
      const double power_W =
          frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + column)];
      const double error_dB = std::abs(10.0 * std::log10(power_W / expected_W));
      if (error_dB > largest_dB) worst_cell = cell;
      largest_dB = std::max(largest_dB, error_dB);
    }
  }
  INFO("cell " << worst_cell);
  CHECK(largest_dB < tolerance_dB);
}

}  // namespace

TEST_CASE("A rain top within the beam cuts the echo where rays leave the rain", "[rain_echo]") {
  atmosphere::Weather weather = rain(10.0);
  weather.rain_top_m = 100.0;  // 40 m above the antenna
  const renderer::World world = rainy_world(tests::hivision(4), false, weather);
  const sensors::Sensor& sensor = world.sensor;
  const renderer::Frame frame = render(world);
  const double eta = world.volume_echo->eta_m2_per_m3({0.0, 0.0, kHeight_m});
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double range_m = sensors::range_middle_m(sensor.range, cell);
    const double from_m = sensors::range_edge_m(sensor.range, cell);
    const sensors::Antenna& antenna = sensor.antenna;
    // Elevations below the top: sin e < 40 m / R.
    const double gain_rad = sensors::two_way_integral(
        antenna.elevation, -antenna.elevation.cut_rad,
        std::asin(std::min(40.0 / range_m, 1.0)) - antenna.boresight_elevation_rad);
    const double expected_W = sensor.radar_constant_W_m2() * eta *
                              sensors::two_way_width(antenna.azimuth) * gain_rad *
                              sensor.range.cell_m / (from_m * (from_m + sensor.range.cell_m));
    const double power_W = frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + 2)];
    INFO(range_m);
    // A step of 0.1 deg in the middle of the beam is worth 1.5 % of it.
    REQUIRE(std::abs(10.0 * std::log10(power_W / expected_W)) < 0.05);
  }
}

TEST_CASE("Rain in free space returns the volume radar equation", "[rain_echo]") {
  const renderer::World world = rainy_world(tests::hivision(6), false, rain(10.0));
  check_cells(world, false, 0.0, 1e-6);
}

TEST_CASE("The ground cuts the lower part of the beam out of the rain", "[rain_echo]") {
  const renderer::World world = rainy_world(tests::hivision(6), true, rain(10.0));
  // At 200 m range the ground takes 3 % of the beam, at 3.7 km 38 %.
  check_cells(world, true, 0.0, 0.02);
}

TEST_CASE("Rain dims its own echo", "[rain_echo]") {
  atmosphere::Weather weather = rain(25.0);
  weather.simulate_rain = true;
  const renderer::World world = rainy_world(tests::hivision(4), false, weather);
  // P.838-3 at 35 GHz, 25 mm/h, horizontal: 6.2067 dB/km (case A01), 45 dB at the far end.
  check_cells(world, false, 6.2067, 0.01);
}

// From 6 km beside the origin on, where level is a milliradian off, every azimuth had profiles of its own
// every 0.1 deg: fifty times the time.
TEST_CASE("A leaning antenna hears uniform rain as a level one does, along as few directions",
          "[rain_echo]") {
  atmosphere::Weather weather = rain(10.0);
  weather.simulate_rain = weather.simulate_gas = true;
  const renderer::World world = rainy_world(tests::hivision(), false, weather);
  const auto leaning = [](double roll_rad, double pitch_rad) {
    renderer::FramePose pose = tests::level_pose(kHeight_m);
    pose.north_east_down =
        pose.north_east_down * glm::mat3_cast(core::quaternion_from({roll_rad, pitch_rad, 0.0}));
    return pose;
  };
  const auto frame_from = [&](const renderer::FramePose& pose) {
    return renderer::render_frame(world, renderer::sampling_for(2.0), {true, false},
                                  {{core::EffectId::rain_echo}}, pose);
  };
  const renderer::Frame level = frame_from(leaning(0.0, 0.0)),
                        leant = frame_from(leaning(0.004, 0.003));  // 5 mrad
  double largest_dB = 0.0;
  for (std::size_t i = 0; i < level.bscope_W.size(); ++i)
    largest_dB =
        std::max(largest_dB, std::abs(10.0 * std::log10(leant.bscope_W[i] / level.bscope_W[i])));
  CHECK(largest_dB < 0.01);
  CHECK(largest_dB > 0.0);

  const auto directions = [&](const renderer::World& of, const renderer::FramePose& pose) {
    return renderer::rain_directions(of, renderer::antenna_of(of.sensor, pose));
  };
  const double smooth_rad = directions(world, leaning(0.0, 0.0)).step_rad;
  CHECK(smooth_rad > core::radians(1.0));
  CHECK(directions(world, leaning(0.0, 0.0)).shared);
  CHECK(directions(world, leaning(0.004, 0.003)).shared);
  CHECK(directions(world, leaning(0.004, 0.003)).step_rad == smooth_rad);
  // A banked one, and one that leans where fog ends within the beam, see no two azimuths alike; the
  // rain is uniform all the same.
  CHECK_FALSE(directions(world, leaning(0.3, 0.0)).shared);
  CHECK(directions(world, leaning(0.3, 0.0)).step_rad == smooth_rad);
  weather.simulate_fog = true;
  weather.liquid_water_g_per_m3 = 0.5;
  weather.fog_top_m = 100.0;
  const renderer::World foggy = rainy_world(tests::hivision(), false, weather);
  CHECK(directions(foggy, leaning(0.0, 0.0)).shared);
  CHECK_FALSE(directions(foggy, leaning(0.004, 0.003)).shared);
  // What the tilt lifts counts: 16 mrad are 59 m at 3.7 km, 87 m at 5.4 km.
  sensors::Sensor far = tests::hivision();
  far.range.cell_m *= 1.5;
  REQUIRE(far.range.maximum_m() * 0.016 == Approx(87.1).epsilon(0.0).margin(0.1));
  const renderer::World wide = rainy_world(far, false, rain(10.0));
  CHECK(directions(world, leaning(0.016, 0.0)).shared);
  CHECK_FALSE(directions(wide, leaning(0.016, 0.0)).shared);
  CHECK(directions(wide, leaning(0.012, 0.0)).shared);
  // A rain top within the beam is looked at closely.
  weather.rain_top_m = 100.0;
  const renderer::World low = rainy_world(tests::hivision(), false, weather);
  CHECK(directions(low, leaning(0.0, 0.0)).step_rad < smooth_rad / 10.0);
}

TEST_CASE("Rain echo in the C-scope holds the power of the B-scope", "[rain_echo]") {
  sensors::Sensor sensor = tests::hivision(4);
  // A window as tall as the whole elevation pattern.
  sensor.display.cscope_top_rad =
      sensor.antenna.boresight_elevation_rad + sensor.antenna.elevation.cut_rad;
  sensor.display.cscope_span_rad = 2.0 * sensor.antenna.elevation.cut_rad;
  const renderer::World world = rainy_world(sensor, true, rain(10.0));
  const renderer::Frame frame = render(world, true, {true, true});
  double by_range = 0.0;
  for (std::size_t i = 0; i < frame.bscope_W.size(); ++i) {
    const double range_m =
        sensors::range_middle_m(sensor.range, static_cast<int>(i) / sensor.scan.columns);
    by_range += frame.bscope_W[i] * range_m * range_m * range_m;
  }
  double by_elevation = 0.0;
  for (const double value : frame.cscope_W_m3) by_elevation += value;
  CHECK(by_elevation == Approx(by_range).epsilon(1e-9));
}

TEST_CASE("A building hides the rain behind it", "[rain_echo]") {
  const sensors::Sensor sensor = tests::hivision(2);
  renderer::World world = rainy_world(sensor, false, rain(10.0));
  // A screen across the whole beam 1 km ahead: 500 m tall, 200 m wide.
  world.geometry = tests::geometry(
      std::nullopt, {}, {tests::box({-400.0, 1000.0, -500.0}, {400.0, 1010.0, 800.0}, 0).mesh});
  const renderer::Frame frame = render(world);
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double power_W = frame.bscope_W[static_cast<std::size_t>(cell * 2)];
    INFO(sensors::range_middle_m(sensor.range, cell));
    if (sensors::range_edge_m(sensor.range, cell + 1) < 1000.0) CHECK(power_W > 0.0);
    // The beam reaches down to -19.4 deg: the screen is 1000 to 1061 m away.
    if (sensors::range_edge_m(sensor.range, cell) > 1068.0) CHECK(power_W == 0.0);
  }
}

// What lies behind is free where the beam passes beside: the share of its two-way pattern there. One
// azimuth a column left it a tenth of the pattern off, whatever the sampling.
TEST_CASE("The side of a building cuts the rain behind it where it stands", "[rain_echo]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const renderer::World open = rainy_world(sensor, false, rain(10.0));
  const int cell = sensors::range_row(sensor.range, 2000.0);
  const auto row_of = [&](const renderer::World& world, double samples) {
    const renderer::Frame frame =
        renderer::render_frame(world, renderer::sampling_for(samples), {true, false},
                               {{core::EffectId::rain_echo}}, tests::level_pose(kHeight_m));
    return std::vector<double>(frame.bscope_W.begin() + cell * 8,
                               frame.bscope_W.begin() + cell * 8 + 8);
  };
  const double full_W = row_of(open, 4.0)[3];
  for (const double side_m : {-3.1, -1.5, 0.2, 2.4}) {
    renderer::World world = rainy_world(sensor, false, rain(10.0));
    world.geometry = tests::geometry(
        std::nullopt, {}, {tests::box({side_m, 1000.0, -500.0}, {600.0, 1010.0, 800.0}, 0).mesh});
    const double side_rad = std::atan2(side_m, 1000.0);
    for (const double samples : {4.0, 32.0}) {
      const std::vector<double> row_W = row_of(world, samples);
      for (int column = 0; column < 8; ++column) {
        const sensors::BeamCut& beam = sensor.antenna.azimuth;
        const double from_rad = side_rad - sensors::column_middle_rad(sensor.scan, column);
        const double share =
            sensors::two_way_integral(beam, -beam.cut_rad, from_rad) / sensors::two_way_width(beam);
        INFO("side at " << side_m << " m, column " << column << ", " << samples << " rays");
        CHECK(row_W[static_cast<std::size_t>(column)] / full_W ==
              Approx(share).epsilon(0.0).margin(samples > 10.0 ? 0.03 : 0.06));
      }
    }
  }
}

TEST_CASE("A shower echoes and takes away in the azimuths that pass through it alone",
          "[rain_echo]") {
  const sensors::Sensor sensor = tests::hivision();
  atmosphere::Weather weather = rain(2.0);
  weather.simulate_rain = true;
  const renderer::World beside = rainy_world(sensor, true, weather);
  atmosphere::RainCell shower;  // 200 m wide at 10 deg to the right
  shower.centre_m = {1500.0 * std::sin(core::radians(10.0)),
                     1500.0 * std::cos(core::radians(10.0))};
  shower.radius_m = 100.0;
  shower.rain_rate_mm_per_h = 30.0;
  weather.rain_cells = {shower};
  renderer::World wet = rainy_world(sensor, true, weather);
  wet.rain_cells = atmosphere::RainCells(weather, kFrequency_Hz);
  const renderer::Frame without = render(beside), with = render(wet);
  const auto ratio = [&](double azimuth_rad, double range_m) {
    const auto at =
        static_cast<std::size_t>(sensors::range_row(sensor.range, range_m) * sensor.scan.columns +
                                 sensors::azimuth_column(sensor.scan, azimuth_rad));
    return with.bscope_W[at] / without.bscope_W[at];
  };
  const double eta_ratio = wet.volume_echo->eta_m2_per_m3({shower.centre_m, 20.0}) /
                           wet.volume_echo->eta_m2_per_m3({0.0, 0.0, 20.0});
  const auto left_at = [&](double level_m) {
    const glm::dvec2 there = shower.centre_m * (level_m / 1500.0);
    return wet.rain_cells->two_way_power_factor({0.0, 0.0, kHeight_m}, {there, kHeight_m});
  };
  // The beam is 0.8 deg wide, the shower 7.6 deg: its rays cross nearly the same of it. A cell is
  // 6.7 m deep, and 10 m of this rain take 3 %.
  CHECK(ratio(core::radians(10.0), 1410.0) == Approx(eta_ratio * left_at(1410.0)).epsilon(0.03));
  CHECK(ratio(core::radians(10.0), 2500.0) == Approx(left_at(3000.0)).epsilon(0.02));
  for (const double range_m : {1410.0, 2500.0})
    for (const double azimuth_deg : {-12.0, -10.0, 0.0, 3.0})
      CHECK(ratio(core::radians(azimuth_deg), range_m) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("No rain and rain echo off give the same bytes", "[rain_echo]") {
  const sensors::Sensor sensor = tests::hivision(4);
  const renderer::World dry = rainy_world(sensor, true, rain(0.0));
  CHECK(render(dry, true).bscope_W == render(dry, false).bscope_W);
}

TEST_CASE("The plan runs the rain echo where it shows and says why not", "[rain_echo]") {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.highest_m = 300.0;
  const auto decision = [&](double eta) {
    facts.largest_eta_m2_per_m3 = eta;
    for (const core::EffectDecision& found : renderer::plan(facts, 0.5, {}).decisions)
      if (found.effect == core::EffectId::rain_echo) return found;
    return core::EffectDecision{};
  };
  CHECK_FALSE(decision(0.0).on);
  CHECK(decision(0.0).reason == "nothing falls in this scene");
  CHECK(decision(3.4e-4).on);
  // What is left out changes no pixel by more than its bound.
  const core::EffectDecision tiny = decision(2e-12);
  CHECK_FALSE(tiny.on);
  CHECK(tiny.bound_grey > 0.0);
}

TEST_CASE("A06 more rain never brightens a surface", "[rain_echo]") {
  const sensors::Sensor sensor = tests::hivision(4);
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 20.0, [](double, double) { return 0.0; }),
                   {materials::PhongNrcs(0.0325, 0.136, 1.99)});
  std::vector<double> before;
  for (int step = 0; step <= 20; ++step) {
    atmosphere::Weather weather = rain(7.5 * step);
    weather.simulate_rain = true;
    world.attenuation = atmosphere::PathAttenuation(weather, kFrequency_Hz);
    const std::vector<double> now = render(world, false).bscope_W;
    if (step > 0)
      for (std::size_t i = 0; i < now.size(); ++i) REQUIRE(now[i] <= before[i]);
    before = now;
  }
}
