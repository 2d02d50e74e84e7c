#include "renderer/stages/bounce_tracer.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/plan/largest_echo.h"
#include "renderer/stages/bounce_limits.h"

namespace fanbeam::renderer {

// Rays on their way together. Of one thread, kept from call to call.
struct BounceTracer::Block {
  BounceView view;
  FirstRays first;
  MirroredRays mirrored;
  BounceReturns returns;
};

namespace {

void copy(const AntennaRays& from, int i, AntennaRays& to, int k) {
  to.azimuth_rad[k] = from.azimuth_rad[i];
  to.elevation_rad[k] = from.elevation_rad[i];
  to.cos_elevation[k] = from.cos_elevation[i];
  to.sin_elevation[k] = from.sin_elevation[i];
  to.cos_azimuth[k] = from.cos_azimuth[i];
  to.sin_azimuth[k] = from.sin_azimuth[i];
}

void copy(const BouncePoints& from, int i, BouncePoints& to, int k) {
  to.x[k] = from.x[i];
  to.y[k] = from.y[i];
  to.z[k] = from.z[i];
}

void copy(const RayHits& from, int i, RayHits& to, int k) {
  copy(from.direction, i, to.direction, k);
  copy(from.point_m, i, to.point_m, k);
  copy(from.normal, i, to.normal, k);
  to.distance_m[k] = from.distance_m[i];
  to.sin_grazing[k] = from.sin_grazing[i];
}

// Rays in packets of N, as wide as the ray-casting library runs natively.
template <int N>
class Packets {
 public:
  explicit Packets(const terrain::RayScene& surfaces) : surfaces_(surfaces) {
    for (int i = 0; i < N; ++i) packet_.aim(i, glm::dvec3(0.0), glm::dvec3(0.0), 0.0);
  }

  void intersect(CastRays& rays, terrain::Packing packing) {
    for (int first = 0; first < rays.count; first += N) {
      fill(rays, first);
      surfaces_.intersect(active_, packet_, packing);
      std::copy_n(packet_.distance, N, rays.distance.of + first);
      std::copy_n(packet_.normal_x, N, rays.normal_x.of + first);
      std::copy_n(packet_.normal_y, N, rays.normal_y.of + first);
      std::copy_n(packet_.normal_z, N, rays.normal_z.of + first);
      std::copy_n(packet_.geometry, N, rays.geometry.of + first);
      std::copy_n(packet_.primitive, N, rays.primitive.of + first);
    }
  }

  // As RayScene::find_occluded.
  void find_occluded(CastRays& rays) {
    for (int first = 0; first < rays.count; first += N) {
      fill(rays, first);
      surfaces_.find_occluded(active_, packet_);
      std::copy_n(packet_.distance, N, rays.distance.of + first);
    }
  }

 private:
  void fill(const CastRays& rays, int first) {
    std::copy_n(rays.origin_x.of + first, N, packet_.origin_x);
    std::copy_n(rays.origin_y.of + first, N, packet_.origin_y);
    std::copy_n(rays.origin_z.of + first, N, packet_.origin_z);
    std::copy_n(rays.direction_x.of + first, N, packet_.direction_x);
    std::copy_n(rays.direction_y.of + first, N, packet_.direction_y);
    std::copy_n(rays.direction_z.of + first, N, packet_.direction_z);
    std::copy_n(rays.distance.of + first, N, packet_.distance);
    for (int i = 0; i < N; ++i) {
      packet_.geometry[i] = packet_.instance[i] = terrain::kNoHit;
      active_[i] = first + i < rays.count ? -1 : 0;
    }
  }

