// Pictures and layers on disk: what is written is what is read, and hostile files cost nothing (F08, F17).
#include "core/image.h"

#include <sys/resource.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "core/errors.h"
#include "core/files.h"

using namespace fanbeam::core;
namespace fs = std::filesystem;

namespace {

class Scratch {
 public:
  Scratch() : folder_(fs::path(FANBEAM_BINARY_DIR) / "image_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const std::string& name) const { return folder_ / name; }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

std::string code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.problems().at(0).code;
  }
  return "accepted";
}

std::string bytes_of(const fs::path& path) { return read_file(path, 100U << 20U); }

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

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
    for (int bit = 0; bit < 8; ++bit) value = (value & 1U) != 0 ? value >> 1U ^ 0xEDB88320U : value >> 1U;
  }
  return ~value;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
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
                             static_cast<char>(colour_type) + std::string(2, '\0') + static_cast<char>(interlace));
  if (!palette.empty()) bytes += chunk("PLTE", palette);
  return bytes + chunk("IDAT", stored(scanlines)) + chunk("IEND", "");
}

Picture8 gradient(int columns, int rows) {
  Picture8 picture{columns, rows, {}};
  for (int i = 0; i < columns * rows; ++i) picture.pixels.push_back(static_cast<std::uint8_t>(i * 7 % 256));
  return picture;
}

Image two_layers() {
  return {3, 2, {{"power_W", {0.0, 1e-30, 1e-12, 1.0, 3.5, 1e20}}, {"range_m", {1, 2, 3, 4, 5, 6}}}};
}

std::string metadata_value(const Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  return "absent";
}

const Metadata kNotes = {{"Software", "fanbeam 1"}, {"fanbeam:scene", "Zürich"}, {"fanbeam:events", "one two"}};

}  // namespace

TEST_CASE("PNG: every pixel and note comes back", "[image]") {
  const Scratch scratch;
  const Picture8 picture = gradient(164, 524);
  write_png(scratch / "new folder/a.png", picture, kNotes);
  const Image image = read_image(scratch / "new folder/a.png");
  CHECK(image.columns == 164);
  CHECK(image.rows == 524);
  REQUIRE(image.layers.size() == 1);
  CHECK(image.layers[0].values == std::vector<double>(picture.pixels.begin(), picture.pixels.end()));
  const Metadata metadata = read_metadata(scratch / "new folder/a.png");
  for (const auto& [name, value] : kNotes) CHECK(metadata_value(metadata, name) == value);
}

TEST_CASE("EXR: layers keep name, order and 32-bit values, zero and tiny power included", "[image]") {
  const Scratch scratch;
  write_exr(scratch / "a.exr", two_layers(), kNotes);
  const Image image = read_image(scratch / "a.exr");
  CHECK(image.columns == 3);
  CHECK(image.rows == 2);
  REQUIRE(image.layers.size() == 2);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    CHECK(image.layers[layer].name == two_layers().layers[layer].name);
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(image.layers[layer].values[i] == static_cast<double>(static_cast<float>(two_layers().layers[layer].values[i])));
  }
  const Metadata metadata = read_metadata(scratch / "a.exr");
  for (const auto& [name, value] : kNotes) CHECK(metadata_value(metadata, name) == value);
}

TEST_CASE("Files hold no time: the same image gives the same bytes a second later", "[image]") {
  const Scratch scratch;
  write_png(scratch / "a.png", gradient(20, 10), kNotes);
  write_exr(scratch / "a.exr", two_layers(), kNotes);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_png(scratch / "b.png", gradient(20, 10), kNotes);
  write_exr(scratch / "b.exr", two_layers(), kNotes);
  CHECK((bytes_of(scratch / "a.png") == bytes_of(scratch / "b.png")));
  CHECK((bytes_of(scratch / "a.exr") == bytes_of(scratch / "b.exr")));
}

