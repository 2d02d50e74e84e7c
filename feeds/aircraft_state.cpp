#include "feeds/aircraft_state.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace fanbeam::feeds {
namespace {

bool finite(const AircraftState& state) {
  for (const double value :
       {state.longitude_rad, state.latitude_rad, state.altitude_m, state.height_above_ground_m,
        state.attitude.roll_rad, state.attitude.pitch_rad, state.attitude.heading_rad,
        state.v_N_mps.x, state.v_N_mps.y, state.v_N_mps.z, state.clock_s,
        state.visibility_m.value_or(0.0), state.rain_norm.value_or(0.0),
        state.snow_norm.value_or(0.0)})
    if (!std::isfinite(value)) return false;
  return true;
}

bool possible(const AircraftState& state) {
  constexpr double kFastest_mps = 10e3, kMostTurns_rad = 1e3;
  const auto turned = [](double rad) { return std::abs(rad) <= kMostTurns_rad; };
  // Nothing but zeros: the simulator has not started.
  if (state.latitude_rad == 0.0 && state.longitude_rad == 0.0 && state.altitude_m == 0.0)
    return false;
  return is_on_earth(state.latitude_rad, state.longitude_rad, state.altitude_m) &&
         turned(state.attitude.roll_rad) && turned(state.attitude.pitch_rad) &&
         turned(state.attitude.heading_rad) && std::abs(state.v_N_mps.x) <= kFastest_mps &&
         std::abs(state.v_N_mps.y) <= kFastest_mps && std::abs(state.v_N_mps.z) <= kFastest_mps;
}

}  // namespace

const char* name_of(PacketFault fault) {
  switch (fault) {
    case PacketFault::none:
      return "none";
    case PacketFault::length:
      return "another length";
    case PacketFault::version:
      return "another version";
    case PacketFault::format:
      return "not numbers between commas";
    case PacketFault::nonfinite:
      return "a number that is not finite";
    case PacketFault::range:
      return "a position, attitude or speed that cannot be";
    case PacketFault::foreign:
      return "from no peer";
    case PacketFault::late:
      return "late, or come twice";
    case PacketFault::jump:
      return "a jump of the simulator's clock";
    case PacketFault::step:
      return "a step that no aircraft makes";
  }
  return "";
}

bool is_on_earth(double latitude_rad, double longitude_rad, double altitude_m) {
  // Of a sender with the true pi, native-fdm's poles come out 1e-8 beyond.
  return std::abs(latitude_rad) <= core::kPi / 2 * (1.0 + 1e-8) &&
         std::abs(longitude_rad) <= 3.0 * core::kPi && altitude_m >= -20e3 && altitude_m <= 1000e3;
}

PacketFault fault_in(const AircraftState& state) {
  if (!finite(state)) return PacketFault::nonfinite;
  return possible(state) ? PacketFault::none : PacketFault::range;
}

int forget_impossible_weather(AircraftState& state) {
  int forgotten = 0;
  const auto forget_unless = [&](std::optional<double>& value, bool possible) {
    if (!value || (possible && std::isfinite(*value))) return;
    value.reset();
    ++forgotten;
  };
  forget_unless(state.visibility_m, state.visibility_m > 0.0);
  for (std::optional<double>* const norm : {&state.rain_norm, &state.snow_norm})
    forget_unless(*norm, *norm >= 0.0 && *norm <= 1.0);
  return forgotten;
}

core::Geodetic place_on_earth(double latitude_rad, double longitude_rad, double altitude_m) {
  return {std::clamp(latitude_rad, -core::kPi / 2, core::kPi / 2), longitude_rad, altitude_m};
}

core::Pose pose_of(const AircraftState& state) {
  core::Pose pose;
  pose.position = place_on_earth(state.latitude_rad, state.longitude_rad, state.altitude_m);
  pose.q_NB = core::quaternion_from(state.attitude);
  pose.v_N_mps = state.v_N_mps;
  return pose;
}

}  // namespace fanbeam::feeds
