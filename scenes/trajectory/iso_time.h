// Dates and times as tables of flights write them.
#pragma once

#include <optional>
#include <string_view>

namespace fanbeam::scenes {

// Seconds since 1970-01-01 00:00 UTC, leap seconds not counted (as Unix does), of a date and time
// of ISO 8601: "2024-05-17T08:30:00.25Z", with a blank for the T, without seconds, "+02:00" or
// "+0200" for the zone. Without a zone it is UTC. Years 1900 to 2200. Nothing for any other text.
std::optional<double> unix_time_s(std::string_view text);

}  // namespace fanbeam::scenes
