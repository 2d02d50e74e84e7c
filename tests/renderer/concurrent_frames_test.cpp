// Frames that other programs ask for at the same time, from threads and from tasks of their own.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "core/parallel.h"
#include "renderer/frame_renderer.h"
#include "tests/renderer/city_world.h"

using namespace fanbeam;

namespace {

#ifdef __SANITIZE_THREAD__  // which does not understand oneTBB's tasks, and takes its time
constexpr std::size_t kFrames = 8;
#else
constexpr std::size_t kFrames = 64;
constexpr int kThreads = 8;
#endif

bool same_powers(const renderer::Frame& a, const renderer::Frame& b) {
  return a.bscope_W == b.bscope_W && a.cscope_W_m3 == b.cscope_W_m3 && a.rays == b.rays &&
         a.slices == b.slices;
}

}  // namespace

TEST_CASE("R10 frames rendered at once, inside tasks or threads, are those rendered one by one",
          "[threads][concurrent]") {
  renderer::World world =
      tests::city_world(tests::narrow(16), [](double, double y) { return y > 300.0; });
  world.specular = {materials::SpecularSurface{{4.0, 1.0}, 0.0}};  // the ground
  const auto pose = [](std::size_t i) {
    return tests::level_pose(60.0 + 5.0 * static_cast<double>(i % 8));
  };
  renderer::Sampling estimated = renderer::profile_sampling_for(2.0);
  estimated.estimate_error = true;
  for (const renderer::Sampling& sampling :
       {renderer::sampling_for(2.0), renderer::profile_sampling_for(2.0), estimated,
        renderer::refined_sampling(renderer::CasterKind::rays, 1.0)}) {
    const renderer::FrameRenderer frames(
        world, sampling, {}, {{core::EffectId::thermal_noise, core::EffectId::double_bounce}});
    std::vector<renderer::Frame> expected;
    for (std::size_t i = 0; i < 8; ++i) expected.push_back(frames.render(pose(i)));
    INFO("caster " << static_cast<int>(sampling.caster) << ", to " << sampling.target_grey);

    std::array<bool, kFrames> right{};
#ifndef __SANITIZE_THREAD__
    // More threads than cores (tests/main.cpp), so that one often waits for what another has begun.
    tbb::task_arena(kThreads).execute([&] {
      tbb::parallel_for(
          std::size_t{0}, kFrames, std::size_t{1},
          [&](std::size_t i) { right[i] = same_powers(frames.render(pose(i)), expected[i % 8]); },
          tbb::simple_partitioner());
    });
    CHECK(std::count(right.begin(), right.end(), false) == 0);
#endif

    right.fill(false);
    std::vector<std::thread> callers;
    for (std::size_t first = 0; first < 4; ++first)
      callers.emplace_back([&, first] {
        for (std::size_t i = first; i < kFrames; i += 4)
          right[i] = same_powers(frames.render(pose(i)), expected[i % 8]);
      });
    for (std::thread& caller : callers) caller.join();
    CHECK(std::count(right.begin(), right.end(), false) == 0);
  }
}
