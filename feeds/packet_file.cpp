#include "feeds/packet_file.h"

#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/files.h"
#include "feeds/bytes.h"

namespace fanbeam::feeds {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kLongest_bytes = 256 * 1024;

std::uint16_t big_endian(Bytes bytes, std::size_t offset) {
  return Fields(bytes, kSwapBig).at<std::uint16_t>(offset);
}

struct Udp {
  std::uint16_t port = 0;
  Bytes payload;
};

std::optional<Udp> udp_in(Bytes segment) {
  if (segment.size() < 8) return std::nullopt;
  const std::size_t length = big_endian(segment, 4);
  if (length < 8 || length > segment.size()) return std::nullopt;
  return Udp{big_endian(segment, 2), segment.subspan(8, length - 8)};
}

std::optional<Udp> ip_in(Bytes packet) {
  constexpr std::uint8_t kUdp = 17;
  if (packet.empty()) return std::nullopt;
  if (packet[0] >> 4 == 6) {
    if (packet.size() < 40 || packet[6] != kUdp) return std::nullopt;
    return udp_in(packet.subspan(40));
  }
  const std::size_t header = 4 * (packet[0] & 15U);
  if (packet[0] >> 4 != 4 || header < 20 || packet.size() < header || packet[9] != kUdp)
    return std::nullopt;
  constexpr std::uint32_t kMoreOrOffset = 0x3fff;  // of a fragment
  if ((big_endian(packet, 6) & kMoreOrOffset) != 0) return std::nullopt;
  return udp_in(packet.subspan(header));
}

// The link layers of www.tcpdump.org/linktypes.html, by their number.
std::optional<Udp> link_in(std::uint32_t link, Bytes frame) {
  const auto behind = [&](std::size_t header) {
    return frame.size() < header ? std::nullopt : ip_in(frame.subspan(header));
  };
  switch (link) {
    case 0:    // BSD loopback
    case 108:  // OpenBSD loopback
      return behind(4);
    case 1: {  // Ethernet; the type of what follows stands behind two addresses and VLAN tags
      constexpr std::uint32_t kVlan = 0x8100, kServiceVlan = 0x88a8;
      std::size_t type = 12;
      while (type + 6 <= frame.size()) {
        const std::uint32_t kind = big_endian(frame, type);
        if (kind != kVlan && kind != kServiceVlan) break;
        type += 4;
      }
      return behind(type + 2);
    }
    case 101:  // raw IP
    case 228:
    case 229:
      return ip_in(frame);
    case 113:  // Linux cooked
      return behind(16);
    case 276:  // Linux cooked, version 2
      return behind(20);
    default:
      return std::nullopt;
  }
}

bool is_known_link(std::uint32_t link) {
  for (const std::uint32_t known : {0U, 1U, 101U, 108U, 113U, 228U, 229U, 276U})
    if (link == known) return true;
  return false;
}

// Bytes one after the other, with where they stand.
class Reader {
 public:
  Reader(const std::filesystem::path& file, core::ProblemList& problems)
      : file_(file.string()), stream_(core::open_file(file, problems)), problems_(problems) {}

  bool is_open() const { return stream_.is_open(); }
  core::Place place(std::int64_t offset) const { return {file_, 0, 0, offset}; }

  // How many there were, up to the size of `into`.
  std::size_t read(std::span<std::uint8_t> into) {
    stream_.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
    const auto count = static_cast<std::size_t>(stream_.gcount());
    offset_ += static_cast<std::int64_t>(count);
    return count;
  }
  // False where the file cannot be read.
  bool begin_again() {
    if (stream_.bad()) return false;
    stream_.clear();
    stream_.seekg(0);
    offset_ = 0;
    return stream_.good();
  }

  // The header of a record, then its `length` bytes; false at the end, whole or cut off, and where
  // the file cannot be read on.
  bool read_header(std::span<std::uint8_t> header) {
    record_ = offset_;
    const std::size_t count = read(header);
    if (count < header.size()) end(count > 0);
    return count == header.size();
  }
  bool read_body(std::vector<std::uint8_t>& body, std::size_t length) {
    body.resize(length);
    if (read(body) == length) return true;
    end(true);
    return false;
  }
  std::int64_t record() const { return record_; }
  void refuse(const std::string& field, const std::string& value, const std::string& expected) {
    problems_.error(core::ErrorClass::parse, place(record_), field, value, expected);
  }
  void refuse_unreadable(std::int64_t offset) {
    problems_.error(core::ErrorClass::io, place(offset), "", "read failed", "a readable file");
  }

