#include "feeds/fg_generic.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/units.h"

namespace fanbeam::feeds {
namespace {

constexpr std::size_t kMost_bytes = 1024;
constexpr std::string_view kBeginning = "fanbeam,2,", kFirstVersion = "fanbeam,1,";

// All that stands between commas; nothing where that is another count, or no number.
using Numbers = std::array<double, 14>;
std::optional<Numbers> numbers_in(std::string_view text, std::size_t count) {
  Numbers numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [next, fault] = std::from_chars(at, end, numbers[i]);
    // What double does not hold is told as not finite.
    if (fault == std::errc::result_out_of_range)
      numbers[i] = HUGE_VAL;
    else if (fault != std::errc())
      return std::nullopt;
    at = next;
    if (i + 1 == count) break;
    if (at == end || *at != ',') return std::nullopt;
    ++at;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

std::string_view without_line_end(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<AircraftState> decode_fg_generic(std::span<const std::uint8_t> datagram,
                                               PacketFault& fault) {
  const auto refuse = [&](PacketFault why) {
    fault = why;
    return std::nullopt;
  };
  if (datagram.size() > kMost_bytes) return refuse(PacketFault::length);
  const std::string_view text(reinterpret_cast<const char*>(datagram.data()), datagram.size());
  const bool first_version = text.starts_with(kFirstVersion);
  if (!first_version && !text.starts_with(kBeginning)) return refuse(PacketFault::version);
  const auto numbers =
      numbers_in(without_line_end(text.substr(kBeginning.size())), first_version ? 12 : 14);
  if (!numbers) return refuse(PacketFault::format);
  const auto& [clock_s, latitude_deg, longitude_deg, altitude_ft, above_ground_ft, roll_deg,
               pitch_deg, heading_deg, north_fps, east_fps, down_fps, visibility_m, rain_norm,
               snow_norm] = *numbers;
  AircraftState state;
  state.clock_s = clock_s;
  state.latitude_rad = core::radians(latitude_deg);
  state.longitude_rad = core::radians(longitude_deg);
  state.altitude_m = core::kFoot_m * altitude_ft;
  state.height_above_ground_m = core::kFoot_m * above_ground_ft;
  state.attitude = {core::radians(roll_deg), core::radians(pitch_deg), core::radians(heading_deg)};
  state.v_N_mps = core::kFoot_m * glm::dvec3(north_fps, east_fps, down_fps);
  state.visibility_m = visibility_m;
  if (!first_version) {
    state.rain_norm = rain_norm;
    state.snow_norm = snow_norm;
  }
  fault = fault_in(state);
  return fault == PacketFault::none ? std::optional(state) : std::nullopt;
}

}  // namespace fanbeam::feeds
