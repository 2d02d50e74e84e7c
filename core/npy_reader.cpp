#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/errors.h"
#include "core/files.h"
#include "core/npy.h"
#include "core/text.h"

namespace fanbeam::core {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "values are read as they lie");

constexpr std::size_t kMostNpyHeader_bytes = 65536;
constexpr std::size_t kMostNpyAxes = 8;
constexpr std::size_t kMostNpyValues = std::size_t{1} << 40U;
constexpr std::array<std::pair<std::string_view, std::size_t>, 5> kNpyTypes = {
    {{"<c8", 8}, {"<c16", 16}, {"<f4", 4}, {"<f8", 8}, {"<i2", 2}}};

[[noreturn]] void refuse_npy(ErrorClass kind, const fs::path& path, const std::string& field,
                             const std::string& value, const std::string& expected) {
  throw_input_error(kind, Place{path.string()}, field, value, expected);
}

// The text behind 'key': up to the end of the dictionary; nothing where it is missing. Other texts are
// stepped over whole: what looks like a key in one is none.
std::string_view behind(std::string_view dictionary, std::string_view key) {
  const std::string wanted = "'" + std::string(key) + "':";
  for (std::size_t at = 0; at < dictionary.size(); ++at) {
    const std::string_view rest = dictionary.substr(at);
    if (rest.starts_with(wanted)) return trimmed(rest.substr(wanted.size()));
    if (rest.front() != '\'' && rest.front() != '"') continue;
    const std::size_t length = rest.find(rest.front(), 1);
    if (length == std::string_view::npos) break;
    at += length;
  }
  return {};
}

// Of a text the text alone, of a list of fields its beginning.
std::string_view told_type(std::string_view type) {
  constexpr std::size_t kMostTold = 20;
  return type.starts_with('\'') ? type.substr(0, std::min(type.find('\'', 1), kMostTold - 1) + 1)
                                : type.substr(0, kMostTold);
}

std::vector<std::size_t> shape_in(std::string_view text, const fs::path& path) {
  if (text.empty() || text.front() != '(' || text.find(')') == std::string_view::npos)
    refuse_npy(ErrorClass::parse, path, "shape", std::string(text.substr(0, 40)), "a tuple");
  text = text.substr(1, text.find(')') - 1);
  std::vector<std::size_t> shape;
  while (!trimmed(text).empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view number = trimmed(text.substr(0, comma));
    std::size_t length = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), length);
    if (error != std::errc() || end != number.data() + number.size())
      refuse_npy(ErrorClass::parse, path, "shape", std::string(number), "whole numbers");
    shape.push_back(length);
    if (shape.size() > kMostNpyAxes)
      refuse_npy(ErrorClass::limit, path, "shape", "more than 8 axes", "1 to 8 axes");
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  if (shape.empty()) refuse_npy(ErrorClass::unsupported, path, "shape", "()", "1 to 8 axes");
  return shape;
}

void check_size(const NpyHeader& header, const fs::path& path, std::uintmax_t file_bytes) {
  std::size_t count = 1;
  for (const std::size_t length : header.shape) {
    if (length == 0) refuse_npy(ErrorClass::range, path, "shape", "0", "axes of 1 or more");
    if (count > kMostNpyValues / length)
      refuse_npy(ErrorClass::limit, path, "shape", "more than 2^40 values", "fewer");
    count *= length;
  }
  const std::uintmax_t needed = header.begin_byte + count * header.value_bytes;
  if (needed > file_bytes)
    refuse_npy(ErrorClass::parse, path, "values", std::to_string(file_bytes) + " bytes",
               std::to_string(needed) + " bytes, as the shape says");
}

std::complex<double> npy_value(std::string_view type, const char* bytes) {
  const auto part = [bytes]<class T>(T, std::size_t place) {
    T value;
    std::memcpy(&value, bytes + place * sizeof(T), sizeof(T));
    return static_cast<double>(value);
  };
  if (type == "<c8") return {part(0.0F, 0), part(0.0F, 1)};
  if (type == "<c16") return {part(0.0, 0), part(0.0, 1)};
  if (type == "<f4") return part(0.0F, 0);
  if (type == "<f8") return part(0.0, 0);
  return part(std::int16_t{}, 0);
}

struct NpyStretch {
  std::size_t first, count;
  double largest;
};

