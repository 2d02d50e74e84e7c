// The entities of a CIGI host: where they are, how they move, and the pose of a radar on one of them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "core/geodetic.h"
#include "feeds/cigi/host_packets.h"
#include "terrain/local_frame.h"

namespace fanbeam::live {

class CigiEntities {
 public:
  // What altitudes count from.
  explicit CigiEntities(core::VerticalDatum datum) : datum_(datum) {}

  enum class Placed { yes, impossible, too_many };

  // An entity that is active; another one is forgotten. What is attached to another entity is left
  // alone. A place that is not on Earth, and an entity beyond the 4096th, is refused: what was there stays.
  // `time_s` is that of the host's message: velocity is what the last two places were apart over it,
  // within a second and below 2 km/s.
  Placed place(const feeds::cigi::EntityControl& packet, double time_s,
               const terrain::LocalFrame& frame);
  // The velocity that the host tells counts from then on, until it tells another one or the entity is forgotten:
  // one in body axes turns with it. Of an entity that is not known it is left out.
  void move(const feeds::cigi::RateControl& packet);
  void clear() { entities_.clear(); }

  std::optional<core::Pose> pose(std::uint16_t entity) const;
  // Of what sits on it with the offset and angles that are enabled.
  std::optional<core::Pose> pose(const feeds::cigi::ViewControl& view,
                                 const terrain::LocalFrame& frame) const;

 private:
  struct Entity {
    core::Pose pose;
    double time_s = 0.0;
    std::optional<feeds::cigi::RateControl> told{};
  };

  core::VerticalDatum datum_;
  std::map<std::uint16_t, Entity> entities_;
};

}  // namespace fanbeam::live
