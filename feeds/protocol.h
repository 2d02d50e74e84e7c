// The protocols that poses come by, as options name them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "feeds/fg_generic.h"
#include "feeds/native_fdm.h"
#include "feeds/xplane.h"

namespace fanbeam::feeds {

struct Protocol {
  std::string_view name;
  std::optional<AircraftState> (*decode)(std::span<const std::uint8_t>, PacketFault&);
  bool fine_clock = false;  // tells one packet's time from the next one's
  bool subscribed = false;  // sent to who asks for it (live/xplane_link.h)
};

inline constexpr std::array kProtocols{Protocol{"native-fdm", decode_native_fdm, false},
                                       Protocol{"fg-generic", decode_fg_generic, true},
                                       Protocol{"xplane", decode_xplane, false, true}};

}  // namespace fanbeam::feeds
