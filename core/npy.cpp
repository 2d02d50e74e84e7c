#include "core/npy.h"

#include <bit>
#include <fstream>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::core {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie");

std::string header(std::string_view type, const std::vector<std::size_t>& shape) {
  std::string text = "{'descr': '";
  text.append(type).append("', 'fortran_order': False, 'shape': (");
  for (std::size_t axis = 0; axis < shape.size(); ++axis)
    text.append(axis == 0 ? "" : ", ").append(std::to_string(shape[axis]));
  if (shape.size() == 1) text += ',';  // a tuple of one
  text += "), }";
  constexpr std::size_t kBefore = 10, kAlignment = 64;
  const std::size_t unpadded = kBefore + text.size() + 1;
  text.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  text += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(text.size() & 0xFFU);
  bytes += static_cast<char>(text.size() >> 8U);
  return bytes + text;
}

void write(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
           std::string_view type, const void* values, std::size_t count, std::size_t value_bytes) {
  std::size_t product = 1;
  for (const std::size_t length : shape) product *= length;
  if (product != count) throw InternalError("the shape of an array is not that of its values");
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    const std::string first = header(type, shape);
    stream.write(first.data(), static_cast<std::streamsize>(first.size()));
    stream.write(static_cast<const char*>(values),
                 static_cast<std::streamsize>(count * value_bytes));
    stream.close();
    if (!stream)
      throw_input_error(ErrorClass::io, Place{path.string()}, "array", "not written",
                        "room and permission to write");
  });
}

}  // namespace

void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<std::complex<float>>& values) {
  write(path, shape, "<c8", values.data(), values.size(), sizeof(std::complex<float>));
}

void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
               const std::vector<double>& values) {
  write(path, shape, "<f8", values.data(), values.size(), sizeof(double));
}

}  // namespace fanbeam::core
