#include "benchmarks/bare_pass.h"

#include <algorithm>
#include <array>
#include <vector>

#include "benchmarks/view_clock.h"
#include "core/errors.h"
#include "core/median.h"
#include "core/parallel.h"
#include "renderer/casting/ray_caster.h"

namespace fanbeam::benchmarks {
namespace {

using terrain::RayPacket;

constexpr std::size_t kPacketsPerTask = 256;

// Recorded packets mark lanes without a ray by an empty interval.
bool holds_ray(const RayPacket<16>& packet, int lane) {
  return packet.near[lane] <= packet.distance[lane];
}

template <int N>
struct alignas(4 * N) LaneMask {
  int active[N];
};

template <int N>
struct PacketSet {
  std::vector<RayPacket<N>> packets;
  std::vector<LaneMask<N>> masks;
};

template <int N>
void append(const RayPacket<16>& from, const std::array<int, N>& lanes, PacketSet<N>& to) {
  RayPacket<N> packet{};
  LaneMask<N> mask{};
  bool any = false;
  for (int i = 0; i < N; ++i) {
    const int lane = lanes[i];
    packet.origin_x[i] = from.origin_x[lane];
    packet.origin_y[i] = from.origin_y[lane];
    packet.origin_z[i] = from.origin_z[lane];
    packet.near[i] = from.near[lane];
    packet.direction_x[i] = from.direction_x[lane];
    packet.direction_y[i] = from.direction_y[lane];
    packet.direction_z[i] = from.direction_z[lane];
    packet.distance[i] = from.distance[lane];
    packet.mask[i] = from.mask[lane];
    packet.geometry[i] = terrain::kNoHit;
    packet.instance[i] = terrain::kNoHit;
    mask.active[i] = holds_ray(from, lane) ? -1 : 0;
    any = any || mask.active[i] != 0;
  }
  if (!any) return;
  to.packets.push_back(packet);
  to.masks.push_back(mask);
}

template <int N>
void cast(const terrain::RayScene& scene, const PacketSet<N>& set,
          std::vector<RayPacket<N>>& packets) {
  core::parallel_for((packets.size() + kPacketsPerTask - 1) / kPacketsPerTask,
                     [&](std::size_t task) {
                       const std::size_t begin = task * kPacketsPerTask;
                       const std::size_t end = std::min(begin + kPacketsPerTask, packets.size());
                       for (std::size_t i = begin; i < end; ++i)
                         scene.intersect(set.masks[i].active, packets[i]);
                     });
}

// Bare pass and frame in turns, so that both see the same machine.
template <int N>
BarePass measure_shape(const View& view, const FrameClock& clock, const PacketSet<N>& set,
                       const std::string& shape, int turns) {
  std::vector<RayPacket<N>> packets;
  std::vector<double> bare_ms;
  std::vector<double> frame_ms;
  for (int i = 0; i <= turns; ++i) {
    packets = set.packets;
    const measure::Clock::time_point begin = measure::Clock::now();
    cast(view.world().surfaces(), set, packets);
    const double bare = measure::milliseconds_since(begin);
    const double frame = clock.frame_ms();
    if (i == 0) continue;  // warm-up
    bare_ms.push_back(bare);
    frame_ms.push_back(frame);
  }
  return {0, core::median(bare_ms), core::median(frame_ms), shape};
}

}  // namespace

BarePass measure_bare_pass(const View& view, const renderer::Sampling& sampling, int turns) {
  const std::vector<RayPacket<16>> recorded =
      renderer::RayCaster(view.world(), sampling).packets(view.antenna);
  std::uint64_t rays = 0;
  for (const RayPacket<16>& packet : recorded)
    for (int lane = 0; lane < 16; ++lane) rays += holds_ray(packet, lane) ? 1 : 0;

  const FrameClock clock = surfaces_clock(view.world(), view, sampling);
  renderer::Frame frame;
  clock.frame_ms(&frame);
  if (frame.rays != rays)
    throw core::InternalError("a frame of " + std::to_string(frame.rays) +
                              " rays was recorded as " + std::to_string(rays));
  using Cut8 = std::array<std::array<int, 8>, 2>;
  std::vector<BarePass> passes;
  {
    PacketSet<16> whole;
    std::array<int, 16> lanes{};
    for (int i = 0; i < 16; ++i) lanes[static_cast<std::size_t>(i)] = i;
    for (const RayPacket<16>& packet : recorded) append<16>(packet, lanes, whole);
    passes.push_back(measure_shape<16>(view, clock, whole, "16 wide", turns));
  }
  const auto measure_cut = [&](const Cut8& cut, const std::string& shape) {
    PacketSet<8> halves;
    for (const RayPacket<16>& packet : recorded)
      for (const auto& lanes : cut) append<8>(packet, lanes, halves);
    passes.push_back(measure_shape<8>(view, clock, halves, shape, turns));
  };
  measure_cut({{{0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10, 11, 12, 13, 14, 15}}},
              "8 wide, 4 azimuths x 2 elevations");
  measure_cut({{{0, 1, 4, 5, 8, 9, 12, 13}, {2, 3, 6, 7, 10, 11, 14, 15}}},
              "8 wide, 2 azimuths x 4 elevations");

  BarePass best =
      *std::min_element(passes.begin(), passes.end(),
                        [](const BarePass& a, const BarePass& b) { return a.bare_ms < b.bare_ms; });
  best.rays = rays;
  return best;
}

}  // namespace fanbeam::benchmarks
