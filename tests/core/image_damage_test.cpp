// Image bombs and damaged pictures (F08).
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>

#include "core/image_compare.h"
#include "core/picture_bytes.h"
#include "tests/core/file_checks.h"
#include "tests/core/image_files.h"
#include "tests/peak_memory.h"

using namespace fanbeam::core;
using fanbeam::tests::bytes_of;
using fanbeam::tests::code_of;
using fanbeam::tests::gradient;
using fanbeam::tests::kNotes;
using fanbeam::tests::TemporaryFolder;
using fanbeam::tests::two_layers;

namespace fs = std::filesystem;

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFFU);
  return bytes;
}

// CRC-32 of ISO/IEC 15948:2004, annex D.
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t value = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    value ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? value >> 1U ^ 0xEDB88320U : value >> 1U;
  }
  return ~value;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(crc(type + data));
}

// RFC 1950 around one stored block of RFC 1951.
std::string stored(const std::string& data) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : data) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(data.size());
  std::string bytes = "\x78\x01\x01";
  for (const unsigned half : {unsigned{size}, ~unsigned{size} & 0xFFFFU})
    bytes += {static_cast<char>(half & 0xFFU), static_cast<char>(half >> 8U)};
  return bytes + data + big_endian(b << 16U | a);
}

// A PNG of our own making; `scanlines` with their filter bytes.
std::string png(std::uint32_t columns, std::uint32_t rows, int bits, int colour_type, int interlace,
                const std::string& scanlines, const std::string& palette = "") {
  std::string bytes = "\x89PNG\r\n\x1a\n";
  bytes += chunk("IHDR", big_endian(columns) + big_endian(rows) + static_cast<char>(bits) +
                             static_cast<char>(colour_type) + std::string(2, '\0') +
                             static_cast<char>(interlace));
  if (!palette.empty()) bytes += chunk("PLTE", palette);
  return bytes + chunk("IDAT", stored(scanlines)) + chunk("IEND", "");
}

}  // namespace

TEST_CASE("F08 image bombs are E-LIMIT or E-PARSE before anything is allocated", "[image_damage]") {
  const TemporaryFolder scratch;
  struct Bomb {
    std::uint32_t columns, rows;
    const char* code;
  };
  png_bytes({1, 1, {0}});  // loads the library of pictures
  const fanbeam::tests::PeakMemory memory;
  for (const Bomb& bomb :
       {Bomb{65535, 65535, "E-LIMIT"}, Bomb{0, 0, "E-PARSE"}, Bomb{0, 5, "E-PARSE"},
        Bomb{1, 2147483647, "E-LIMIT"}, Bomb{2147483647, 2147483647, "E-LIMIT"},
        Bomb{4294967295U, 1, "E-LIMIT"}, Bomb{2000000, 1, "E-LIMIT"},
        Bomb{5000, 5000, "E-PARSE"}}) {  // 25 million values, allowed, of which 2000 are there
    INFO(bomb.columns << " x " << bomb.rows);
    write_file_atomically(scratch.path() / "bomb.png",
                          png(bomb.columns, bomb.rows, 8, 0, 0, std::string(2000, '\0')));
    CHECK(code_of([&] { read_image(scratch.path() / "bomb.png"); }) == bomb.code);
    CHECK(code_of([&] { read_metadata(scratch.path() / "bomb.png"); }) == bomb.code);
  }
  write_exr(scratch.path() / "a.exr", two_layers(), {});
  std::string exr = bytes_of(scratch.path() / "a.exr");
  const std::size_t window = exr.find("dataWindow");
  REQUIRE(window != std::string::npos);
  // Name and type "box2i", each with a zero byte, and the size of the value; then xMin, yMin, xMax,
  // yMax.
  const std::size_t x_max = window + 11 + 6 + 4 + 8;
  exr.replace(x_max, 8, std::string("\xff\xff\0\0\xff\xff\0\0", 8));
  write_file_atomically(scratch.path() / "bomb.exr", exr);
  CHECK(code_of([&] { read_image(scratch.path() / "bomb.exr"); }) == "E-LIMIT");
  CHECK(memory.rise_MiB() < 64.0);
}

