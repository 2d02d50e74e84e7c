// R11: the same picture from every instruction set that the ray caster can be limited to.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "renderer/frame_renderer.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

bool machine_has(const std::string& set) {
#if defined(__x86_64__)
  if (set == "sse4.2") return __builtin_cpu_supports("sse4.2") != 0;
  if (set == "avx") return __builtin_cpu_supports("avx") != 0;
  if (set == "avx2")
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (set == "avx512")
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
#endif
  return false;
}

// Rolling ground with houses: silhouettes, walls and seams everywhere.
renderer::World village(const std::string& instruction_set) {
  const auto height_m = [](double x_m, double y_m) {
    return 8.0 * std::sin(x_m / 170.0) * std::cos(y_m / 230.0);
  };
  std::vector<terrain::PlacedMesh> houses;
  for (int i = 0; i < 120; ++i) {
    const double x_m = -600.0 + 97.0 * (i % 12), y_m = 500.0 + 260.0 * (i / 12) + 13.0 * (i % 5);
    houses.push_back(tests::box({x_m, y_m, -20.0}, {x_m + 14.0, y_m + 11.0, 15.0}, 1).mesh);
  }
  renderer::World world = tests::world(
      tests::hivision(), std::nullopt,
      {materials::PhongNrcs(0.0325, 0.136, 1.99), materials::PhongNrcs(0.3, 0.5, 3.0)});
  world.geometry = tests::geometry(tests::ground(4000.0, 40.0, height_m), {}, std::move(houses), {},
                                   instruction_set);
  return world;
}

}  // namespace

TEST_CASE("R11: pictures of SSE4.2, AVX, AVX2 and AVX-512 are statistically one", "[isa]") {
  constexpr std::size_t kFrames = 13;
  std::vector<double> first_W;
  int sets = 0;
  for (const char* set : {"sse4.2", "avx", "avx2", "avx512"}) {
    if (!machine_has(set)) {
      WARN("this machine has no " << set);
      continue;
    }
    ++sets;
    const renderer::World world = village(set);
    CHECK(world.surfaces().native_packet() == (std::string(set) == "avx512" ? 16 : 8));
    const renderer::FrameRenderer renderer(world, renderer::sampling_for(4.0), {true, false}, {});
    std::vector<double> power_W;
    // Many frames: one ray that passes an edge within a float's last bit changes up to ten cells.
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
      const double height_m = 45.0 + 8.0 * static_cast<double>(frame);
      const auto frame_W = renderer.render(tests::level_pose(height_m)).bscope_W;
      power_W.insert(power_W.end(), frame_W.begin(), frame_W.end());
    }
    if (first_W.empty()) first_W = power_W;
    REQUIRE(power_W.size() == first_W.size());
    double sum_dB = 0.0;
    std::size_t lit = 0, differ = 0;
    std::map<std::size_t, int> differ_in;  // frames
    const auto count = [&](std::size_t cell) {
      ++differ;
      ++differ_in[cell * kFrames / power_W.size()];
    };
    for (std::size_t i = 0; i < power_W.size(); ++i) {
      if (power_W[i] == 0.0 && first_W[i] == 0.0) continue;
      ++lit;
      if (!(power_W[i] > 0.0 && first_W[i] > 0.0)) {
        count(i);
        continue;
      }
      const double difference_dB = 10.0 * std::log10(power_W[i] / first_W[i]);
      sum_dB += difference_dB;
      if (std::abs(difference_dB) > 0.1) count(i);
    }
    INFO(set << ": mean " << sum_dB / static_cast<double>(lit) << " dB, " << differ << " of " << lit
             << " cells by more than 0.1 dB");
    CHECK(lit > power_W.size() / 2);
    CHECK(std::abs(sum_dB / static_cast<double>(lit)) <= 0.001);
    CHECK(static_cast<double>(differ) <= 1e-4 * static_cast<double>(power_W.size()));
    for (const auto& [frame, cells] : differ_in) {
      INFO("frame " << frame);
      CHECK(cells <= 60);  // half a dozen such rays
    }
  }
  CHECK(sets >= 1);
}
