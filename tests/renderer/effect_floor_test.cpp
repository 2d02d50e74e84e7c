// What an added power can change, against closed forms: over the display's floor, over noise, in a
// realisation, and in each picture.
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "core/effect_plan.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/plan/plan.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"
#include "tests/renderer/test_worlds.h"

namespace fanbeam {
namespace {

using sensors::Display;

double change_dB(double ratio) { return 10.0 * std::log10(1.0 + ratio); }

renderer::SceneFacts facts_with(Display::CScopeMode mode) {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.sensor.display.cscope_mode = mode;
  return facts;
}

// `power_W` in one cell, nothing elsewhere.
renderer::AddedPower in_cell(const sensors::Sensor& sensor, int row, double power_W) {
  renderer::AddedPower added{std::vector<double>(static_cast<std::size_t>(sensor.range.cells))};
  added.cell_W[static_cast<std::size_t>(row)] = power_W;
  return added;
}

}  // namespace

TEST_CASE("Added power counts over black, noise that is shown counts as well", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  const sensors::GreyScale scale(facts.sensor);
  for (const int row : {0, 523}) {
    const double floor_W = scale.bscope_floor_W(row), noise_W = facts.sensor.noise_power_W();
    const renderer::AddedPower added = in_cell(facts.sensor, row, 0.01 * floor_W);
    facts.noise_shown = false;
    CHECK(renderer::largest_change_dB(added, facts) == Approx(change_dB(0.01)).epsilon(1e-9));
    // Noise is 14 dB over black at 3.7 km and far below it at 200 m.
    facts.noise_shown = true;
    CHECK(renderer::largest_change_dB(added, facts) ==
          Approx(change_dB(0.01 * floor_W / std::max(floor_W, noise_W))).epsilon(1e-9));
  }
}

TEST_CASE("Detections, power and labels ask for noise that no display shows", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  Display& display = facts.sensor.display;
  display.mapping = Display::Mapping::log;
  display.low_dB = 200.0;
  display.high_dB = 260.0;
  const auto noise = [&](const char* wishes) {
    const core::EffectPlan plan = renderer::plan(
        facts, 0.5,
        *wishes != 0 ? renderer::parse_effect_wishes(wishes) : renderer::EffectWishes{});
    for (const core::EffectDecision& decision : plan.decisions)
      if (decision.effect == core::EffectId::thermal_noise) return decision;
    return core::EffectDecision{};
  };
  CHECK_FALSE(noise("").on);
  facts.read.power = true;
  CHECK(noise("").on);
  CHECK(noise("").reason.find("product power") != std::string::npos);
  CHECK_FALSE(noise("-thermal-noise").on);
  CHECK_FALSE(noise("none").on);
  facts.read = {.detections = true};
  CHECK(noise("").on);
  CHECK(noise("").reason.find("product detections") != std::string::npos);
  facts.read = {.signals = true};
  CHECK(noise("").on);
  CHECK_THAT(noise("").reason, Catch::Contains("in the signals"));
  facts.read = {.labels = true};
  CHECK(noise("").on);
  CHECK(noise("").reason.find("product labels") != std::string::npos);
  facts.read = {.obstacles = true};
  CHECK(noise("").reason.find("asked for") == std::string::npos);
}

TEST_CASE("What thresholds decide about counts in full for detections, obstacles and signals",
          "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  const auto gas = [&] {
    for (const core::EffectDecision& decision : renderer::plan(facts, 0.5, {}).decisions)
      if (decision.effect == core::EffectId::gas) return decision;
    return core::EffectDecision{};
  };
  CHECK(gas().bound_grey < 20.0);
  facts.read.detections = true;
  CHECK(gas().bound_grey == 255.0);
  CHECK(gas().reason.find("product detections") != std::string::npos);
  facts.read = {.obstacles = true};
  CHECK(gas().bound_grey == 255.0);
  CHECK(gas().reason.find("product obstacles") != std::string::npos);
  // Signals have detections whatever products are asked for.
  facts.read = {.signals = true};
  CHECK(gas().bound_grey == 255.0);
  CHECK(gas().reason.find("detection in the signals") != std::string::npos);
}

