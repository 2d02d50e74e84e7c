// SHA-256 (FIPS 180-4) of files, as 64 hexadecimal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace fanbeam::datasets {

std::string sha256(std::string_view bytes);
// Throws InputError E-IO.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace fanbeam::datasets
