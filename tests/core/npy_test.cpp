// NumPy files byte by byte: what numpy.lib.format asks for.
#include "core/npy.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

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

namespace {

// Format 1.0 with any dictionary and values.
std::filesystem::path npy_file(const TemporaryFolder& folder, const std::string& dictionary,
                               const std::string& values) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(dictionary.size());
  bytes += '\0';
  const auto file = folder.path() / "in.npy";
  std::ofstream(file, std::ios::binary) << bytes << dictionary << values;
  return file;
}

std::string code_of(const std::filesystem::path& file) {
  try {
    const NpyHeader header = read_npy_header(file);
    read_npy(file, header, 0, header.count());
  } catch (const InputError& error) {
    return error.problems().front().code;
  }
  return "";
}

}  // namespace

TEST_CASE("What was written as a NumPy file is read back, from any place on", "[npy]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cube.npy";
  const std::vector<std::complex<float>> values{{1, 2}, {3, 4},  {5, 6},
                                                {7, 8}, {9, 10}, {-0.5F, 1}};
  write_npy(file, {2, 3}, values);
  const NpyHeader header = read_npy_header(file);
  CHECK(header.type == "<c8");
  CHECK(header.shape == std::vector<std::size_t>{2, 3});
  CHECK(read_npy(file, header, 0, 6) == values);
  CHECK(read_npy(file, header, 4, 2) ==
        std::vector<std::complex<float>>(values.begin() + 4, values.end()));
  write_npy(file, {2}, std::vector<double>{1.5, -2.0});
  CHECK(read_npy(file, read_npy_header(file), 0, 2) ==
        std::vector<std::complex<float>>{1.5F, -2.0F});
  const auto whole = npy_file(folder, "{'descr': '<i2', 'fortran_order': False, 'shape': (2,)}",
                              std::string("\x02\x00\xff\xff", 4));
  CHECK(read_npy(whole, read_npy_header(whole), 0, 2) ==
        std::vector<std::complex<float>>{2.0F, -1.0F});
}

TEST_CASE("A text of a NumPy header that looks like a key is none", "[npy]") {
  const TemporaryFolder folder;
  const auto file = npy_file(folder,
                             "{\"note\": \"'descr': '<c8', 'shape': (9,)\", 'descr': '<i2', "
                             "'fortran_order': False, 'shape': (2,)}",
                             std::string("\x02\x00\xff\xff", 4));
  const NpyHeader header = read_npy_header(file);
  CHECK(header.type == "<i2");
  CHECK(header.shape == std::vector<std::size_t>{2});
}

TEST_CASE("A NumPy value beyond the largest is told with its place and sign", "[npy]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cube.npy";
  write_npy(file, {2}, std::vector<std::complex<float>>{{1, 2}, {3, -4}});
  const NpyHeader header = read_npy_header(file);
  CHECK(read_npy(file, header, 0, 2, 4.0).size() == 2);
  CHECK_THROWS_WITH(read_npy(file, header, 1, 1, 3.5),
                    Catch::Contains("E-RANGE value 1 = -4: expected -3.5 to 3.5"));
}

TEST_CASE("The largest NumPy value is told where floats hold nothing so small", "[npy]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "small.npy";
  write_npy(file, {3}, std::vector<double>{1e-50, -2e-50, 0.0});
  const NpyHeader header = read_npy_header(file);
  CHECK(largest_npy(file, header, 0, 3) == 2e-50);
  CHECK(largest_npy(file, header, 0, 1) == 1e-50);
  CHECK_THROWS_WITH(largest_npy(file, header, 0, 3, 1e-60), Catch::Contains("value 0 = 1e-50"));
}

TEST_CASE("NumPy files that lie, are cut or hold what is no number are refused", "[npy]") {
  const TemporaryFolder folder;
  CHECK(code_of(folder.path() / "none.npy") == "E-IO");
  REQUIRE(::mkfifo((folder.path() / "pipe.npy").c_str(), 0600) == 0);
  CHECK(code_of(folder.path() / "pipe.npy") == "E-IO");  // opening it would never end
  const auto with = [&](const std::string& dictionary, const std::string& values = {}) {
    return code_of(npy_file(folder, dictionary, values));
  };
  CHECK(with("{'descr': '<c8', 'fortran_order': False, 'shape': (1000000000,)}") == "E-PARSE");
  CHECK(with("{'descr': '<c8', 'fortran_order': False, 'shape': (99999999999, 99999999999)}") ==
        "E-LIMIT");
  CHECK(with("{'descr': '<c8', 'fortran_order': False, 'shape': (0, 3)}") == "E-RANGE");
  CHECK(with("{'descr': '<c8', 'fortran_order': False, 'shape': (-1,)}") == "E-PARSE");
  CHECK(with("{'descr': '<c8', 'fortran_order': False, 'shape': ()}") == "E-UNSUPPORTED");
  CHECK(with("{'descr': '>c8', 'fortran_order': False, 'shape': (1,)}") == "E-UNSUPPORTED");
  CHECK(with("{'descr': '<c8', 'fortran_order': True, 'shape': (1,)}") == "E-UNSUPPORTED");
  // Of the header the type alone is told.
  CHECK_THROWS_WITH(read_npy_header(npy_file(
                        folder, "{'descr': '>c8', 'fortran_order': False, 'shape': (1,)}", {})),
                    Catch::Contains("descr = '>c8': expected one of"));
  CHECK_THROWS_WITH(
      read_npy_header(
          npy_file(folder, "{'descr': [('i', '<i2'), ('q', '<i2')], 'fortran_order': False}", {})),
      Catch::Contains("descr = [('i', '<i2'), ('q',: expected one of"));
  CHECK(with("{'descr': '<f4', 'fortran_order': False, 'shape': (1,)}",
             std::string("\x00\x00\xc0\x7f", 4)) == "E-NONFINITE");
  CHECK(with("{}") == "E-UNSUPPORTED");
  const std::string huge_f8("\x9c\x75\x00\x88\x3c\xe4\x37\x7e", 8);  // 1e300
  CHECK_THROWS_WITH(
      [&] {
        const auto file =
            npy_file(folder, "{'descr': '<f8', 'fortran_order': False, 'shape': (1,)}", huge_f8);
        read_npy(file, read_npy_header(file), 0, 1);
      }(),
      Catch::Contains("E-RANGE value 0 = 1e+300: expected -3.4"));
  std::ofstream(folder.path() / "text.npy") << "not a NumPy file";
  CHECK(code_of(folder.path() / "text.npy") == "E-PARSE");
}