// Rain 25 dB above the noise was missing from watts, as the display showed all of it black.
TEST_CASE("Who reads watts counts what is added over noise, however bright the display's black",
          "[plan]") {
  for (const Display::CScopeMode mode :
       {Display::CScopeMode::true_elevation, Display::CScopeMode::flat_earth})
    for (const bool sample : {false, true}) {
      renderer::SceneFacts facts = facts_with(mode);
      facts.sample = sample;
      facts.sensor.display.mapping = Display::Mapping::log;
      facts.sensor.display.low_dB = 200.0;
      facts.sensor.display.high_dB = 260.0;
      facts.noise_shown = true;
      renderer::AddedPower added = in_cell(facts.sensor, 0, 0.5 * facts.sensor.noise_power_W());
      added.row_W_m3 = 0.25 * sensors::cscope_noise_W_m3(facts.sensor);
      CHECK(renderer::largest_change_dB(added, facts) < 1e-6);
      for (const renderer::Readings read :
           {renderer::Readings{.power = true}, renderer::Readings{.labels = true}}) {
        facts.read = read;
        facts.noise_shown = true;
        CHECK(renderer::largest_change_dB(added, facts) == Approx(change_dB(0.5)).epsilon(1e-9));
        facts.noise_shown = false;
        CHECK(renderer::largest_change_dB(added, facts) == renderer::window_dB(facts.sensor));
        CHECK(renderer::largest_change_dB(in_cell(facts.sensor, 0, 0.0), facts) == 0.0);
      }
    }
}

TEST_CASE("Rain that a display hides is left out of pictures, not of watts and labels", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  facts.sensor.display.mapping = Display::Mapping::log;
  facts.sensor.display.low_dB = 200.0;
  facts.sensor.display.high_dB = 260.0;
  facts.largest_eta_m2_per_m3 = 1e-6;
  const auto rain_runs = [&](const renderer::Readings& read) {
    facts.read = read;
    return renderer::plan(facts, 0.5, {}).runs(core::EffectId::rain_echo);
  };
  CHECK_FALSE(rain_runs({}));
  CHECK(rain_runs({.power = true}));
  CHECK(rain_runs({.labels = true}));
}

TEST_CASE("In a realisation the largest draw lifts added power over black, not over noise",
          "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  facts.sample = true;
  const double floor_W = sensors::GreyScale(facts.sensor).bscope_floor_W(523);
  const renderer::AddedPower added = in_cell(facts.sensor, 523, 0.01 * floor_W);
  CHECK(renderer::largest_change_dB(added, facts) == Approx(change_dB(0.2288)).epsilon(1e-4));
  facts.noise_shown = true;
  CHECK(renderer::largest_change_dB(added, facts) ==
        Approx(change_dB(0.01 * floor_W / facts.sensor.noise_power_W())).epsilon(1e-9));
}

TEST_CASE("A row of the flat-earth C-scope may hold all cells, its noise with them", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::flat_earth);
  const sensors::Sensor& sensor = facts.sensor;
  renderer::AddedPower added = in_cell(sensor, 0, 0.0);
  double sum_W_m3 = 0.0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double range_m = sensors::range_middle_m(sensor.range, row);
    added.cell_W[static_cast<std::size_t>(row)] = 1e-21;
    sum_W_m3 += 1e-21 * range_m * range_m * range_m;
  }
  CHECK(renderer::largest_change_dB(added, facts) ==
        Approx(change_dB(sum_W_m3 / sensors::GreyScale(sensor).cscope_floor_W_m3())));
  facts.noise_shown = true;
  CHECK(renderer::largest_change_dB(added, facts) ==
        Approx(change_dB(1e-21 / sensor.noise_power_W())));
}

TEST_CASE("A row of the true C-scope has its own floor and noise", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  renderer::AddedPower added = in_cell(facts.sensor, 0, 0.0);
  added.row_W_m3 = 0.1 * sensors::GreyScale(facts.sensor).cscope_floor_W_m3();
  CHECK(renderer::largest_change_dB(added, facts) == Approx(change_dB(0.1)));
  facts.noise_shown = true;
  CHECK(renderer::largest_change_dB(added, facts) ==
        Approx(change_dB(added.row_W_m3 / sensors::cscope_noise_W_m3(facts.sensor))));
}

