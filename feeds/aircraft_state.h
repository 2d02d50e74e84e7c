// What a simulator's packet says of its aircraft, in SI units and radians, whatever its protocol.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/geodetic.h"
#include "core/pose.h"

namespace fanbeam::feeds {

struct AircraftState {
  double longitude_rad = 0.0, latitude_rad = 0.0;
  double altitude_m = 0.0;  // from the simulator's own sea level
  double height_above_ground_m = 0.0;
  core::Attitude attitude;
  glm::dvec3 v_N_mps{0.0};  // north, east, down
  // Where the aircraft is; nothing where the protocol does not tell. What falls as the simulator draws it:
  // 0 none, 1 its heaviest.
  std::optional<double> visibility_m, rain_norm, snow_norm;
  double clock_s = 0.0;  // of the simulator
};

// Why a datagram is none.
enum class PacketFault {
  none,
  length,
  version,
  format,
  nonfinite,
  range,
  late,
  jump,
  step,
  foreign
};
inline constexpr std::size_t kPacketFaults = 10;  // with none
const char* name_of(PacketFault fault);

// late and jump are of the packets before it (live/clock_gate.h, way_gate.h), step too: a place that no aircraft reaches from
// there (live/predictor.h); foreign of who sent it; nonfinite: a
// number that is not. range: a latitude beyond 90 deg, a longitude beyond 540 deg, a height beyond -20
// to 1000 km, an angle over 1000 rad, a speed over 10 km/s, or latitude, longitude and altitude that
// are all exactly 0, as before a simulator has started.
PacketFault fault_in(const AircraftState& state);

// Takes out of the weather what cannot be, as if it had not been told: a visibility not above 0, rain and snow beyond
// 0 to 1, what is no finite number. Gives how many there were.
int forget_impossible_weather(AircraftState& state);

// A latitude, longitude and altitude within those limits.
bool is_on_earth(double latitude_rad, double longitude_rad, double altitude_m);

// Such a place on the ellipsoid, at the pole where rounding led beyond it; the height is the altitude.
core::Geodetic place_on_earth(double latitude_rad, double longitude_rad, double altitude_m);

// At time 0; the height is `altitude_m`. Of a state without fault.
core::Pose pose_of(const AircraftState& state);

}  // namespace fanbeam::feeds
