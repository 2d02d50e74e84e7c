// One realisation of a frame: decided by the plan, the same however it is computed, the expected
// power on average, and nothing at all when it is off.
#include <catch2/catch.hpp>

#include "core/parallel.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/plan.h"
#include "sensors/receiver/receiver_figures.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;
using core::Swerling;

namespace {

// Grass with a fluctuating and a steady reflector on it, seen over a few columns.
renderer::World field_of_two(Swerling swerling, int looks = 1) {
  sensors::Sensor sensor = tests::hivision(12);
  sensor.receiver.looks = looks;
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {materials::PhongNrcs{0.1, 0.0, 1.0}});
  world.targets = {{"one", materials::ConstantRcs{3.0}, {{0.0, {0.0, 1000.0, 2.0}}}},
                   {"two", materials::ConstantRcs{3.0}, {{0.0, {10.0, 1500.0, 2.0}}}}};
  world.targets[0].swerling = swerling;
  return world;
}

renderer::Frame frame_with(const renderer::World& world, const renderer::Effects& effects,
                           std::uint64_t frame_index = 0) {
  renderer::FramePose pose = tests::level_pose(60.0);
  pose.frame_index = frame_index;
  return renderer::render_frame(world, renderer::sampling_for(2.0), {true, true, true}, effects,
                                pose);
}

bool same_frame(const renderer::Frame& a, const renderer::Frame& b) {
  return a.bscope_W == b.bscope_W && a.cscope_W_m3 == b.cscope_W_m3 &&
         a.bscope_grey == b.bscope_grey && a.cscope_grey == b.cscope_grey &&
         a.detections.size() == b.detections.size();
}

const renderer::Effects kSample{
    {core::EffectId::thermal_noise, core::EffectId::speckle, core::EffectId::swerling}, 3};

core::EffectDecision decision(const renderer::SceneFacts& facts, core::EffectId effect,
                              const std::string& wishes = "") {
  const core::EffectPlan plan = renderer::plan(
      facts, 0.5,
      wishes.empty() ? renderer::EffectWishes{} : renderer::parse_effect_wishes(wishes));
  for (const core::EffectDecision& found : plan.decisions)
    if (found.effect == effect) return found;
  return {};
}

renderer::SceneFacts facts(bool sample, bool fluctuating) {
  renderer::SceneFacts result;
  result.sensor = tests::hivision();
  result.sample = sample;
  result.fluctuating_targets = fluctuating;
  return result;
}

}  // namespace

TEST_CASE("Speckle and Swerling run when a realisation is asked for, and say why when not",
          "[plan]") {
  const core::EffectDecision off = decision(facts(false, true), core::EffectId::speckle);
  CHECK_FALSE(off.on);
  CHECK(off.reason == "frames show the expected power ([accuracy] realisation)");
  CHECK_FALSE(decision(facts(false, true), core::EffectId::swerling).on);
  CHECK_FALSE(decision(facts(false, true), core::EffectId::speckle, "all").on);

  const core::EffectDecision on = decision(facts(true, false), core::EffectId::speckle);
  CHECK(on.on);
  CHECK(on.bound_dB ==
        Approx(330.0 * std::log10(2.0)).epsilon(0.0).margin(1e-4));  // of the smallest u, 2^-33
  CHECK_FALSE(decision(facts(true, false), core::EffectId::swerling).on);
  CHECK(decision(facts(true, true), core::EffectId::swerling).on);

  CHECK(decision(facts(false, false), core::EffectId::speckle, "+speckle").on);
  CHECK(decision(facts(false, true), core::EffectId::swerling, "+speckle").on);
  CHECK(decision(facts(false, true), core::EffectId::speckle, "+swerling").on);
  CHECK_FALSE(decision(facts(false, false), core::EffectId::speckle, "+swerling").on);
  CHECK_FALSE(decision(facts(true, true), core::EffectId::speckle, "-speckle").on);
  CHECK(decision(facts(true, true), core::EffectId::swerling, "-speckle").on);
}

TEST_CASE("M06 a realisation is the same for any thread count and order of frames", "[M06]") {
  for (const int looks : {1, 3}) {
    const renderer::World world = field_of_two(Swerling::case2, looks);
    std::vector<renderer::Frame> first;
    {
      const core::ThreadLimit one(1);
      for (const std::uint32_t frame : {0U, 1U, 2U})
        first.push_back(frame_with(world, kSample, frame));
    }
    for (const int threads : {2, 3, 8}) {
      const core::ThreadLimit limit(threads);
      for (const std::uint32_t frame : {2U, 0U, 1U})
        CHECK(same_frame(frame_with(world, kSample, frame), first[frame]));
    }
    CHECK_FALSE(first[0].bscope_W == first[1].bscope_W);
    renderer::Effects other = kSample;
    other.seed = 4;
    CHECK_FALSE(frame_with(world, other).bscope_W == first[0].bscope_W);
  }
}