// A B-scope alone paid for the C-scope that nobody saw.
TEST_CASE("Where no heights are shown, the floor of a C-scope counts for nothing", "[plan]") {
  const auto changes_dB = [](Display::CScopeMode mode) {
    renderer::SceneFacts facts = facts_with(mode);
    const sensors::GreyScale scale(facts.sensor);
    renderer::AddedPower added = in_cell(facts.sensor, 0, 0.0);
    for (int row = 0; row < facts.sensor.range.cells; ++row)
      added.cell_W[static_cast<std::size_t>(row)] = 0.01 * scale.bscope_floor_W(row);
    added.row_W_m3 = scale.cscope_floor_W_m3();
    const double shown_dB = renderer::largest_change_dB(added, facts);
    facts.heights_shown = false;
    return std::pair(shown_dB, renderer::largest_change_dB(added, facts));
  };
  const auto [row_dB, beside_row_dB] = changes_dB(Display::CScopeMode::true_elevation);
  CHECK(row_dB == Approx(change_dB(1.0)).epsilon(1e-9));
  CHECK(beside_row_dB == Approx(change_dB(0.01)).epsilon(1e-9));
  const auto [all_cells_dB, one_cell_dB] = changes_dB(Display::CScopeMode::flat_earth);
  CHECK(all_cells_dB == Approx(change_dB(0.01 * 524)).epsilon(1e-9));
  CHECK(one_cell_dB == Approx(change_dB(0.01)).epsilon(1e-9));
}

TEST_CASE("No change is larger than the display's window", "[plan]") {
  const renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  CHECK(renderer::largest_change_dB(in_cell(facts.sensor, 5, 1.0), facts) ==
        renderer::window_dB(facts.sensor));
}

TEST_CASE("Noise is part of the floor where the plan shows it for certain", "[plan]") {
  renderer::SceneFacts facts = facts_with(Display::CScopeMode::true_elevation);
  facts.largest_eta_m2_per_m3 = 1e-11;
  const auto rain_dB = [&](const char* wishes, double accuracy_grey) {
    for (const core::EffectDecision& each :
         renderer::plan(
             facts, accuracy_grey,
             *wishes == 0 ? renderer::EffectWishes{} : renderer::parse_effect_wishes(wishes))
             .decisions)
      if (each.effect == core::EffectId::rain_echo) return each.bound_dB;
    return -1.0;
  };
  const double over_noise_dB = rain_dB("+thermal-noise", 0.5);
  const double over_black_dB = rain_dB("-thermal-noise", 0.5);
  CHECK(over_noise_dB < 0.5 * over_black_dB);
  CHECK(rain_dB("", 0.5) == over_noise_dB);
  CHECK(rain_dB("all", 0.5) == over_noise_dB);
  CHECK(rain_dB("none", 0.5) == over_black_dB);
  // At an accuracy at which noise itself might be left out nothing may count on it.
  CHECK(rain_dB("", 500.0) == over_black_dB);
}

TEST_CASE("The largest echo of a wall across the beam is what the kernel deposits", "[plan]") {
  // Of constant sigma0 / sin psi, at one range, through the whole beam: K G Omega / R^2.
  const sensors::Sensor sensor = tests::hivision(4);
  const double range_m = sensors::range_edge_m(sensor.range, 100);
  const renderer::AddedPower most =
      renderer::largest_echo({.sigma0_over_sine = 0.3}, renderer::whole_beam(sensor), sensor);
  const double spread_m = range_m - renderer::kSpreadCells * sensor.range.cell_m;
  CHECK(most.cell_W[100] ==
        Approx(sensor.radar_constant_W_m2() * 0.3 * sensors::two_way_width(sensor.antenna.azimuth) *
               sensors::two_way_width(sensor.antenna.elevation) / (spread_m * spread_m)));
  renderer::World world =
      tests::world(sensor, tests::ground(2000.0, 500.0, [](double, double) { return 0.0; }),
                   {materials::PhongNrcs(1e-9, 0.0, 1.0), materials::PhongNrcs(0.3, 0.0, 1.0)},
                   {tests::box({-900.0, range_m + 2.0, 0.0}, {900.0, range_m + 12.0, 600.0}, 1)});
  const renderer::Frame frame =
      renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(300.0));
  double brightest_W = 0.0;
  for (std::size_t row = 95; row < 110; ++row)
    brightest_W = std::max(brightest_W, frame.bscope_W[row * 4 + 1]);
  CHECK(brightest_W < most.cell_W[100]);
  CHECK(brightest_W > 0.25 * most.cell_W[100]);
}

}  // namespace fanbeam
