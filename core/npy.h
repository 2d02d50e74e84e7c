// Arrays as NumPy files: written for whoever goes on with them (numpy.load reads them as they are), and
// read from whoever recorded them.
//
// Format version 1.0 (numpy.lib.format): little-endian, C order, the last axis' neighbours lie side
// by side. Written under a temporary name and renamed; the same array gives the same bytes.
#pragma once

#include <complex>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace fanbeam::core {

// The product of `shape` must be the number of values (InternalError). Throws InputError E-IO when
// the file cannot be written; an old file is then untouched.
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<std::complex<float>>& values);  // complex64
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<double>& values);  // float64

// What a file's header says: type as NumPy writes it ("<c8"), shape, and where the values begin.
struct NpyHeader {
  std::string type;
  std::vector<std::size_t> shape;
  std::size_t begin_byte = 0;
  std::size_t value_bytes = 0;

  std::size_t count() const;
};

// Takes versions 1 to 3 of the format in C order with the types <c8, <c16, <f4, <f8 and <i2, 1 to 8 axes,
// and no more values than the file holds. Throws InputError: E-IO, E-PARSE, E-UNSUPPORTED, E-LIMIT
// (2^40 values).
NpyHeader read_npy_header(const std::filesystem::path& path);

// The largest that a sample holds.
inline constexpr double kMostFloat = static_cast<double>(std::numeric_limits<float>::max());

// `count` values from the one with number `first` on, as complex numbers; E-NONFINITE for one that is not
// finite, E-RANGE for one with a part beyond `largest`, either sign. The header must be the file's.
std::vector<std::complex<float>> read_npy(const std::filesystem::path& path,
                                          const NpyHeader& header, std::size_t first,
                                          std::size_t count, double largest = kMostFloat);

// The farthest from 0 that a part of these values is, as the file has them: below the smallest float too, where
// read_npy gives 0. Refuses what that refuses.
double largest_npy(const std::filesystem::path& path, const NpyHeader& header, std::size_t first,
                   std::size_t count, double largest = kMostFloat);

}  // namespace fanbeam::core
