// Which columns of a table are a flight's time, position and attitude, told by their names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::scenes {

// A column whose name says what it holds, and perhaps in which unit.
struct NamedColumn {
  std::string name;  // as in the file
  std::size_t index = 0;
  std::string unit;  // "s", "ms", "deg", "rad", "m", "ft"; empty where the name does not say
};

// `pressure`: above the 1013.25 hPa level, off by the day's weather.
enum class HeightKind { unsaid, sea_level, ellipsoid, pressure };

struct NamedHeight : NamedColumn {
  HeightKind kind = HeightKind::unsaid;
};

struct NamedColumns {
  std::optional<NamedColumn> time, latitude, longitude, roll, pitch, heading;
  std::vector<NamedHeight> heights;  // the most telling first
};

// Names are taken apart into words at everything that is no letter or digit and where small letters
// turn into capitals: "Altitude (ft)", "alt_geom_ft", "GeoAltitude", "trueHeading". Heights above
// ground, magnetic headings, rates and what an autopilot was told are left out. Of several columns
// for one quantity the name with the fewest words counts.
NamedColumns recognise_columns(const std::vector<std::string_view>& header);

}  // namespace fanbeam::scenes
