// NumPy files byte by byte: what numpy.lib.format asks for.
#include "core/npy.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "core/errors.h"
#include "tests/core/image_files.h"

using namespace fanbeam::core;
using fanbeam::tests::bytes_of;
using fanbeam::tests::TemporaryFolder;

TEST_CASE("A NumPy file has the header that numpy writes and the values behind it", "[npy]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cube.npy";
  write_npy(
      file, {2, 3},
      std::vector<std::complex<float>>{{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}, {-0.5F, 0.25F}});
  const std::string bytes = bytes_of(file);
  // numpy 1.24's own header for this array, padded to a multiple of 64 bytes.
  const std::string text = "{'descr': '<c8', 'fortran_order': False, 'shape': (2, 3), }";
  REQUIRE(bytes.size() == 128 + 6 * 8);
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  CHECK(static_cast<unsigned char>(bytes[8]) == 118);
  CHECK(bytes[9] == 0);
  CHECK(bytes.substr(10, text.size()) == text);
  CHECK(bytes[127] == '\n');
  CHECK(bytes.find_first_not_of(' ', 10 + text.size()) == 127);
  float last[2];
  std::memcpy(last, bytes.data() + 128 + 5 * 8, 8);
  CHECK(last[0] == -0.5F);
  CHECK(last[1] == 0.25F);
}

TEST_CASE("One axis and none are tuples too", "[npy]") {
  const TemporaryFolder folder;
  write_npy(folder.path() / "a.npy", {2}, std::vector<double>{1.0, 2.0});
  CHECK(bytes_of(folder.path() / "a.npy").find("'<f8', 'fortran_order': False, 'shape': (2,), }") !=
        std::string::npos);
  write_npy(folder.path() / "b.npy", {}, std::vector<double>{1.0});
  CHECK(bytes_of(folder.path() / "b.npy").find("'shape': (), }") != std::string::npos);
  CHECK_THROWS_AS(write_npy(folder.path() / "c.npy", {3}, std::vector<double>{1.0}), InternalError);
  CHECK_THROWS_AS(write_npy("/proc/none/c.npy", {1}, std::vector<double>{1.0}), InputError);
}
