// Radar video as ASTERIX category 240 carries it: messages as bytes, one data block of one record each.
//
// Source: EUROCONTROL-SPEC-0149-240, edition 1.3. Numbers are big-endian. A radial is what the radar sees
// between two azimuths, clockwise from a reference that the summary's text names. Its cells follow one
// another from `first_cell` on: cell k, from 1, begins at the range D (f + k - 1) c / 2 of the cell
// duration D. Durations go in femtoseconds (item 041), so that a 5 m cell is exact to 2e-8.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace fanbeam::feeds::cat240 {

using Bytes = std::vector<std::uint8_t>;

struct Source {
  std::uint8_t area = 0, code = 0;  // SAC and SIC, as the recipient's network assigns them
};

enum class CellBits : std::uint8_t { eight = 4, sixteen = 5 };  // as item 048 numbers them

struct Radial {
  double start_azimuth_rad = 0.0, end_azimuth_rad = 0.0;  // any turn
  std::uint32_t first_cell = 0;        // whole cells between the antenna and the first one
  std::uint32_t cell_duration_fs = 0;  // of the way there and back
  CellBits bits = CellBits::eight;
  std::span<const std::uint8_t> cells;  // of two octets each big-endian
  double time_of_day_s = 0.0;           // UTC, since midnight
};

struct Packing {
  std::size_t most_bytes = 1472;  // of a datagram, at least kFewestBytes
  bool zlib = false;  // marked as compressed; the algorithm is a matter of private agreement
};

inline constexpr std::size_t kFewestBytes = 548;  // what every IPv4 path takes whole

// Text in ASCII, of which 255 characters go in; any other character becomes a question mark.
Bytes summary(const Source& source, double time_of_day_s, std::string_view text);

// A radial as messages, each with a piece of its cells that stays within a datagram; `counter` is the
// first one's number and becomes the next one's.
std::vector<Bytes> video(const Source& source, const Radial& radial, const Packing& packing,
                         std::uint32_t& counter);

}  // namespace fanbeam::feeds::cat240