TEST_CASE("F08 image bombs are E-LIMIT or E-PARSE before anything is allocated", "[image]") {
  const Scratch scratch;
  struct Bomb {
    std::uint32_t columns, rows;
    const char* code;
  };
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  for (const Bomb& bomb : {Bomb{65535, 65535, "E-LIMIT"}, Bomb{0, 0, "E-PARSE"}, Bomb{0, 5, "E-PARSE"},
                           Bomb{1, 2147483647, "E-LIMIT"}, Bomb{2147483647, 2147483647, "E-LIMIT"},
                           Bomb{4294967295U, 1, "E-LIMIT"}}) {
    INFO(bomb.columns << " x " << bomb.rows);
    write_file_atomically(scratch / "bomb.png", png(bomb.columns, bomb.rows, 8, 0, 0, std::string(2000, '\0')));
    CHECK(code_of([&] { read_image(scratch / "bomb.png"); }) == bomb.code);
    CHECK(code_of([&] { read_metadata(scratch / "bomb.png"); }) == bomb.code);
  }
  write_exr(scratch / "a.exr", two_layers(), {});
  std::string exr = bytes_of(scratch / "a.exr");
  const std::size_t window = exr.find("dataWindow");
  REQUIRE(window != std::string::npos);
  // Name and type "box2i", each with a zero byte, and the size of the value; then xMin, yMin, xMax, yMax.
  const std::size_t x_max = window + 11 + 6 + 4 + 8;
  exr.replace(x_max, 8, std::string("\xff\xff\0\0\xff\xff\0\0", 8));
  write_file_atomically(scratch / "bomb.exr", exr);
  const std::string exr_code = code_of([&] { read_image(scratch / "bomb.exr"); });
  CHECK((exr_code == "E-LIMIT" || exr_code == "E-PARSE"));
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  CHECK((after.ru_maxrss - before.ru_maxrss) / 1024 < 64);  // MiB
}

