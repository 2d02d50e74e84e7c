// Radar video by category 240: the octets that edition 1.3 asks for, and pieces that make up the whole.
// TShark reads whole sessions (tests/live/cat240_test.py).
#include "feeds/cat240.h"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <numeric>
#include <string>

#include "core/constants.h"

using namespace fanbeam::feeds::cat240;

namespace {

std::uint64_t number(const Bytes& bytes, std::size_t at, std::size_t octets) {
  return std::accumulate(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + octets), std::uint64_t{0},
                         [](std::uint64_t sum, std::uint8_t octet) { return 256 * sum + octet; });
}

// Where things stand in a video message: 3 octets of block, 2 of FSPEC, and then the items.
constexpr std::size_t kCounterAt = 8, kFirstAt = 16, kResolutionAt = 24, kOctetsAt = 26,
                      kCellsAt = 28, kBlocksAt = 31, kVideoAt = 32;

Bytes ramp(std::size_t count) {
  Bytes cells(count);
  for (std::size_t i = 0; i < count; ++i) cells[i] = static_cast<std::uint8_t>(7 * i + i / 256);
  return cells;
}

Bytes cells_in(const Bytes& message) {
  const auto begin = message.begin() + kVideoAt;
  return {begin, begin + static_cast<std::ptrdiff_t>(number(message, kOctetsAt, 2))};
}

}  // namespace

TEST_CASE("A summary is the octets of items 010, 000, 030 and 140", "[cat240]") {
  const Bytes message = summary({7, 9}, 43200.5, "nose\n");
  const Bytes expected{240, 0,   17,  0xd1, 0x08, 7,    9,    1,   5,
                       'n', 'o', 's', 'e',  '?',  0x54, 0x60, 0x40};
  CHECK(message == expected);
  // One octet counts the letters.
  CHECK(summary({}, 0.0, std::string(400, 'x')).size() == 12 + 255);
}

TEST_CASE("Time of day stays within the day, whatever the clock says", "[cat240]") {
  for (const auto& [time_s, units] : {std::pair(86399.9999, 11059199U), std::pair(86400.0, 0U),
                                      std::pair(-0.0078125, 11059199U), std::pair(1.0, 128U)}) {
    CAPTURE(time_s);
    CHECK(number(summary({}, time_s, ""), 9, 3) == units);
  }
}

TEST_CASE("A radial is the octets of items 010, 000, 020, 041, 048, 049, 050 and 140", "[cat240]") {
  const Bytes cells{1, 2, 3, 4, 5};
  Radial radial;
  radial.start_azimuth_rad =
      -fanbeam::core::kPi / 8;                        // left of the reference: the turn's last part
  radial.end_azimuth_rad = 2.5 * fanbeam::core::kPi;  // a quarter, one turn on
  radial.first_cell = 51;
  radial.cell_duration_fs = 33356410;
  radial.cells = cells;
  radial.time_of_day_s = 2.0;
  std::uint32_t counter = 0xffffffff;
  const auto messages = video({7, 9}, radial, {}, counter);
  REQUIRE(messages.size() == 1);
  CHECK(counter == 0);  // begins again after the largest
  const Bytes expected{240,  0,    43,   0xe7, 0xc8, 7, 9, 2, 0xff, 0xff, 0xff,
                       0xff, 0xf0, 0x00, 0x40, 0x00, 0, 0, 0, 51,   0x01, 0xfc,
                       0xfa, 0x7a, 0x00, 4,    0,    5, 0, 0, 5,    2,    1,
                       2,    3,    4,    5,    0,    0, 0, 0, 1,    0};
  CHECK(messages.front() == expected);
}

TEST_CASE(
    "Pieces of a long radial stay within a datagram, follow one another and make up the whole",
    "[cat240]") {
  for (const std::size_t most : {std::size_t{548}, std::size_t{1055}, std::size_t{1056},
                                 std::size_t{1472}, std::size_t{8972}, std::size_t{0}}) {
    for (const std::size_t count : {0U, 1U, 1020U, 1021U, 1438U, 5000U, 20000U}) {
      for (const CellBits bits : {CellBits::eight, CellBits::sixteen}) {
        const std::size_t octets = bits == CellBits::eight ? 1 : 2;
        CAPTURE(most, count, octets);
        const Bytes cells = ramp(count * octets);
        Radial radial;
        radial.first_cell = 100;
        radial.bits = bits;
        radial.cells = cells;
        std::uint32_t counter = 5;
        const auto messages = video({}, radial, {most, false}, counter);
        CHECK(counter == 5 + messages.size());
        Bytes whole;
        for (std::size_t i = 0; i < messages.size(); ++i) {
          const Bytes& message = messages[i];
          REQUIRE(message.size() <= std::max(most, kFewestBytes));
          CHECK(number(message, 1, 2) == message.size());
          CHECK(number(message, kCounterAt, 4) == 5 + i);
          CHECK(number(message, kFirstAt, 4) == 100 + whole.size() / octets);
          CHECK(number(message, kResolutionAt, 2) == (bits == CellBits::eight ? 4U : 5U));
          CHECK(number(message, kCellsAt, 3) * octets == number(message, kOctetsAt, 2));
          const bool low = (message[4] & 0x40) != 0;
          CHECK(low != ((message[4] & 0x20) != 0));
          // Blocks, then the time of day.
          CHECK(message.size() == kVideoAt + message[kBlocksAt] * (low ? 4U : 64U) + 3);
          const Bytes piece = cells_in(message);
          whole.insert(whole.end(), piece.begin(), piece.end());
        }
        CHECK(whole == cells);
      }
    }
  }
}

TEST_CASE("Compressed pieces are marked, stay within a datagram and inflate to the cells",
          "[cat240]") {
  // What does not compress must not run over either: a generator's octets.
  for (const bool noise : {false, true}) {
    Bytes cells = ramp(6000);
    std::uint32_t state = 1;
    if (noise)
      for (std::uint8_t& cell : cells)
        cell = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24U);
    Radial radial;
    radial.cells = cells;
    std::uint32_t counter = 0;
    Bytes whole;
    for (const Bytes& message : video({}, radial, {1472, true}, counter)) {
      REQUIRE(message.size() <= 1472);
      CHECK(message[kResolutionAt] == 0x80);
      const Bytes packed = cells_in(message);
      Bytes piece(number(message, kCellsAt, 3));
      uLongf size = piece.size();
      REQUIRE(::uncompress(piece.data(), &size, packed.data(), packed.size()) == Z_OK);
      REQUIRE(size == piece.size());
      whole.insert(whole.end(), piece.begin(), piece.end());
    }
    CHECK(whole == cells);
  }
}
