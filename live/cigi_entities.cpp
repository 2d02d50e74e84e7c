#include "live/cigi_entities.h"

#include <glm/geometric.hpp>
#include <utility>

#include "feeds/aircraft_state.h"
#include "terrain/geoid.h"

namespace fanbeam::live {
namespace {

namespace cigi = feeds::cigi;

constexpr std::size_t kMostEntities = 4096;

core::Attitude enabled(const cigi::ViewControl& view) {
  const auto part = [&](unsigned bit, double angle_rad) {
    return (view.enables >> bit & 1U) != 0U ? angle_rad : 0.0;
  };
  return {part(3, view.attitude.roll_rad), part(4, view.attitude.pitch_rad),
          part(5, view.attitude.heading_rad)};
}

glm::dvec3 enabled_offset_m(const cigi::ViewControl& view) {
  glm::dvec3 offset_m{0.0};
  for (int axis = 0; axis < 3; ++axis)
    if ((view.enables >> axis & 1) != 0) offset_m[axis] = view.offset_m[axis];
  return offset_m;
}

}  // namespace

CigiEntities::Placed CigiEntities::place(const cigi::EntityControl& packet, double time_s,
                                         const terrain::LocalFrame& frame) {
  constexpr std::uint8_t kActive = 1;
  if (packet.state != kActive) {
    entities_.erase(packet.entity);
    return Placed::yes;
  }
  if (packet.attached) return Placed::yes;  // no aircraft
  if (!feeds::is_on_earth(packet.place.x, packet.place.y, packet.place.z))
    return Placed::impossible;
  const auto before = entities_.find(packet.entity);
  if (before == entities_.end() && entities_.size() >= kMostEntities) return Placed::too_many;
  Entity now;
  now.time_s = time_s;
  now.pose.position = feeds::place_on_earth(packet.place.x, packet.place.y, packet.place.z);
  now.pose.position.height_m = terrain::ellipsoidal_height_m(now.pose.position, datum_);
  now.pose.q_NB = core::quaternion_from(packet.attitude);
  constexpr double kMostApart_s = 1.0, kFastest_mps = 2000.0;
  if (before != entities_.end()) {
    const double apart_s = time_s - before->second.time_s;
    const glm::dvec3 moved_m =
        frame.to_local_m(now.pose.position) - frame.to_local_m(before->second.pose.position);
    if (apart_s > 0.0 && apart_s < kMostApart_s && glm::length(moved_m) < kFastest_mps * apart_s)
      now.pose.v_N_mps = moved_m / apart_s * frame.north_east_down_at(now.pose.position);
    now.told = before->second.told;
  }
  entities_[packet.entity] = now;
  return Placed::yes;
}

void CigiEntities::move(const cigi::RateControl& packet) {
  const auto known = entities_.find(packet.entity);
  if (!packet.of_part && known != entities_.end()) known->second.told = packet;
}

std::optional<core::Pose> CigiEntities::pose(std::uint16_t entity) const {
  const auto known = entities_.find(entity);
  if (known == entities_.end()) return std::nullopt;
  core::Pose pose = known->second.pose;
  if (const auto& told = known->second.told)
    pose.v_N_mps = told->body_axes ? pose.q_NB * told->v_mps : told->v_mps;
  return pose;
}

std::optional<core::Pose> CigiEntities::pose(const cigi::ViewControl& view,
                                             const terrain::LocalFrame& frame) const {
  std::optional<core::Pose> pose = this->pose(view.entity);
  if (!pose) return std::nullopt;
  const glm::dvec3 offset_m = enabled_offset_m(view);
  if (offset_m != glm::dvec3(0.0)) {
    pose->position =
        frame.to_geodetic(frame.to_local_m(pose->position) +
                          frame.north_east_down_at(pose->position) * (pose->q_NB * offset_m));
  }
  pose->q_NB = pose->q_NB * core::quaternion_from(enabled(view));
  return pose;
}

}  // namespace fanbeam::live
