// What a host tells an image generator by CIGI 3.3: a message's packets as plain data.
//
// Source: CIGI interface control document 3.3, as far as a radar has use of it; field offsets are
// those that TShark's decoder confirms (tests/live/cigi_test.py). One datagram is one message: IG
// Control first, then packets of an id and a size each. The sender's byte order shows in IG Control's
// byte-swap word; both are read. Packets of other ids are passed over by their size and named.
//
// Angles become radians, everything else keeps the protocol's unit, which is said in the name. Numbers are
// finite: a packet with one that is not is left out and counted. Values are otherwise as they came;
// who uses them checks their range.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose.h"

namespace fanbeam::feeds::cigi {

enum class Mode : std::uint8_t { standby, operate, debug, offline };

struct IgControl {
  std::int8_t database = 0;
  Mode mode = Mode::standby;
  bool timestamp_valid = false;
  std::uint8_t minor_version = 3;
  std::uint32_t host_frame = 0, timestamp_10us = 0;
};

struct EntityControl {
  std::uint16_t entity = 0;
  std::uint8_t state = 0;  // 0 inactive, 1 active, 2 destroyed
  bool attached = false;   // to another one: the place is an offset then
  core::Attitude attitude;
  // Latitude and longitude in rad and altitude in m; attached forward, right and down in m.
  glm::dvec3 place{0.0};
};

struct RateControl {
  std::uint16_t entity = 0;
  bool of_part = false;    // an articulated part's: none of the radar's
  bool body_axes = false;  // forward, right, down instead of north, east, down
  glm::dvec3 v_mps{0.0};
};

// Where on an entity the radar sits.
struct ViewControl {
  std::uint16_t entity = 0;
  std::uint8_t enables = 0;  // bits: X, Y, Z, roll, pitch, yaw
  glm::dvec3 offset_m{0.0};  // forward, right, down
  core::Attitude attitude;
};

struct AtmosphereControl {
  bool enabled = false;
  std::uint8_t humidity_percent = 0;
  double temperature_C = 0.0, pressure_hPa = 0.0;
};

struct WeatherControl {
  std::uint8_t layer = 0;  // 0 ground fog, 1 to 3 cloud, 4 rain, 5 snow, ...
  bool enabled = false;
  std::uint8_t scope = 0;     // 0 global, 1 region, 2 entity
  std::uint8_t severity = 0;  // 0 to 5
  double visibility_m = 0.0, base_m = 0.0, thickness_m = 0.0, aerosol_g_per_m3 = 0.0;
};

// Which part of the field of view is wanted.
struct ViewDefinition {
  std::uint8_t enables = 0;  // bits: near, far, left, right, top, bottom
  double near_m = 0.0, far_m = 0.0;
  double left_rad = 0.0, right_rad = 0.0, top_rad = 0.0, bottom_rad = 0.0;
};

struct SensorControl {
  std::uint16_t view = 0;
  std::uint8_t sensor = 0;
  bool on = false, black_hot = false, line_dropout = false, automatic_gain = false;
  std::uint8_t track_mode = 0;  // 0 off
  bool extended_response = false;
  double gain = 0.0, level = 0.0, noise = 0.0;  // 0 to 1
};

// A switch that the image generator defines; of a short packet four words are 0.
struct ComponentControl {
  std::uint16_t component = 0, instance = 0;
  std::uint8_t of = 0;  // 0 entity, 1 view, 2 view group, 3 sensor, ...
  std::uint8_t state = 0;
  bool brief = false;  // came as Short Component Control
  std::array<std::uint32_t, 6> words{};
};

struct CelestialControl {
  bool valid = false;  // date and time are to be taken
  std::uint8_t hour = 0, minute = 0;
  std::uint32_t date = 0;  // MMDDYYYY in decimal digits
};

struct SurfaceConditions {
  std::uint16_t condition = 0;
  bool enabled = false;
  std::uint8_t scope = 0;
};

// What is asked of heights: above the terrain, of it, or both with material and normal.
enum class HeightKind : std::uint8_t { above, of, extended };

struct HeightRequest {
  std::uint16_t request = 0;
  HeightKind kind = HeightKind::above;
  bool of_entity = false;  // the place is an offset from `entity`, forward, right, down in m
  std::uint8_t update_period = 0;  // frames; 0 once
  std::uint16_t entity = 0;
  glm::dvec3 place{0.0};  // latitude and longitude in rad, altitude in m
};

// From a place towards another, or in a direction.
struct SightRequest {
  std::uint16_t request = 0;
  bool extended = false;
  bool segment = false;                         // to `end`, else along `direction`
  bool from_entity = false, to_entity = false;  // offsets as above
  bool answer_in_entity = false;
  std::uint8_t update_period = 0;
  std::uint16_t entity = 0, end_entity = 0;  // of the source and of the end
  glm::dvec3 source{0.0}, end{0.0};          // as HeightRequest::place
  double azimuth_rad = 0.0, elevation_rad = 0.0, least_m = 0.0, most_m = 0.0;
};

using HostPacket = std::variant<EntityControl, RateControl, ViewControl, ViewDefinition,
                                AtmosphereControl, WeatherControl, SurfaceConditions, SensorControl,
                                ComponentControl, CelestialControl, HeightRequest, SightRequest>;

enum class MessageFault { none, length, version, order, size, first };
const char* name_of(MessageFault fault);

struct HostMessage {
  IgControl control;
  std::vector<HostPacket> packets;        // in their order
  std::vector<std::uint8_t> passed_over;  // ids of packets that mean nothing here
  std::size_t nonfinite = 0;              // packets left out
  std::vector<std::uint16_t> unplaced;    // entities whose Entity Control is one of them
};

// Nothing, and why: length (under 24 bytes, over 64 KiB), version (major other than 3), order (no
// byte-swap word), size (a packet of 0 bytes, of another size than its id has, or running past the end), first (another
// packet before IG Control).
std::optional<HostMessage> decode_host_message(std::span<const std::uint8_t> datagram,
                                               MessageFault& fault);

// Of a packet that a host sends, whether it means something here or not: "view_control", "packet 201".
std::string_view packet_name(std::uint8_t id);

}  // namespace fanbeam::feeds::cigi
