// A flight from the datagrams that a simulator sent and somebody recorded (feeds/packet_file.h).
//
// Times are those of the simulator's clock where the protocol tells it finely, else of arrival, from
// the first packet of the flight on. A "row" is a datagram to the flight's port, from 1. Packets that
// are none of the protocol, and those that came twice or late, are left out and counted in warnings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/errors.h"
#include "feeds/protocol.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

struct TrackPackets {
  const feeds::Protocol* protocol = nullptr;  // one of feeds::kProtocols; null: a table
  std::optional<std::uint16_t> port;          // needed where several ports have packets of it
};

// As read_track_csv, and of `columns` the windows and the offset of heights; with attitude. Adds
//   E-REF    several ports have such packets and none is named; none has any
//   E-TIME   the simulator's clock goes back by more than a second (reset, replay)
//   W-PACKETS  what was left out, by reason
// and what feeds/packet_file.h says.
RawTrack read_track_packets(const std::filesystem::path& path, const TrackPackets& packets,
                            const TrajectoryColumns& columns, core::ProblemList& problems);

}  // namespace fanbeam::scenes