// The library took 2 GB for an attribute of 224 bytes that said so.
TEST_CASE("F08 lengths in the head of an OpenEXR file are checked before memory is taken for them",
          "[image_damage]") {
  const TemporaryFolder scratch;
  write_exr(scratch.path() / "a.exr", two_layers(), kNotes);
  const std::string whole = bytes_of(scratch.path() / "a.exr");
  const std::string most("\xf0\xff\xff\x7f", 4), eight("\x08\0\0\0", 4), twelve("\x0c\0\0\0", 4);
  const auto with = [&](const std::string& attribute) {
    std::string bytes = whole;
    write_file_atomically(scratch.path() / "b.exr", bytes.insert(8, attribute));
    return code_of([&] { read_metadata(scratch.path() / "b.exr"); });
  };
  const fanbeam::tests::PeakMemory memory;
  CHECK(with(std::string("a\0string\0", 9) + most) == "E-PARSE");
  CHECK(with(std::string("a\0stringvector\0", 15) + eight + most + "abcd") == "E-PARSE");
  CHECK(with(std::string("a\0preview\0", 10) + twelve + most + most + "abcd") == "E-PARSE");
  // In a file so long that either side alone could be: their product is no smaller for running over.
  const std::string side("\0\0\0\x70", 4);
  std::string bytes = whole;
  bytes.insert(8, std::string("a\0preview\0", 10) + side + side + side);
  write_file_atomically(scratch.path() / "c.exr", bytes);
  std::filesystem::resize_file(scratch.path() / "c.exr", 0x7f000000);
  CHECK(code_of([&] { read_metadata(scratch.path() / "c.exr"); }) == "E-PARSE");
  CHECK(memory.rise_MiB() < 64.0);
  CHECK(with(std::string("a\0string\0", 9) + eight + "abcdefgh") == "accepted");
  CHECK(with(std::string("a\0stringvector\0", 15) + eight + std::string("\x04\0\0\0", 4) +
             "abcd") == "accepted");
}

TEST_CASE("F08 a PNG that the library would complain of is refused before it prints a line",
          "[image_damage]") {
  const TemporaryFolder scratch;
  const std::string rows(2 * 5, '\0');  // of four bytes and the filter's
  std::string no_deflate = png(4, 2, 8, 0, 0, rows);
  const std::size_t data = no_deflate.find("IDAT") - 4;
  no_deflate.replace(data, std::string::npos, chunk("IDAT", "no deflate") + chunk("IEND", ""));
  std::string torn = png(4, 2, 8, 0, 0, rows);
  torn.insert(torn.find("IEND") - 4, chunk("tEXt", "a") + chunk("IDAT", stored(rows)));
  std::string unknown = png(4, 2, 8, 0, 0, rows);
  unknown.insert(data, chunk("ABCD", "a"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"too few rows", png(4, 3, 8, 0, 0, rows)},
      {"too many rows", png(4, 1, 8, 0, 0, rows)},
      {"a filter that there is not", png(4, 2, 8, 0, 0, "\5" + rows.substr(1))},
      {"no palette", png(4, 2, 8, 3, 0, rows)},
      {"a palette of 16 bits", png(2, 2, 16, 3, 0, rows, "abc")},
      {"a way of interlacing that there is not", png(4, 2, 8, 0, 2, rows)},
      {"no deflated data", no_deflate},
      {"data in two pieces", torn},
      {"a critical chunk that nobody knows", unknown}};
  std::fflush(stderr);
  const fs::path told = scratch.path() / "stderr.txt";
  const int before = dup(2);
  const int file = open(told.c_str(), O_CREAT | O_WRONLY, 0600);
  REQUIRE(dup2(file, 2) == 2);
  std::vector<std::string> codes;
  for (const auto& [what, bytes] : cases) {
    write_file_atomically(scratch.path() / "bad.png", bytes);
    codes.push_back(code_of([&] { read_image(scratch.path() / "bad.png"); }));
  }
  std::fflush(stderr);
  dup2(before, 2);
  close(before);
  close(file);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    INFO(cases[i].first);
    CHECK(codes[i] == "E-PARSE");
  }
  CHECK(bytes_of(told).empty());
  write_file_atomically(scratch.path() / "good.png", png(4, 2, 8, 0, 0, rows));
  CHECK(read_image(scratch.path() / "good.png").layers[0].values == std::vector<double>(8, 0.0));
}

