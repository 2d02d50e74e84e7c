// Pictures and layers on disk: what is written is what is read, and nothing half written (F17).
#include "core/image.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/core/file_checks.h"
#include "tests/core/image_files.h"

using namespace fanbeam::core;
using fanbeam::tests::bytes_of;
using fanbeam::tests::code_of;
using fanbeam::tests::entries;
using fanbeam::tests::gradient;
using fanbeam::tests::kNotes;
using fanbeam::tests::TemporaryFolder;
using fanbeam::tests::two_layers;

namespace fs = std::filesystem;

namespace {

std::string metadata_value(const Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  return "absent";
}

}  // namespace

TEST_CASE("PNG: every pixel and note comes back", "[image]") {
  const TemporaryFolder scratch;
  const Picture8 picture = gradient(164, 524);
  write_png(scratch.path() / "new folder/a.png", picture, kNotes);
  const Image image = read_image(scratch.path() / "new folder/a.png");
  CHECK(image.columns == 164);
  CHECK(image.rows == 524);
  REQUIRE(image.layers.size() == 1);
  CHECK(image.layers[0].values ==
        std::vector<double>(picture.pixels.begin(), picture.pixels.end()));
  const Metadata metadata = read_metadata(scratch.path() / "new folder/a.png");
  for (const auto& [name, value] : kNotes) CHECK(metadata_value(metadata, name) == value);
}

TEST_CASE("EXR: layers keep name, order and 32-bit values, zero and tiny power included",
          "[image]") {
  const TemporaryFolder scratch;
  write_exr(scratch.path() / "a.exr", two_layers(), kNotes);
  const Image image = read_image(scratch.path() / "a.exr");
  CHECK(image.columns == 3);
  CHECK(image.rows == 2);
  REQUIRE(image.layers.size() == 2);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    CHECK(image.layers[layer].name == two_layers().layers[layer].name);
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(image.layers[layer].values[i] ==
            static_cast<double>(static_cast<float>(two_layers().layers[layer].values[i])));
  }
  const Metadata metadata = read_metadata(scratch.path() / "a.exr");
  for (const auto& [name, value] : kNotes) CHECK(metadata_value(metadata, name) == value);
}

TEST_CASE("Files hold no time: the same image gives the same bytes a second later", "[image]") {
  const TemporaryFolder scratch;
  write_png(scratch.path() / "a.png", gradient(20, 10), kNotes);
  write_exr(scratch.path() / "a.exr", two_layers(), kNotes);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_png(scratch.path() / "b.png", gradient(20, 10), kNotes);
  write_exr(scratch.path() / "b.exr", two_layers(), kNotes);
  CHECK((bytes_of(scratch.path() / "a.png") == bytes_of(scratch.path() / "b.png")));
  CHECK((bytes_of(scratch.path() / "a.exr") == bytes_of(scratch.path() / "b.exr")));
}

TEST_CASE("A missing file, a folder and a text are refused by class", "[image]") {
  const TemporaryFolder scratch;
  write_file_atomically(scratch.path() / "text.png", "no picture");
  CHECK(code_of([&] { read_image(scratch.path() / "missing.png"); }) == "E-IO");
  CHECK(code_of([&] { read_image(scratch.path()); }) == "E-IO");
  CHECK(code_of([&] { read_image(scratch.path() / "text.png"); }) == "E-PARSE");
  CHECK(code_of([&] { read_metadata(scratch.path() / "text.png"); }) == "E-PARSE");
}

TEST_CASE("F17 where nothing can be written, E-IO is told and nothing is left behind", "[image]") {
  const TemporaryFolder scratch;
  write_file_atomically(scratch.path() / "file", "a file where a folder should be");
  fs::create_directories(scratch.path() / "taken.png");
  CHECK(code_of([&] { write_png(scratch.path() / "file/a.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(code_of([&] { write_exr(scratch.path() / "file/a.exr", two_layers(), {}); }) == "E-IO");
  CHECK(code_of([&] { write_png(scratch.path() / "taken.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(code_of([&] { write_png("/proc/a.png", gradient(3, 3), {}); }) == "E-IO");
  CHECK(entries(scratch.path()) == 2);
}

TEST_CASE("F17 a disk that fills up leaves the old picture whole", "[image]") {
  const TemporaryFolder scratch;
  Picture8 noise = gradient(400, 400);
  std::uint32_t state = 1;
  for (std::uint8_t& pixel : noise.pixels)
    pixel = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24U);
  Image layers{200, 200, {{"power_W", {}}}};
  for (const std::uint8_t pixel : noise.pixels) {
    if (layers.layers[0].values.size() < 40000)
      layers.layers[0].values.push_back(pixel * 1.37e-9 + 1e-13);
  }
  write_png(scratch.path() / "a.png", gradient(5, 5), {});
  write_exr(scratch.path() / "a.exr", two_layers(), {});
  const std::string old_png = bytes_of(scratch.path() / "a.png");
  const std::string old_exr = bytes_of(scratch.path() / "a.exr");

  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20000, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string png_code = code_of([&] { write_png(scratch.path() / "a.png", noise, {}); });
  const std::string exr_code = code_of([&] { write_exr(scratch.path() / "a.exr", layers, {}); });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  CHECK(png_code == "E-IO");
  CHECK(exr_code == "E-IO");
  CHECK((bytes_of(scratch.path() / "a.png") == old_png));
  CHECK((bytes_of(scratch.path() / "a.exr") == old_exr));
  CHECK(entries(scratch.path()) == 2);
}

TEST_CASE("Sizes that do not match the values are our own mistake", "[image]") {
  const TemporaryFolder scratch;
  CHECK_THROWS_AS(
      write_png(scratch.path() / "a.png", Picture8{4, 4, std::vector<std::uint8_t>(15)}, {}),
      InternalError);
  CHECK_THROWS_AS(write_png(scratch.path() / "a.png", Picture8{0, 4, {}}, {}), InternalError);
  CHECK_THROWS_AS(write_exr(scratch.path() / "a.exr", Image{2, 2, {{"x", {1, 2, 3}}}}, {}),
                  InternalError);
  CHECK(fs::is_empty(scratch.path()));
}
