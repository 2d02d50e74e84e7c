// Refinement to an accuracy, and whether its estimate of the error can be believed.
#include "renderer/accuracy/refinement.h"

#include <catch2/catch.hpp>

#include "core/parallel.h"
#include "core/pose.h"
#include "renderer/accuracy/grey_error.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/caster_choice.h"
#include "tests/renderer/city_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

renderer::FramePose pose_of(std::uint64_t number) {
  const auto random = [number](std::uint32_t draw) { return tests::uniform(11, number, draw); };
  renderer::FramePose pose = tests::level_pose(55.0 + 40.0 * random(0));
  pose.position_m.x = 200.0 * random(1) - 100.0;
  pose.position_m.y = 200.0 * random(2) - 100.0;
  pose.q_NB = core::quaternion_from({0.0, 0.0, 2.0 * core::kPi * random(3)});
  return pose;
}

// Frames together count as one wide picture: mean squares add up.
struct Tally {
  int cases = 0, within = 0;
  double true_grey2 = 0.0, estimate_grey2 = 0.0;

  void add(double true_grey, double estimate_grey) {
    const double ratio = true_grey / estimate_grey;
    ++cases;
    within += ratio > 1.0 / 1.5 && ratio < 1.5;
    true_grey2 += true_grey * true_grey;
    estimate_grey2 += estimate_grey * estimate_grey;
  }
  double true_over_estimate() const { return std::sqrt(true_grey2 / estimate_grey2); }
};

// Of the B-scope as a display shows it.
double true_error_grey(const renderer::GreyReference& reference, const renderer::Frame& frame,
                       bool noise) {
  const renderer::PictureError error =
      reference.error_of({frame.bscope_W, frame.cscope_W_m3}).bscope;
  return noise ? error.with_noise.rms : error.noise_free.rms;
}

// Converged, and not by the other caster: rays are 0.05 to 0.3 grey off where they are `converged`,
// more than slices have to state. That both come to the same picture is profile_rays_test's.
renderer::Sampling many_slices() {
  renderer::Sampling sampling = tests::slices(8);
  sampling.sub_columns = 16;
  sampling.slices_per_sub_column = 8;
  return sampling;
}

// Slices begin with so many that hardly anything is left to refine: here with one.
renderer::Sampling coarse_start(renderer::CasterKind caster, double target_grey) {
  if (caster == renderer::CasterKind::rays) return renderer::refined_sampling(caster, target_grey);
  renderer::Sampling sampling = tests::slices(1);
  sampling.target_grey = target_grey / 10.0;
  return sampling;
}

}  // namespace

// A feature that falls between all samples of a column is in no estimate of it. Few columns hold few
// features, so single narrow frames scatter (75 to 95 % within the factor, by sampling); together
// they are as good as three wide ones.
TEST_CASE("The true error over a city lies within a factor 1.5 of its estimate",
          "[refinement][statistics]") {
  constexpr std::uint64_t kPoses = 20;
  const renderer::World world = tests::city_world(tests::narrow(24), tests::everywhere);
  // Refined to 1 and to 0.5 grey, and as they come.
  std::vector<renderer::Sampling> samplings;
  for (const renderer::CasterKind caster :
       {renderer::CasterKind::rays, renderer::CasterKind::profile}) {
    samplings.push_back(renderer::refined_sampling(caster, 1.0));
    samplings.push_back(renderer::refined_sampling(caster, 0.5));
    samplings.push_back(caster == renderer::CasterKind::rays ? renderer::sampling_for(4.0)
                                                             : tests::slices(8));
    samplings.back().estimate_error = true;
  }
  std::vector<Tally> tallies(samplings.size());
  for (std::uint64_t number = 0; number < kPoses; ++number) {
    const renderer::FramePose pose = pose_of(number);
    const renderer::Effects effects{
        core::EffectSet{}.with(core::EffectId::thermal_noise, number % 2 == 1)};
    const auto render = [&](const renderer::Sampling& sampling) {
      return renderer::render_frame(world, sampling, {}, effects, pose);
    };
    const auto reference_of = [&](const renderer::Sampling& sampling) {
      const renderer::Frame converged = render(sampling);
      return renderer::GreyReference(world.sensor, {converged.bscope_W, converged.cscope_W_m3});
    };
    const renderer::GreyReference by_rays = reference_of(renderer::reference_sampling(number));
    const renderer::GreyReference by_slices = reference_of(many_slices());
    for (std::size_t s = 0; s < samplings.size(); ++s) {
      const renderer::Frame frame = render(samplings[s]);
      REQUIRE(frame.error.has_value());
      const double target_grey = samplings[s].target_grey;
      if (target_grey > 0.0 && frame.error->reached) {
        CHECK(frame.error->rms_grey <= target_grey);
        CHECK(frame.error->cscope_rms_grey <= target_grey);
      }
      const renderer::GreyReference& reference =
          samplings[s].caster == renderer::CasterKind::rays ? by_rays : by_slices;
      tallies[s].add(true_error_grey(reference, frame, effects.runs(core::EffectId::thermal_noise)),
                     frame.error->rms_grey);
    }
  }
  for (std::size_t s = 0; s < samplings.size(); ++s) {
    INFO("sampling " << s << ": " << tallies[s].within << " of " << tallies[s].cases);
    CHECK(tallies[s].true_over_estimate() < 1.5);
    CHECK(tallies[s].true_over_estimate() > 1.0 / 1.5);
    CHECK(tallies[s].within >= 0.75 * tallies[s].cases);
  }
}

