#include "feeds/cat240.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace fanbeam::feeds::cat240 {
namespace {

constexpr std::uint8_t kCategory = 240, kSummary = 1, kVideo = 2;

// Octets of a block, and which bit of the second octet of FSPEC says that video comes in such.
struct Volume {
  std::size_t block_bytes;
  std::uint8_t bit;
};
constexpr std::size_t kMostBlocks = 255;
constexpr Volume kLow{4, 0x40}, kMedium{64, 0x20};

// Octets of a video message besides its blocks.
constexpr std::size_t kAround_bytes = 3 + 2 + 2 + 1 + 4 + 12 + 2 + 5 + 1 + 3;

// A record in the making, in a block of its own.
class Record {
 public:
  Record() { put(kCategory).put(0, 2); }

  // The lowest octets of a number.
  Record& put(std::uint64_t value, unsigned octets = 1) {
    for (unsigned i = octets; i > 0; --i)
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * (i - 1)) & 0xffU));
    return *this;
  }
  Record& put(std::span<const std::uint8_t> octets) {
    bytes_.insert(bytes_.end(), octets.begin(), octets.end());
    return *this;
  }
  Record& pad(std::size_t octets) {
    bytes_.insert(bytes_.end(), octets, 0);
    return *this;
  }
  // The block tells its own length.
  Bytes done() {
    bytes_[1] = static_cast<std::uint8_t>(bytes_.size() >> 8);
    bytes_[2] = static_cast<std::uint8_t>(bytes_.size() & 0xffU);
    return std::move(bytes_);
  }

 private:
  Bytes bytes_;
};

std::uint64_t time_of_day(double time_s) {
  constexpr double kDay_s = 86400.0, kUnits_per_s = 128.0;
  const double today_s = time_s - kDay_s * std::floor(time_s / kDay_s);
  return std::min(static_cast<std::uint64_t>(today_s * kUnits_per_s),
                  static_cast<std::uint64_t>(kDay_s * kUnits_per_s) - 1);
}

std::uint16_t azimuth(double angle_rad) {
  const double turns = angle_rad / (2.0 * std::numbers::pi);
  return static_cast<std::uint16_t>(std::lround((turns - std::floor(turns)) * 65536.0) & 0xffff);
}

Bytes deflated(std::span<const std::uint8_t> cells) {
  uLongf size = compressBound(static_cast<uLong>(cells.size()));
  Bytes out(size);
  ::compress2(out.data(), &size, cells.data(), static_cast<uLong>(cells.size()), Z_BEST_SPEED);
  out.resize(size);
  return out;
}

// The most octets of cells that stay within a datagram, whatever they hold.
std::size_t most_cells_bytes(const Packing& packing, std::size_t cell_bytes) {
  const std::size_t room = std::max(packing.most_bytes, kFewestBytes) - kAround_bytes;
  const Volume& volume = room < kMostBlocks * kLow.block_bytes ? kLow : kMedium;
  const std::size_t most = std::min(room / volume.block_bytes, kMostBlocks) * volume.block_bytes;
  std::size_t cells = most;
  while (packing.zlib && compressBound(static_cast<uLong>(cells)) > most) --cells;
  return cells - cells % cell_bytes;
}

}  // namespace

Bytes summary(const Source& source, double time_of_day_s, std::string_view text) {
  constexpr std::size_t kMostText = 255;
  text = text.substr(0, kMostText);
  Record record;
  // Items 010, 000 and 030, then 140.
  record.put(0xd1).put(0x08).put(source.area).put(source.code).put(kSummary).put(text.size());
  for (const char one : text)
    record.put(one >= ' ' && one <= '~' ? static_cast<unsigned char>(one) : '?');
  return record.put(time_of_day(time_of_day_s), 3).done();
}

std::vector<Bytes> video(const Source& source, const Radial& radial, const Packing& packing,
                         std::uint32_t& counter) {
  const std::size_t cell_bytes = radial.bits == CellBits::sixteen ? 2 : 1;
  const std::size_t most = most_cells_bytes(packing, cell_bytes);
  std::vector<Bytes> messages;
  for (std::size_t begin = 0; begin < radial.cells.size(); begin += most) {
    const auto cells = radial.cells.subspan(begin, std::min(most, radial.cells.size() - begin));
    const Bytes packed = packing.zlib ? deflated(cells) : Bytes();
    const std::span<const std::uint8_t> octets = packing.zlib ? std::span(packed) : cells;
    const Volume& volume = octets.size() <= kMostBlocks * kLow.block_bytes ? kLow : kMedium;
    const std::size_t blocks = (octets.size() + volume.block_bytes - 1) / volume.block_bytes;
    Record record;
    // Items 010, 000, 020 and 041, 048; then 049, one of 050 and 051, 140.
    record.put(0xe7).put(0x80U | volume.bit | 0x08U).put(source.area).put(source.code).put(kVideo);
    record.put(counter++, 4).put(azimuth(radial.start_azimuth_rad), 2);
    record.put(azimuth(radial.end_azimuth_rad), 2);
    record.put(radial.first_cell + begin / cell_bytes, 4).put(radial.cell_duration_fs, 4);
    record.put(packing.zlib ? 0x80 : 0x00).put(static_cast<std::uint8_t>(radial.bits));
    record.put(octets.size(), 2).put(cells.size() / cell_bytes, 3).put(blocks).put(octets);
    record.pad(blocks * volume.block_bytes - octets.size());
    messages.push_back(record.put(time_of_day(radial.time_of_day_s), 3).done());
  }
  return messages;
}

}  // namespace fanbeam::feeds::cat240