 private:
  void end(bool in_record) {
    if (stream_.bad())
      refuse_unreadable(record_);
    else if (in_record)
      problems_.warning("CUT", place(record_), "last record", "cut off", "left out");
  }

  std::string file_;
  std::ifstream stream_;
  core::ProblemList& problems_;
  std::int64_t offset_ = 0, record_ = 0;
};

// What the first four bytes say of a capture.
struct CaptureKind {
  bool swap = false;
  double fraction_s = 1e-6;
};

std::optional<CaptureKind> capture_kind(Bytes magic) {
  constexpr std::uint32_t kMicro = 0xa1b2c3d4, kNano = 0xa1b23c4d;
  for (const bool swap : {false, true}) {
    const auto word = Fields(magic, swap).at<std::uint32_t>(0);
    if (word == kMicro) return CaptureKind{swap, 1e-6};
    if (word == kNano) return CaptureKind{swap, 1e-9};
  }
  return std::nullopt;
}

void read_capture(Reader& reader, const CaptureKind& kind, const EachDatagram& each) {
  const auto word = [&](Bytes bytes, std::size_t offset) {
    return Fields(bytes, kind.swap).at<std::uint32_t>(offset);
  };
  std::array<std::uint8_t, 24> beginning{};
  if (!reader.read_header(beginning)) return;
  const std::uint32_t link = word(beginning, 20) & 0xffff;  // above it stand lengths of checksums
  if (!is_known_link(link)) {
    reader.refuse(
        "link type", std::to_string(link),
        "Ethernet (1), loopback (0, 108), raw IP (101, 228, 229) or Linux cooked (113, 276)");
    return;
  }
  std::array<std::uint8_t, 16> header{};
  std::vector<std::uint8_t> frame;
  while (reader.read_header(header)) {
    const std::uint32_t length = word(header, 8), whole = word(header, 12);
    if (length > kLongest_bytes) {
      reader.refuse("length of a record", std::to_string(length), "at most 262144 bytes");
      return;
    }
    if (!reader.read_body(frame, length)) return;
    if (length < whole) continue;  // cut as it was captured
    const std::optional<Udp> udp = link_in(link, frame);
    if (!udp) continue;
    const double time_s = word(header, 0) + kind.fraction_s * word(header, 4);
    each({time_s, udp->port, udp->payload, reader.record()});
  }
}

void read_raw(Reader& reader, const EachDatagram& each) {
  std::array<std::uint8_t, 12> header{};
  std::vector<std::uint8_t> payload;
  while (reader.read_header(header)) {
    const Fields fields(header, kSwapLittle);
    const auto time_s = fields.at<double>(0);
    if (!std::isfinite(time_s)) {
      reader.refuse("time of a record", "not finite", "seconds");
      return;
    }
    if (!reader.read_body(payload, fields.at<std::uint16_t>(10))) return;
    each({time_s, fields.at<std::uint16_t>(8), payload, reader.record()});
  }
}

// Anything could be records of a time, a port and a length; this looks whether the first one could
// be meant so.
bool could_be_raw(Bytes first) {
  const auto time_s = Fields(first, kSwapLittle).at<double>(0);
  return time_s == 0.0 || (std::abs(time_s) > 1e-12 && std::abs(time_s) < 1e12);
}

}  // namespace

void read_datagrams(const std::filesystem::path& file, const EachDatagram& each,
                    core::ProblemList& problems) {
  Reader reader(file, problems);
  std::array<std::uint8_t, 8> first{};
  const auto refuse = [&](const char* what, const char* expected) {
    problems.error(core::ErrorClass::ref, reader.place(0), "packet file", what, expected);
  };
  if (!reader.is_open()) return;
  const std::size_t count = reader.read(first);
  const auto kind = capture_kind(first);
  if (!reader.begin_again())
    reader.refuse_unreadable(-1);
  else if (count < first.size())
    refuse("fewer than 8 bytes", "a packet capture (pcap), or raw datagrams");
  else if (Fields(first, kSwapLittle).at<std::uint32_t>(0) == 0x0a0d0d0a)
    refuse("a pcapng file", "a capture, as editcap -F pcap makes of it");
  else if (kind)
    read_capture(reader, *kind, each);
  else if (could_be_raw(first))
    read_raw(reader, each);
  else
    refuse("neither form",
           "a packet capture (pcap), or raw datagrams: time, port, length and bytes of each");
}

}  // namespace fanbeam::feeds