// Hands each value to `take` as the file has it.
template <class Take>
void read_each(const fs::path& path, const NpyHeader& header, const NpyStretch& stretch,
               const Take& take) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(header.begin_byte + stretch.first * header.value_bytes));
  std::string bytes(stretch.count * header.value_bytes, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) refuse_npy(ErrorClass::io, path, "values", "read failed", "a readable file");
  for (std::size_t i = 0; i < stretch.count; ++i) {
    const std::complex<double> value =
        npy_value(header.type, bytes.data() + i * header.value_bytes);
    const std::size_t number = stretch.first + i;
    const auto refuse = [&](ErrorClass kind, const std::string& found, const std::string& wanted) {
      refuse_npy(kind, path, "value " + std::to_string(number), found, wanted);
    };
    for (const double part : {value.real(), value.imag()}) {
      if (!std::isfinite(part)) refuse(ErrorClass::nonfinite, "not finite", "finite samples");
      if (std::abs(part) > stretch.largest)
        refuse(ErrorClass::range, number_text(part),
               number_text(-stretch.largest) + " to " + number_text(stretch.largest));
    }
    take(value);
  }
}

}  // namespace

std::size_t NpyHeader::count() const {
  std::size_t product = 1;
  for (const std::size_t length : shape) product *= length;
  return product;
}

NpyHeader read_npy_header(const fs::path& path) {
  ProblemList problems;
  std::ifstream stream = open_file(path, problems);
  problems.throw_if_errors();
  std::error_code status;
  const std::uintmax_t file_bytes = fs::file_size(path, status);
  if (status) refuse_npy(ErrorClass::io, path, "", status.message(), "a NumPy file");
  std::array<unsigned char, 12> first{};
  stream.read(reinterpret_cast<char*>(first.data()), first.size());
  if (stream.gcount() < 12 || std::memcmp(first.data(), "\x93NUMPY", 6) != 0 || first[6] < 1 ||
      first[6] > 3)
    refuse_npy(ErrorClass::parse, path, "", "no header", "a NumPy file of format 1 to 3");
  const bool is_short = first[6] == 1;
  const std::size_t length =
      first[8] + 256U * first[9] + (is_short ? 0U : 65536U * first[10] + 16777216U * first[11]);
  if (length > kMostNpyHeader_bytes)
    refuse_npy(ErrorClass::limit, path, "header", std::to_string(length), "65536 bytes at most");
  NpyHeader header;
  header.begin_byte = (is_short ? 10 : 12) + length;
  std::string text(length, ' ');
  stream.seekg(is_short ? 10 : 12);
  stream.read(text.data(), static_cast<std::streamsize>(length));
  if (static_cast<std::size_t>(stream.gcount()) != length)
    refuse_npy(ErrorClass::parse, path, "header", "cut short", std::to_string(length) + " bytes");
  const std::string_view type = behind(text, "descr");
  for (const auto& [name, bytes] : kNpyTypes)
    if (type.starts_with("'" + std::string(name) + "'")) {
      header.type = name;
      header.value_bytes = bytes;
    }
  if (header.type.empty())
    refuse_npy(ErrorClass::unsupported, path, "descr", std::string(told_type(type)),
               "one of: <c8, <c16, <f4, <f8, <i2");
  if (!behind(text, "fortran_order").starts_with("False"))
    refuse_npy(ErrorClass::unsupported, path, "fortran_order", "not False", "C order");
  header.shape = shape_in(behind(text, "shape"), path);
  check_size(header, path, file_bytes);
  return header;
}

std::vector<std::complex<float>> read_npy(const fs::path& path, const NpyHeader& header,
                                          std::size_t first, std::size_t count, double largest) {
  std::vector<std::complex<float>> values;
  values.reserve(count);
  read_each(path, header, {first, count, largest}, [&](const std::complex<double>& value) {
    values.push_back(static_cast<std::complex<float>>(value));
  });
  return values;
}

double largest_npy(const fs::path& path, const NpyHeader& header, std::size_t first,
                   std::size_t count, double largest) {
  double found = 0.0;
  read_each(path, header, {first, count, largest}, [&](const std::complex<double>& value) {
    found = std::max({found, std::abs(value.real()), std::abs(value.imag())});
  });
  return found;
}

}  // namespace fanbeam::core
