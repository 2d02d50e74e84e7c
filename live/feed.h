// A simulator's datagrams, from bytes to the newest pose, with what is odd about them. Thread-safe.
//
// Heights are turned into those of the ellipsoid by the datum that the user names. A datum that is
// applied twice or never shifts the aircraft by tens of metres and looks plausible; so the height
// above ground that the simulator tells is held against the scene's where the scene has ground, and a
// median over the last five seconds that is more than 3 m off is told. After a step of the clock or of the
// place the five seconds begin anew. (Terrain may differ by that much in its own right; only the user can
// tell.)
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/geodetic.h"
#include "feeds/protocol.h"
#include "live/clock_gate.h"
#include "live/hub.h"
#include "live/mailbox.h"
#include "live/way_gate.h"
#include "scenes/scene.h"

namespace fanbeam::live {

// What heights of a source count from: its own datum, but that of a scene which does not know its own.
inline core::VerticalDatum datum_of(const scenes::SceneDescription& scene,
                                    core::VerticalDatum source) {
  return scene.datum == core::VerticalDatum::scene ? core::VerticalDatum::scene : source;
}

class Feed {
 public:
  // Poses go into `mailbox`, as those of the source of that number. Throws InputError (E-IO) where the
  // datum's grid is missing.
  Feed(std::shared_ptr<const scenes::Scene> scene, core::VerticalDatum datum,
       const feeds::Protocol& protocol = feeds::kProtocols[0],
       std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>(), std::size_t source = 0);

  // Any bytes, from one thread; whether they are a packet of use by themselves, in their turn. The first after a step of
  // the simulator's clock waits for the next one: then both count, or it is counted as a jump.
  bool take(std::span<const std::uint8_t> datagram, Clock::time_point arrived = Clock::now());
  // One that nobody asked for: counted.
  void turn_away();
  // Of a simulator that tells its weather apart from its packets. What cannot be is counted and not told.
  void tell_visibility(double visibility_m);
  void tell_rain(double norm);
  struct Heard {
    core::Pose pose;                // above the ellipsoid
    std::optional<double> clock_s;  // of its source, where that is fine enough
  };
  // Nothing for bytes that are no packet. Leaves the mailbox alone.
  std::optional<Heard> heard_in(std::span<const std::uint8_t> datagram) const;
  const Mailbox& mailbox() const { return *mailbox_; }
  // What the newest good packet says, weather and all; nothing before the first.
  std::optional<feeds::AircraftState> newest() const;
  // Adds packets, bad ones by reason, and weather that cannot be.
  void tell(Status& status) const;
  // The median of the last five seconds over the scene's ground; nothing before there were as many.
  std::optional<double> height_offset_m() const;

 private:
  struct Taken {
    feeds::AircraftState state;
    std::vector<std::uint8_t> datagram;
    Clock::time_point arrived;
  };
  Heard heard(const feeds::AircraftState& state) const;
  // What is wrong with it beside those before it.
  feeds::PacketFault fault_in_turn(const feeds::AircraftState& state, Clock::time_point arrived);
  void settle(bool counts);
  void put(const Taken& one);
  void count(feeds::PacketFault fault);
  // What of it is told and can be.
  std::optional<feeds::AircraftState> without_impossible_weather(
      std::optional<feeds::AircraftState> state);
  void compare_heights(const core::Pose& pose, double told_m, Clock::time_point arrived);

  std::shared_ptr<const scenes::Scene> scene_;
  core::VerticalDatum datum_;
  const feeds::Protocol& protocol_;  // one of feeds::kProtocols
  ClockGate gate_;
  WayGate way_gate_;             // where there is no fine clock
  std::optional<Taken> jumped_;  // waits
  std::shared_ptr<Mailbox> mailbox_;
  std::size_t source_;
  mutable std::mutex mutex_;
  std::optional<feeds::AircraftState> newest_;
  std::optional<double> visibility_m_, rain_norm_;  // told apart
  std::uint64_t packets_ = 0, impossible_weather_ = 0;
  std::array<std::uint64_t, feeds::kPacketFaults> bad_{};
  struct Compared {
    Clock::time_point arrived;
    double offset_m = 0.0;  // the simulator's height above ground less ours
  };
  std::deque<Compared> compared_;
  Clock::time_point compared_since_{};  // without a break
  std::optional<glm::dvec3> last_m_;    // of the scene's frame
  std::optional<glm::dvec3> apart_m_;   // far from there, and nothing came since
};

}  // namespace fanbeam::live
