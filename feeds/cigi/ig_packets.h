// What an image generator tells its host by CIGI 3.3: packets as bytes.
//
// Source and units as in host_packets.h; angles go in as radians. A message begins with
// start_of_frame, whose byte-swap word tells the order of all that follows: `swap` writes the other
// order than this machine's, for hosts that want it and for tests.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "feeds/cigi/host_packets.h"

namespace fanbeam::feeds::cigi {

using Bytes = std::vector<std::uint8_t>;

struct StartOfFrame {
  std::int8_t database = 0;  // negative while it loads
  std::uint8_t status = 0;   // 0 normal
  Mode mode = Mode::standby;
  std::uint8_t minor_version = 3;
  std::uint32_t ig_frame = 0, timestamp_10us = 0, last_host_frame = 0;
};

struct HeightResponse {
  std::uint16_t request = 0;
  bool valid = false;
  HeightKind kind = HeightKind::above;
  double height_m = 0.0;  // above or of the ground; extended both
  double ground_m = 0.0;
  std::uint32_t material = 0;
  double normal_azimuth_rad = 0.0, normal_elevation_rad = 0.0;
};

struct SightResponse {
  std::uint16_t request = 0;
  bool extended = false, valid = false;
  bool visible = false;  // of a segment: nothing stands between
  double range_m = 0.0;
  glm::dvec3 point{0.0};  // latitude and longitude in rad, altitude in m
  std::uint32_t material = 0;
  double normal_azimuth_rad = 0.0, normal_elevation_rad = 0.0;
};

// Of a sensor that tracks nothing: it searches, without a gate.
struct SensorResponse {
  std::uint16_t view = 0;
  std::uint8_t sensor = 0;
  bool extended = false;
};

// Something that the host asked for is in force; what data mean is the image generator's to define.
struct Event {
  std::uint16_t event = 0;
  std::array<std::uint32_t, 3> data{};
};

Bytes start_of_frame(const StartOfFrame& told, bool swap = false);
// `host_frame`: that of the request, of which the lowest four bits go into the answer.
Bytes height_response(const HeightResponse& told, std::uint32_t host_frame, bool swap = false);
Bytes sight_response(const SightResponse& told, std::uint32_t host_frame, bool swap = false);
// `host_frame`: that whose sensor control the picture shows.
Bytes sensor_response(const SensorResponse& told, std::uint32_t host_frame, bool swap = false);
Bytes event_notification(const Event& told, bool swap = false);
// Text beyond 100 bytes is cut.
Bytes ig_message(std::uint16_t number, std::string_view text, bool swap = false);

}  // namespace fanbeam::feeds::cigi