TEST_CASE("M06 a session's realisations do not come back after 2^32 frames", "[M06]") {
  const renderer::World world = field_of_two(Swerling::case2);
  const renderer::Frame early = frame_with(world, kSample, 5);
  const renderer::Frame late = frame_with(world, kSample, 5 + (std::uint64_t{1} << 32U));
  CHECK_FALSE(late.bscope_W == early.bscope_W);
  CHECK_FALSE(late.cscope_W_m3 == early.cscope_W_m3);
}

TEST_CASE("R19 nothing to fluctuate equals off, byte for byte", "[R19]") {
  const renderer::World world = field_of_two(Swerling::steady);
  const renderer::Effects off{{core::EffectId::thermal_noise}, 3};
  renderer::Effects swerling = off;
  swerling.on.insert(core::EffectId::swerling);
  CHECK(same_frame(frame_with(world, swerling), frame_with(world, off)));
  // Off takes no draw: the seed does not matter.
  renderer::Effects other_seed = off;
  other_seed.seed = 99;
  CHECK(same_frame(frame_with(world, other_seed), frame_with(world, off)));
  // Speckle of zero power is zero power.
  const renderer::World nothing = tests::world(tests::hivision(8), std::nullopt, {});
  CHECK(same_frame(frame_with(nothing, {{core::EffectId::speckle}}), frame_with(nothing, {})));
}

TEST_CASE("Realisations average to the expected power with its noise, ground and targets alike",
          "[statistics]") {
  constexpr int kFrames = 300;
  for (const Swerling swerling : {Swerling::steady, Swerling::case1, Swerling::case4}) {
    const renderer::World world = field_of_two(swerling, 2);
    // Noise is added for display.
    const std::vector<double> expected_W =
        frame_with(world, {{core::EffectId::thermal_noise}}).bscope_W;
    const double noise_W = world.sensor.noise_power_W();
    std::vector<double> mean_W(expected_W.size(), 0.0);
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const std::vector<double> sample_W = frame_with(world, kSample, frame).bscope_W;
      for (std::size_t i = 0; i < mean_W.size(); ++i) mean_W[i] += sample_W[i] / kFrames;
    }
    double worst = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < mean_W.size(); ++i) {
      const double ratio = mean_W[i] / (expected_W[i] + noise_W);
      worst = std::max(worst, std::abs(ratio - 1.0));
      sum += ratio / static_cast<double>(mean_W.size());
    }
    CAPTURE(static_cast<int>(swerling));
    // Of a cell: at most 1 / sqrt(frames) for case 1, six times that among 6288 cells.
    CHECK(worst < 6.0 / std::sqrt(kFrames));
    CHECK(sum == Approx(1.0).epsilon(0.0).margin(0.004));
  }
}

TEST_CASE("A sensor in the ground sees noise alone: false alarms at the rate of its file",
          "[statistics]") {
  renderer::World world = field_of_two(Swerling::steady);
  world.sensor.receiver.false_alarm_probability = 1e-3;
  renderer::FramePose pose = tests::level_pose(-1.0);
  double alarms = 0.0;
  double cells = 0.0;
  const renderer::FrameRenderer frame_renderer(world, renderer::sampling_for(1.0),
                                               {true, true, true}, kSample);
  for (pose.frame_index = 0; pose.frame_index < 200; ++pose.frame_index) {
    const renderer::Frame frame = frame_renderer.render(pose);
    alarms += static_cast<double>(frame.detections.size());
    cells += static_cast<double>(frame.bscope_W.size());
  }
  CHECK(cells / 200 * 1e-3 ==
        Approx(sensors::receiver_figures(world.sensor).false_alarms_per_frame));
  CHECK(alarms / cells == Approx(1e-3).epsilon(0.0).margin(4.0 * std::sqrt(1e-3 / cells)));
}

TEST_CASE("Threshold detections are the cells above it, by row and column", "[detection]") {
  const sensors::Sensor sensor = tests::hivision(12);
  std::vector<double> power_W(static_cast<std::size_t>(sensor.range.cells * 12), 1.0);
  power_W[3 * 12 + 5] = 2.5;
  power_W[100 * 12] = 2.0;  // the threshold itself does not count
  const auto found = renderer::above_threshold(sensor, 2.0, power_W);
  REQUIRE(found.size() == 1);
  CHECK(found[0].row == 3);
  CHECK(found[0].column == 5);
  CHECK(found[0].power_W == 2.5);
}