TEST_CASE("F08 16-bit, palette and interlaced pictures are read right", "[image]") {
  const Scratch scratch;
  write_file_atomically(scratch / "16.png", png(2, 1, 16, 0, 0, std::string("\0\x12\x34\xff\xff", 5)));
  CHECK(read_image(scratch / "16.png").layers[0].values == std::vector<double>{0x1234, 65535});

  write_file_atomically(scratch / "palette.png",
                        png(2, 1, 8, 3, 0, std::string("\0\1\0", 3), std::string("\x0a\x14\x1e\xff\x80\x40", 6)));
  const Image colours = read_image(scratch / "palette.png");
  REQUIRE(colours.layers.size() >= 3);
  CHECK(colours.layers[0].values == std::vector<double>{255, 10});
  CHECK(colours.layers[1].values == std::vector<double>{128, 20});
  CHECK(colours.layers[2].values == std::vector<double>{64, 30});

  // Adam7 of 2 x 2: pass 1 holds (0, 0), pass 6 (1, 0), pass 7 the lower row.
  write_file_atomically(scratch / "interlaced.png", png(2, 2, 8, 0, 1, std::string("\0\1\0\2\0\3\4", 7)));
  CHECK(read_image(scratch / "interlaced.png").layers[0].values == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("F08 a file cut short anywhere is E-PARSE, never half a picture", "[image]") {
  const Scratch scratch;
  write_png(scratch / "a.png", gradient(30, 20), kNotes);
  write_exr(scratch / "a.exr", two_layers(), kNotes);
  for (const char* name : {"a.png", "a.exr"}) {
    const std::string bytes = bytes_of(scratch / name);
    const std::size_t step = std::max<std::size_t>(1, bytes.size() / 40);
    for (std::size_t size = 0; size < bytes.size(); size += step) {
      INFO(name << " cut to " << size << " of " << bytes.size());
      write_file_atomically(scratch / ("cut" + fs::path(name).extension().string()), bytes.substr(0, size));
      CHECK(code_of([&] { read_image(scratch / ("cut" + fs::path(name).extension().string())); }) == "E-PARSE");
    }
  }
}

TEST_CASE("F08 a PNG with one byte changed is E-PARSE and tells the byte where it shows", "[image]") {
  const Scratch scratch;
  write_png(scratch / "a.png", gradient(30, 20), kNotes);
  const std::string bytes = bytes_of(scratch / "a.png");
  for (std::size_t at = 8; at < bytes.size(); at += 7) {
    INFO("byte " << at);
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    write_file_atomically(scratch / "b.png", changed);
    try {
      read_image(scratch / "b.png");
      FAIL("accepted");
    } catch (const InputError& error) {
      CHECK(error.problems()[0].code == "E-PARSE");
      CHECK(error.problems()[0].place.byte_offset >= 8);
    }
  }
}

TEST_CASE("A missing file, a folder and a text are refused by class", "[image]") {
  const Scratch scratch;
  write_file_atomically(scratch / "text.png", "no picture");
  CHECK(code_of([&] { read_image(scratch / "missing.png"); }) == "E-IO");
  CHECK(code_of([&] { read_image(scratch.folder()); }) == "E-IO");
  CHECK(code_of([&] { read_image(scratch / "text.png"); }) == "E-PARSE");
  CHECK(code_of([&] { read_metadata(scratch / "text.png"); }) == "E-PARSE");
}

TEST_CASE("F17 where nothing can be written, E-IO is told and nothing is left behind", "[image]") {
  const Scratch scratch;
  write_file_atomically(scratch / "file", "a file where a folder should be");
  fs::create_directories(scratch / "taken.png");
  CHECK(code_of([&] { write_png(scratch / "file/a.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(code_of([&] { write_exr(scratch / "file/a.exr", two_layers(), {}); }) == "E-IO");
  CHECK(code_of([&] { write_png(scratch / "taken.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(code_of([&] { write_png("/proc/a.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(entries(scratch.folder()) == 2);
}

TEST_CASE("F17 a disk that fills up leaves the old picture whole", "[image]") {
  const Scratch scratch;
  Picture8 noise = gradient(400, 400);
  std::uint32_t state = 1;
  for (std::uint8_t& pixel : noise.pixels) pixel = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24U);
  Image layers{200, 200, {{"power_W", {}}}};
  for (const std::uint8_t pixel : noise.pixels) {
    if (layers.layers[0].values.size() < 40000) layers.layers[0].values.push_back(pixel * 1.37e-9 + 1e-13);
  }
  write_png(scratch / "a.png", gradient(5, 5), {});
  write_exr(scratch / "a.exr", two_layers(), {});
  const std::string old_png = bytes_of(scratch / "a.png");
  const std::string old_exr = bytes_of(scratch / "a.exr");

  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20000, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string png_code = code_of([&] { write_png(scratch / "a.png", noise, {}); });
  const std::string exr_code = code_of([&] { write_exr(scratch / "a.exr", layers, {}); });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  CHECK(png_code == "E-IO");
  CHECK(exr_code == "E-IO");
  CHECK((bytes_of(scratch / "a.png") == old_png));
  CHECK((bytes_of(scratch / "a.exr") == old_exr));
  CHECK(entries(scratch.folder()) == 2);
}

TEST_CASE("Sizes that do not match the values are our own mistake", "[image]") {
  const Scratch scratch;
  CHECK_THROWS_AS(write_png(scratch / "a.png", Picture8{4, 4, std::vector<std::uint8_t>(15)}, {}), InternalError);
  CHECK_THROWS_AS(write_png(scratch / "a.png", Picture8{0, 4, {}}, {}), InternalError);
  CHECK_THROWS_AS(write_exr(scratch / "a.exr", Image{2, 2, {{"x", {1, 2, 3}}}}, {}), InternalError);
  CHECK(fs::is_empty(scratch.folder()));
}