TEST_CASE("A city on one side is refined on that side alone", "[refinement]") {
  const sensors::Sensor sensor = tests::narrow(82);
  const renderer::World half =
      tests::city_world(sensor, [](double x, double) { return x < -30.0; });
  const renderer::World whole = tests::city_world(sensor, tests::everywhere);
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  for (const renderer::CasterKind kind :
       {renderer::CasterKind::rays, renderer::CasterKind::profile}) {
    const renderer::Sampling sampling = coarse_start(kind, 0.25);
    const auto samples = [&](const renderer::FanSums& sums) {
      return static_cast<double>(kind == renderer::CasterKind::rays ? sums.rays : sums.slices);
    };
    const auto refined = [&](const renderer::World& world, renderer::FanSums& sums) {
      const auto caster = tests::caster_of(world, sampling);
      renderer::SightLines none;
      return renderer::Refinement(world, sampling, *caster, nullptr, {})
          .cast(antenna, true, sums, none);
    };
    renderer::FanSums of_half, of_whole;
    const renderer::ErrorEstimate estimate = refined(half, of_half);
    refined(whole, of_whole);
    REQUIRE(estimate.levels >= 4);
    const auto caster = tests::caster_of(half, sampling);
    // After the first two levels, which every column needs for its estimate.
    double everyone = 0.0, later = 0.0;
    for (int level = 0; level < estimate.levels; ++level)
      (level < 2 ? everyone : later) += samples(tests::cast_level(*caster, level, antenna));
    INFO(renderer::name_of(kind) << ": " << samples(of_half) << " of " << everyone + later
                                 << ", built up all over " << samples(of_whole));
    CHECK(samples(of_half) - everyone < 0.6 * later);
    CHECK(samples(of_whole) > 1.5 * samples(of_half));
    // The right quarter of the fan holds the first two levels and nothing else.
    renderer::FanSums first = tests::cast_level(*caster, 0, antenna);
    const double share = kind == renderer::CasterKind::rays ? 0.5 : 1.0;
    tests::mix_in(tests::cast_level(*caster, 1, antenna), share, first);
    const auto from =
        static_cast<std::ptrdiff_t>(first.sub_columns / 4 * 3) * std::ptrdiff_t{first.cells};
    CHECK(std::equal(first.range_W_per_rad.begin() + from, first.range_W_per_rad.end(),
                     of_half.range_W_per_rad.begin() + from));
  }
}

TEST_CASE("R10 refined frames have the same bytes for 1 and 2 threads", "[refinement]") {
  const renderer::World world = tests::city_world(tests::narrow(24), tests::everywhere);
  for (const renderer::CasterKind kind :
       {renderer::CasterKind::rays, renderer::CasterKind::profile}) {
    const renderer::FrameRenderer frames(world, coarse_start(kind, 0.5), {}, {});
    const renderer::Frame expected = frames.render(pose_of(3));
    REQUIRE(expected.error.has_value());
    CHECK(expected.error->levels > 2);
    for (const int threads : {1, 2}) {
      const core::ThreadLimit limit(threads);
      const renderer::Frame again = frames.render(pose_of(3));
      CHECK(again.bscope_W == expected.bscope_W);
      CHECK(again.cscope_W_m3 == expected.cscope_W_m3);
      CHECK(again.error->rms_grey == expected.error->rms_grey);
      CHECK(again.rays == expected.rays);
      CHECK(again.slices == expected.slices);
    }
  }
}