  const terrain::RayScene& surfaces_;
  terrain::RayPacket<N> packet_{};
  alignas(64) int active_[N];
};

}  // namespace

BounceTracer::BounceTracer(const World& world, bool noise)
    : world_(world),
      mirrors_(world.specular, world.nrcs.bistatic(), world.sensor.wavelength_m()),
      weights_(world, noise),
      beam_tangent_(widest_tangent(world.sensor.antenna.azimuth)) {}

std::uint64_t BounceTracer::trace(const sensors::AntennaFrame& antenna,
                                  const std::vector<AntennaRay>& rays, std::size_t first,
                                  terrain::Packing mirrored,
                                  std::vector<BounceEcho>& echoes) const {
  return world_.surfaces().native_packet() == 16
             ? trace_packets<16>(antenna, rays, first, mirrored, echoes)
             : trace_packets<8>(antenna, rays, first, mirrored, echoes);
}

template <int N>
std::uint64_t BounceTracer::trace_packets(const sensors::AntennaFrame& antenna,
                                          const std::vector<AntennaRay>& rays, std::size_t first,
                                          terrain::Packing mirrored,
                                          std::vector<BounceEcho>& echoes) const {
  thread_local const std::unique_ptr<Block> block = std::make_unique<Block>();
  const sensors::RangeGate& gate = world_.sensor.range;
  constexpr double kMargin_m = 1.0;  // of the mirror's place
  block->view = {antenna,
                 world_.sensor.scan.surface == sensors::ScanSurface::cone,
                 world_.surfaces().in_scene_m(glm::dvec3(0.0)),
                 gate.maximum_m(),
                 gate.maximum_m() + kSpreadCells * gate.cell_m + kMargin_m,
                 beam_tangent_,
                 sensors::beams_reach_behind(world_.sensor)};
  std::uint64_t cast = 0;
  while (first < rays.size()) {
    const auto count = static_cast<int>(std::min<std::size_t>(kBounceRays, rays.size() - first));
    trace_block<N>(rays.data() + first, count, first, mirrored, *block, echoes);
    cast +=
        static_cast<std::uint64_t>(count + block->mirrored.rays.count + block->returns.rays.count);
    first += static_cast<std::size_t>(count);
  }
  return cast;
}

template <int N>
void BounceTracer::trace_block(const AntennaRay* rays, int count, std::size_t first,
                               terrain::Packing mirrored, Block& block,
                               std::vector<BounceEcho>& echoes) const {
  Packets<N> packets(world_.surfaces());
  for (int i = 0; i < count; ++i) {
    block.first.angles.azimuth_rad[i] = rays[i].azimuth_rad;
    block.first.angles.elevation_rad[i] = rays[i].elevation_rad;
  }
  aim_first_rays(block.view, count, block.first);
  packets.intersect(block.first.rays, terrain::Packing::alike);
  measure_hits(block.view, block.first.rays, block.first.hits);
  measure_polarisation(block.view, block.first);
  find_mirrors(block);
  BounceReturns& returns = block.returns;
  returns.rays.count = 0;
  returns.pairs.clear();
  if (block.mirrored.rays.count == 0) return;
  aim_mirrored_rays(block.view, block.mirrored);
  packets.intersect(block.mirrored.rays, mirrored);
  measure_hits(block.view, block.mirrored.rays, block.mirrored.hits);
  measure_ways(block.view, block.mirrored);
  weights_.weigh(block.view, block.mirrored, first, echoes, returns);
  for (int i = returns.rays.count; i < whole_packets(returns.rays.count); ++i)
    returns.rays.aim(i, glm::dvec3(0.0), glm::dvec3(1.0), 0.0);  // not cast
  packets.find_occluded(returns.rays);
  for (int i = 0; i < returns.rays.count; ++i)
    if (!(returns.rays.distance[i] < 0.0F))
      echoes.push_back(returns.pairs[static_cast<std::size_t>(i)]);
}

// Of the first rays those that meet a mirror.
void BounceTracer::find_mirrors(Block& block) const {
  const FirstRays& first = block.first;
  MirroredRays& mirrored = block.mirrored;
  const terrain::RayScene& surfaces = world_.surfaces();
  const bool horizontal = world_.sensor.waveform.polarisation == core::Polarisation::horizontal;
  int count = 0;
  for (int i = 0; i < first.rays.count; ++i) {
    if (first.rays.geometry[i] == terrain::kNoHit) continue;
    const double sin_grazing = first.hits.sin_grazing[i];
    if (!(sin_grazing > 0.0 && first.hits.distance_m[i] > 0.0)) continue;
    const double reflection = mirrors_.power(
        surfaces.material(first.rays.geometry[i], first.rays.primitive[i], first.hits.point_m.x[i],
                          first.hits.point_m.y[i]),
        sin_grazing, horizontal ? first.perpendicular[i] : 1.0 - first.perpendicular[i]);
    if (!(reflection >= weights_.faintest_mirror())) continue;
    mirrored.first[count] = i;
    mirrored.reflection[count] = reflection;
    copy(first.angles, i, mirrored.angles, count);
    copy(first.hits, i, mirrored.mirrors, count);
    ++count;
  }
  mirrored.rays.count = count;
  if (count == 0) return;
  for (int k = count; k < whole_packets(count); ++k) {
    copy(mirrored.angles, count - 1, mirrored.angles, k);
    copy(mirrored.mirrors, count - 1, mirrored.mirrors, k);
  }
}

}  // namespace fanbeam::renderer
