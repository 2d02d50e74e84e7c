// Arrays as NumPy files, for whoever goes on with them: numpy.load reads them as they are.
//
// Format version 1.0 (numpy.lib.format): little-endian, C order, the last axis' neighbours lie side
// by side. Written under a temporary name and renamed; the same array gives the same bytes.
#pragma once

#include <complex>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace fanbeam::core {

// The product of `shape` must be the number of values (InternalError). Throws InputError E-IO when
// the file cannot be written; an old file is then untouched.
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<std::complex<float>>& values);  // complex64
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<double>& values);  // float64

}  // namespace fanbeam::core
