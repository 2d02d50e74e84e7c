// Datagrams that somebody recorded: a packet capture, or fanbeam's own raw form.
//
// Packet capture: the file format of libpcap (tcpdump -w; magic numbers a1b2c3d4 and a1b23c4d), of
// either byte order. Links: Ethernet (VLAN tags too), BSD loopback, raw IP, Linux cooked 1 and 2. What
// is not UDP over IPv4 or IPv6 is passed over, as are fragments, IPv6 extension headers and packets
// that were cut short as they were captured. Checksums are not looked at: loopback has none.
// Not read: pcapng (`editcap -F pcap` turns it into a capture).
// Raw: little-endian, repeated: f64 time in s, u16 port, u16 length, that many bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "core/errors.h"

namespace fanbeam::feeds {

struct RecordedDatagram {
  double time_s = 0.0;     // of the file's clock, finite; in a capture since 1970
  std::uint16_t port = 0;  // it was sent to
  std::span<const std::uint8_t> bytes;
  std::int64_t byte_offset = 0;  // of its record in the file
};

// In the file's order, which need not be that of time; the bytes are gone after the call.
using EachDatagram = std::function<void(const RecordedDatagram&)>;

// E-IO, E-REF for a file of neither form, E-PARSE with the offset of a record that cannot be (a
// capture's longer than 256 KiB, a time that is not finite); a last record that is cut off, as in a
// recording that was killed, is left out with the warning W-CUT. The file is never held in memory.
void read_datagrams(const std::filesystem::path& file, const EachDatagram& each,
                    core::ProblemList& problems);

}  // namespace fanbeam::feeds
