// Casts a batch of rays in packets of N, as wide as the ray-casting library runs natively.
#pragma once

#include <vector>

#include "renderer/casting/ray_batch.h"
#include "sensors/sensor.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

template <int N>
class PacketSender {
 public:
  // `record`, when not null, receives a copy of every packet as it is sent.
  PacketSender(const terrain::RayScene& surfaces, const sensors::RangeGate& gate,
               const glm::dvec3& antenna_m, std::vector<terrain::RayPacket<N>>* record)
      : surfaces_(surfaces),
        record_(record),
        far_m_(static_cast<float>(gate.maximum_m() + 2.0 * gate.cell_m)) {
    const glm::dvec3 origin_m = surfaces.in_caster_m(antenna_m);
    for (int i = 0; i < N; ++i) packet_.aim(i, origin_m, glm::dvec3(0.0), 0.0);
  }

  void cast(RayBatch& batch) {
    for (int first = 0; first < batch.count; first += N) {
      for (int i = 0; i < N; ++i) {
        packet_.direction_x[i] = batch.direction_x[first + i];
        packet_.direction_y[i] = batch.direction_y[first + i];
        packet_.direction_z[i] = batch.direction_z[first + i];
        packet_.distance[i] = far_m_;
        packet_.geometry[i] = packet_.instance[i] = terrain::kNoHit;
        active_[i] = first + i < batch.count ? -1 : 0;
      }
      if (record_ != nullptr) record();
      surfaces_.intersect(active_, packet_);
      for (int i = 0; i < N; ++i) {
        batch.distance_m[first + i] = packet_.distance[i];
        batch.normal_x[first + i] = packet_.normal_x[i];
        batch.normal_y[first + i] = packet_.normal_y[i];
        batch.normal_z[first + i] = packet_.normal_z[i];
        batch.geometry[first + i] = packet_.geometry[i];
        batch.primitive[first + i] = packet_.primitive[i];
      }
    }
  }

 private:
  void record() {
    record_->push_back(packet_);
    terrain::RayPacket<N>& copy = record_->back();
    for (int i = 0; i < N; ++i)
      if (active_[i] == 0) copy.near[i] = copy.distance[i] * 2.0F;  // empty: never hits
  }

  const terrain::RayScene& surfaces_;
  std::vector<terrain::RayPacket<N>>* record_;
  float far_m_;
  terrain::RayPacket<N> packet_{};
  alignas(64) int active_[N];
};

}  // namespace fanbeam::renderer
