// Keeps out packets that another one overtook, of a source that tells no fine clock (native-fdm's has steps of a second).
//
// Such a packet lies where the aircraft has just been: on the straight way between the two that came before it, within
// a tenth of it, with the velocity that both tell, which is along that way. No aircraft comes there again within a
// packet's time but by telling other velocities, whether it turns, hovers (below 10 m/s nothing is kept out) or flies
// backwards. One that is put back there, or a replay that is wound back, costs one packet: of two such packets in a
// row the second counts, unless it is ahead of the first and came at once with it, as what was held back does.
// Packets have to come four times a second or more. Pure.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace fanbeam::live {

class WayGate {
 public:
  struct Packet {
    double arrived_s = 0.0;
    glm::dvec3 at_m{0.0}, v_mps{0.0};  // of one frame
  };

  // Whether it counts. Finite numbers; `arrived_s` rises.
  bool take(const Packet& packet) {
    constexpr double kAsMuchLater = 0.5;
    if (const std::optional<double> flown_s = overtaken_s(packet)) {
      const bool put_back =
          late_ && (*flown_s <= late_->flown_s || packet.arrived_s - late_->arrived_s >=
                                                      kAsMuchLater * (*flown_s - late_->flown_s));
      late_ = {packet.arrived_s, *flown_s};
      if (!put_back) return false;
    }
    before_ = last_;
    last_ = packet;
    late_.reset();
    return true;
  }

 private:
  struct Late {
    double arrived_s = 0.0, flown_s = 0.0;
  };

  // Seconds of flight from the last packet but one to this one, if it lies between that one and the last.
  std::optional<double> overtaken_s(const Packet& packet) const {
    constexpr double kSlow_mps = 10.0, kLeast_m = 0.01, kLongest_s = 1.0, kAlike = 0.1;
    constexpr double kEnd = 0.95;  // of the way; the same place again is a pause
    if (!before_ || packet.arrived_s - before_->arrived_s > kLongest_s) return std::nullopt;
    const glm::dvec3 way_m = last_->at_m - before_->at_m;
    const glm::dvec3 v_mps = 0.5 * (last_->v_mps + before_->v_mps);
    const double length_m = glm::length(way_m), speed_mps = glm::length(v_mps);
    if (speed_mps <= kSlow_mps || length_m < kLeast_m) return std::nullopt;
    const double whole_s = glm::dot(way_m, v_mps) / (speed_mps * speed_mps);
    const double share = glm::dot(packet.at_m - before_->at_m, way_m) / (length_m * length_m);
    const bool as_told = whole_s > 0.0 && whole_s <= kLongest_s &&
                         glm::distance(way_m, whole_s * v_mps) <= kAlike * length_m;
    const bool between =
        share >= 0.0 && share <= kEnd &&
        glm::distance(packet.at_m, before_->at_m + share * way_m) <= kAlike * length_m;
    const bool as_fast = glm::distance(packet.v_mps, v_mps) <= kAlike * speed_mps;
    return as_told && between && as_fast ? std::optional(share * whole_s) : std::nullopt;
  }

  std::optional<Packet> before_, last_;
  std::optional<Late> late_;  // since a packet was taken
};

}  // namespace fanbeam::live