// All plugins of OpenImageIO were tried: one took the zeros for a picture in the making, for minutes.
TEST_CASE("F08 neither PNG nor EXR is refused at once whatever it is called", "[image_damage]") {
  const TemporaryFolder scratch;
  const fs::path zeros = scratch.path() / "zeros.png";
  write_file_atomically(zeros, "");
  fs::resize_file(zeros, std::uintmax_t{4} << 30U);  // takes no disk
  for (const char* name : {"grey.png", "grey.exr", "grey.pgm"}) {
    write_file_atomically(scratch.path() / name, std::string("P5\n2 2\n255\nabcd"));
    CHECK(code_of([&] { read_image(scratch.path() / name); }) == "E-PARSE");
  }
  CHECK(code_of([&] { image_size(zeros); }) == "E-PARSE");
  CHECK_THROWS_WITH(read_metadata(zeros), Catch::Contains("expected a PNG or OpenEXR image"));

  write_exr(scratch.path() / "a.exr", two_layers(), {});
  fs::rename(scratch.path() / "a.exr", scratch.path() / "a.png");
  CHECK(read_image(scratch.path() / "a.png").layers.size() == 2);
  fs::create_symlink("loop.png", scratch.path() / "loop.png");
  CHECK(code_of([&] { read_image(scratch.path() / "loop.png"); }) == "E-IO");
}

TEST_CASE("The size of an image is told before its pixels are held", "[image_damage]") {
  const TemporaryFolder scratch;
  {
    const Picture8 large{5000, 6000, std::vector<std::uint8_t>(30'000'000, 7)};
    write_png(scratch.path() / "large.png", large, {});
  }
  write_exr(scratch.path() / "a.exr", two_layers(), {});
  const fanbeam::tests::PeakMemory memory;
  CHECK(image_size(scratch.path() / "large.png") == ImageSize{5000, 6000, 1});
  CHECK(memory.rise_MiB() < 64.0);  // as floats the pixels take 114 MiB
  CHECK(image_size(scratch.path() / "a.exr") == ImageSize{3, 2, 2});
  CHECK_THROWS_WITH(check_same_size({3, 2, 2}, {3, 2, 1}, "a", "b"),
                    Catch::Contains("E-REF size = 3 x 2, 1 layers: expected 3 x 2, 2 layers"));
}

TEST_CASE("F08 16-bit, palette and interlaced pictures are read right", "[image_damage]") {
  const TemporaryFolder scratch;
  write_file_atomically(scratch.path() / "16.png",
                        png(2, 1, 16, 0, 0, std::string("\0\x12\x34\xff\xff", 5)));
  CHECK(read_image(scratch.path() / "16.png").layers[0].values ==
        std::vector<double>{0x1234, 65535});

  write_file_atomically(
      scratch.path() / "palette.png",
      png(2, 1, 8, 3, 0, std::string("\0\1\0", 3), std::string("\x0a\x14\x1e\xff\x80\x40", 6)));
  const Image colours = read_image(scratch.path() / "palette.png");
  REQUIRE(colours.layers.size() >= 3);
  CHECK(colours.layers[0].values == std::vector<double>{255, 10});
  CHECK(colours.layers[1].values == std::vector<double>{128, 20});
  CHECK(colours.layers[2].values == std::vector<double>{64, 30});

  // Adam7 of 2 x 2: pass 1 holds (0, 0), pass 6 (1, 0), pass 7 the lower row.
  write_file_atomically(scratch.path() / "interlaced.png",
                        png(2, 2, 8, 0, 1, std::string("\0\1\0\2\0\3\4", 7)));
  CHECK(read_image(scratch.path() / "interlaced.png").layers[0].values ==
        std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("F08 a file cut short anywhere is E-PARSE, never half a picture", "[image_damage]") {
  const TemporaryFolder scratch;
  write_png(scratch.path() / "a.png", gradient(30, 20), kNotes);
  write_exr(scratch.path() / "a.exr", two_layers(), kNotes);
  for (const char* name : {"a.png", "a.exr"}) {
    const std::string bytes = bytes_of(scratch.path() / name);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      INFO(name << " cut to " << size << " of " << bytes.size());
      write_file_atomically(scratch.path() / ("cut" + fs::path(name).extension().string()),
                            bytes.substr(0, size));
      CHECK(code_of([&] {
              read_image(scratch.path() / ("cut" + fs::path(name).extension().string()));
            }) == "E-PARSE");
    }
  }
}

TEST_CASE("F08 a PNG with one byte changed is E-PARSE and tells the byte where it shows",
          "[image_damage]") {
  const TemporaryFolder scratch;
  write_png(scratch.path() / "a.png", gradient(30, 20), kNotes);
  const std::string bytes = bytes_of(scratch.path() / "a.png");
  for (std::size_t at = 8; at < bytes.size(); at += 7) {
    INFO("byte " << at);
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    write_file_atomically(scratch.path() / "b.png", changed);
    try {
      read_image(scratch.path() / "b.png");
      FAIL("accepted");
    } catch (const InputError& error) {
      CHECK(error.problems()[0].code == "E-PARSE");
      CHECK(error.problems()[0].place.byte_offset >= 8);
    }
  }
}
