// The line that FlightGear's generic protocol sends with plugins/flightgear/Protocol/fanbeam.xml.
//
//   fanbeam,2,CLOCK,LATITUDE,LONGITUDE,ALTITUDE,AGL,ROLL,PITCH,HEADING,NORTH,EAST,DOWN,VISIBILITY,
//   RAIN,SNOW                                              (on one line)
//
// one datagram a line, its end (line feed, perhaps after a carriage return) optional. Units are the
// simulator's: s since its start, degrees, feet, feet a second, metres of visibility, 0 to 1 of rain and
// snow. Version 1 ends with the visibility. Unlike native-fdm
// angles and velocities have all their digits and the clock has those of the display frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "feeds/aircraft_state.h"

namespace fanbeam::feeds {

// Nothing, and why: length (over 1 KiB), version (another first or second word), format (another
// count of numbers, or a word that is none), nonfinite or range.
std::optional<AircraftState> decode_fg_generic(std::span<const std::uint8_t> datagram,
                                               PacketFault& fault);

}  // namespace fanbeam::feeds
