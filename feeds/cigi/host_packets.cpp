#include "feeds/cigi/host_packets.h"

#include <algorithm>

#include "core/units.h"
#include "feeds/bytes.h"

namespace fanbeam::feeds::cigi {
namespace {

constexpr std::size_t kIgControl_bytes = 24, kMost_bytes = 64 * 1024;
constexpr std::uint16_t kOwnOrder = 0x8000, kOtherOrder = 0x0080;
constexpr std::uint8_t kIgControl = 1;

double angle_at(Fields& fields, std::size_t offset) {
  return core::radians(fields.number32(offset));
}

core::Attitude attitude_at(Fields& fields, std::size_t offset) {
  return {angle_at(fields, offset), angle_at(fields, offset + 4), angle_at(fields, offset + 8)};
}

glm::dvec3 floats_at(Fields& fields, std::size_t offset) {
  return {fields.number32(offset), fields.number32(offset + 4), fields.number32(offset + 8)};
}

// Three doubles, of which the first two are degrees unless it is an offset.
glm::dvec3 place_at(Fields& fields, std::size_t offset, bool is_offset) {
  const glm::dvec3 place{fields.number64(offset), fields.number64(offset + 8),
                         fields.number64(offset + 16)};
  return is_offset ? place : glm::dvec3(core::radians(place.x), core::radians(place.y), place.z);
}

HostPacket entity_control(Fields& f) {
  EntityControl packet;
  packet.entity = f.at<std::uint16_t>(2);
  packet.state = f.bits(4, 0, 2);
  packet.attached = f.bits(4, 2) != 0;
  packet.attitude = attitude_at(f, 12);
  packet.place = place_at(f, 24, packet.attached);
  return packet;
}

HostPacket rate_control(Fields& f) {
  RateControl packet;
  packet.entity = f.at<std::uint16_t>(2);
  packet.of_part = f.bits(5, 0) != 0;
  packet.body_axes = f.bits(5, 1) != 0;
  packet.v_mps = floats_at(f, 8);
  return packet;
}

HostPacket view_control(Fields& f) {
  ViewControl packet;
  packet.enables = f.bits(5, 0, 6);
  packet.entity = f.at<std::uint16_t>(6);
  packet.offset_m = floats_at(f, 8);
  packet.attitude = attitude_at(f, 20);
  return packet;
}

HostPacket atmosphere_control(Fields& f) {
  AtmosphereControl packet;
  packet.enabled = f.bits(2, 0) != 0;
  packet.humidity_percent = f.byte(3);
  packet.temperature_C = f.number32(4);
  packet.pressure_hPa = f.number32(24);
  return packet;
}

HostPacket weather_control(Fields& f) {
  WeatherControl packet;
  packet.layer = f.byte(4);
  packet.enabled = f.bits(6, 0) != 0;
  packet.scope = f.bits(7, 0, 2);
  packet.severity = f.bits(7, 2, 3);
  packet.visibility_m = f.number32(12);
  packet.base_m = f.number32(24);
  packet.thickness_m = f.number32(28);
  packet.aerosol_g_per_m3 = f.number32(52);
  return packet;
}

HostPacket view_definition(Fields& f) {
  ViewDefinition packet;
  packet.enables = f.bits(5, 0, 6);
  packet.near_m = f.number32(8);
  packet.far_m = f.number32(12);
  packet.left_rad = angle_at(f, 16);
  packet.right_rad = angle_at(f, 20);
  packet.top_rad = angle_at(f, 24);
  packet.bottom_rad = angle_at(f, 28);
  return packet;
}

HostPacket sensor_control(Fields& f) {
  SensorControl packet;
  packet.view = f.at<std::uint16_t>(2);
  packet.sensor = f.byte(4);
  packet.on = f.bits(5, 0) != 0;
  packet.black_hot = f.bits(5, 1) != 0;
  packet.line_dropout = f.bits(5, 2) != 0;
  packet.automatic_gain = f.bits(5, 3) != 0;
  packet.track_mode = f.bits(5, 5, 3);
  packet.extended_response = f.bits(6, 0) != 0;
  packet.gain = f.number32(8);
  packet.level = f.number32(12);
  packet.noise = f.number32(20);
  return packet;
}

template <std::size_t Words>
HostPacket component_control(Fields& f) {
  ComponentControl packet;
  packet.component = f.at<std::uint16_t>(2);
  packet.instance = f.at<std::uint16_t>(4);
  packet.of = f.bits(6, 0, 6);
  packet.state = f.byte(7);
  packet.brief = Words < packet.words.size();
  for (std::size_t i = 0; i < Words; ++i) packet.words[i] = f.at<std::uint32_t>(8 + 4 * i);
  return packet;
}

HostPacket celestial_control(Fields& f) {
  CelestialControl packet;
  packet.hour = f.byte(2);
  packet.minute = f.byte(3);
  packet.valid = f.bits(4, 4) != 0;
  packet.date = f.at<std::uint32_t>(8);
  return packet;
}

HostPacket surface_conditions(Fields& f) {
  SurfaceConditions packet;
  packet.condition = f.at<std::uint16_t>(4);
  packet.enabled = f.bits(6, 0) != 0;
  packet.scope = f.bits(6, 1, 2);
  return packet;
}

HostPacket height_request(Fields& f) {
  HeightRequest packet;
  packet.request = f.at<std::uint16_t>(2);
  // There are three kinds in two bits.
  packet.kind = static_cast<HeightKind>(std::min<std::uint8_t>(f.bits(4, 0, 2), 2));
  packet.of_entity = f.bits(4, 2) != 0;
  packet.update_period = f.byte(5);
  packet.entity = f.at<std::uint16_t>(6);
  packet.place = place_at(f, 8, packet.of_entity);
  return packet;
}

HostPacket sight_segment_request(Fields& f) {
  SightRequest packet;
  packet.segment = true;
  packet.request = f.at<std::uint16_t>(2);
  packet.extended = f.bits(4, 0) != 0;
  packet.from_entity = f.bits(4, 1) != 0;
  packet.to_entity = f.bits(4, 2) != 0;
  packet.answer_in_entity = f.bits(4, 3) != 0;
  packet.entity = f.at<std::uint16_t>(6);
  // Unless the end names its own, both are offsets from one.
  packet.end_entity = f.bits(4, 4) != 0 ? f.at<std::uint16_t>(62) : packet.entity;
  packet.source = place_at(f, 8, packet.from_entity);
  packet.end = place_at(f, 32, packet.to_entity);
  packet.update_period = f.byte(60);
  return packet;
}

HostPacket sight_vector_request(Fields& f) {
  SightRequest packet;
  packet.request = f.at<std::uint16_t>(2);
  packet.extended = f.bits(4, 0) != 0;
  packet.from_entity = f.bits(4, 1) != 0;
  packet.answer_in_entity = f.bits(4, 2) != 0;
  packet.entity = f.at<std::uint16_t>(6);
  packet.azimuth_rad = angle_at(f, 8);
  packet.elevation_rad = angle_at(f, 12);
  packet.least_m = f.number32(16);
  packet.most_m = f.number32(20);
  packet.source = place_at(f, 24, packet.from_entity);
  packet.update_period = f.byte(52);
  return packet;
}

struct Kind {
  std::uint8_t id = 0, size = 0;
  std::string_view name;
  HostPacket (*decode)(Fields&) = nullptr;  // null: means nothing to a radar
};

constexpr Kind kKinds[] = {
    {kIgControl, kIgControl_bytes, "ig_control", nullptr},
    {2, 48, "entity_control", entity_control},
    {3, 24, "conformal_clamped_entity_control", nullptr},
    {4, 32, "component_control", component_control<6>},
    {5, 16, "short_component_control", component_control<2>},
    {6, 32, "articulated_part_control", nullptr},
    {7, 16, "short_articulated_part_control", nullptr},
    {8, 32, "rate_control", rate_control},
    {9, 16, "celestial_sphere_control", celestial_control},
    {10, 32, "atmosphere_control", atmosphere_control},
    {11, 48, "environmental_region_control", nullptr},
    {12, 56, "weather_control", weather_control},
    {13, 24, "maritime_surface_conditions_control", nullptr},
    {14, 32, "wave_control", nullptr},
    {15, 8, "terrestrial_surface_conditions_control", surface_conditions},
    {16, 32, "view_control", view_control},
    {17, 24, "sensor_control", sensor_control},
    {18, 8, "motion_tracker_control", nullptr},
    {19, 24, "earth_reference_model_definition", nullptr},
    {20, 24, "trajectory_definition", nullptr},
    {21, 32, "view_definition", view_definition},
    {22, 40, "collision_detection_segment_definition", nullptr},
    {23, 48, "collision_detection_volume_definition", nullptr},
    {24, 32, "hat_hot_request", height_request},
    {25, 64, "line_of_sight_segment_request", sight_segment_request},
    {26, 56, "line_of_sight_vector_request", sight_vector_request},
    {27, 8, "position_request", nullptr},
    {28, 32, "environmental_conditions_request", nullptr},
    {29, 0, "symbol_surface_definition", nullptr},
    {30, 0, "symbol_text_definition", nullptr},
    {31, 0, "symbol_circle_definition", nullptr},
    {32, 0, "symbol_line_definition", nullptr},
    {33, 0, "symbol_clone", nullptr},
    {34, 0, "symbol_control", nullptr},
    {35, 0, "short_symbol_control", nullptr},
};

const Kind* kind_of(std::uint8_t id) {
  for (const Kind& kind : kKinds)
    if (kind.id == id) return &kind;
  return nullptr;
}

IgControl ig_control(const Fields& f) {
  IgControl control;
  control.database = static_cast<std::int8_t>(f.byte(3));
  control.mode = static_cast<Mode>(f.bits(4, 0, 2));
  control.timestamp_valid = f.bits(4, 2) != 0;
  control.minor_version = f.bits(4, 4, 4);
  control.host_frame = f.at<std::uint32_t>(8);
  control.timestamp_10us = f.at<std::uint32_t>(12);
  return control;
}

// Into `message`; false for a packet of a size that cannot be.
bool take_packet(std::span<const std::uint8_t> packet, bool swap, HostMessage& message) {
  const Kind* kind = kind_of(packet[0]);
  if (kind == nullptr || kind->decode == nullptr) {
    message.passed_over.push_back(packet[0]);
    return true;
  }
  if (packet.size() != kind->size) return false;
  Fields fields(packet, swap);
  HostPacket decoded = kind->decode(fields);
  if (fields.all_finite()) {
    message.packets.push_back(decoded);
    return true;
  }
  ++message.nonfinite;
  if (const auto* control = std::get_if<EntityControl>(&decoded))
    message.unplaced.push_back(control->entity);
  return true;
}

}  // namespace

const char* name_of(MessageFault fault) {
  switch (fault) {
    case MessageFault::none:
      return "none";
    case MessageFault::length:
      return "another length";
    case MessageFault::version:
      return "another version";
    case MessageFault::order:
      return "no byte-swap word";
    case MessageFault::size:
      return "a packet of a size that cannot be";
    case MessageFault::first:
      return "another packet before IG Control";
  }
  return "";
}

std::optional<HostMessage> decode_host_message(std::span<const std::uint8_t> datagram,
                                               MessageFault& fault) {
  const auto refuse = [&](MessageFault why) {
    fault = why;
    return std::nullopt;
  };
  if (datagram.size() < kIgControl_bytes || datagram.size() > kMost_bytes)
    return refuse(MessageFault::length);
  if (datagram[0] != kIgControl) return refuse(MessageFault::first);
  if (datagram[1] != kIgControl_bytes) return refuse(MessageFault::size);
  if (datagram[2] != 3) return refuse(MessageFault::version);
  const auto order = Fields(datagram, false).at<std::uint16_t>(6);
  if (order != kOwnOrder && order != kOtherOrder) return refuse(MessageFault::order);
  const bool swap = order == kOtherOrder;
  HostMessage message;
  message.control = ig_control(Fields(datagram.first(kIgControl_bytes), swap));
  for (auto rest = datagram.subspan(kIgControl_bytes); !rest.empty();) {
    if (rest.size() < 2 || rest[1] < 2 || rest[1] > rest.size()) return refuse(MessageFault::size);
    if (!take_packet(rest.first(rest[1]), swap, message)) return refuse(MessageFault::size);
    rest = rest.subspan(rest[1]);
  }
  fault = MessageFault::none;
  return message;
}

std::string_view packet_name(std::uint8_t id) {
  const Kind* kind = kind_of(id);
  if (kind != nullptr) return kind->name;
  return id > 200 ? "user_defined" : "unknown";
}

}  // namespace fanbeam::feeds::cigi
