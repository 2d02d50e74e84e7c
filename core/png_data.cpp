#include <algorithm>

#include "core/errors.h"
#include "core/png_data_private.h"

namespace fanbeam::core {
namespace {

// Of the colour type; 0 where there is no such type.
unsigned samples_of_pixel(int colour_type) {
  constexpr std::array<unsigned, 7> kSamples = {1, 0, 3, 1, 2, 0, 4};
  return colour_type >= 0 && colour_type < 7 ? kSamples.at(static_cast<std::size_t>(colour_type))
                                             : 0;
}

}  // namespace

bool PngHead::known() const {
  const bool power_of_two = bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
  const bool grey = colour_type == 0;
  return samples_of_pixel(colour_type) > 0 && power_of_two &&
         (bits >= 8 || grey || with_palette()) && !(bits == 16 && with_palette()) &&
         compression == 0 && filter == 0 && (interlace == 0 || interlace == 1);
}

PngData::PngData(const PngHead& head) {
  if (inflateInit(&stream_) != Z_OK) throw InternalError("zlib does not begin");
  const std::uint64_t pixel_bits =
      samples_of_pixel(head.colour_type) * static_cast<std::uint64_t>(head.bits);
  const auto add = [&](std::uint32_t columns, std::uint32_t rows) {
    if (columns > 0 && rows > 0) passes_.push_back({(columns * pixel_bits + 7) / 8 + 1, rows});
  };
  if (head.interlace == 0) {
    add(head.columns, head.rows);
    return;
  }
  // Adam7: where each pass begins, and its steps.
  struct Grid {
    std::uint32_t column, row, column_step, row_step;
  };
  for (const Grid& grid : {Grid{0, 0, 8, 8}, Grid{4, 0, 8, 8}, Grid{0, 4, 4, 8}, Grid{2, 0, 4, 4},
                           Grid{0, 2, 2, 4}, Grid{1, 0, 2, 2}, Grid{0, 1, 1, 2}})
    add((head.columns + grid.column_step - 1 - grid.column) / grid.column_step,
        (head.rows + grid.row_step - 1 - grid.row) / grid.row_step);
}

PngData::~PngData() { inflateEnd(&stream_); }

bool PngData::walk(const unsigned char* bytes, std::size_t count) {
  constexpr unsigned char kLastFilter = 4;
  for (std::size_t i = 0; i < count;) {
    if (pass_ == passes_.size()) return false;
    if (at_ == 0 && bytes[i] > kLastFilter) return false;
    const Pass& pass = passes_[pass_];
    const std::uint64_t part = std::min<std::uint64_t>(count - i, pass.row_bytes - at_);
    i += static_cast<std::size_t>(part);
    at_ += part;
    if (at_ < pass.row_bytes) continue;
    at_ = 0;
    if (++row_ < pass.rows) continue;
    row_ = 0;
    ++pass_;
  }
  return true;
}

bool PngData::take(const char* bytes, std::uint32_t count) {
  stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes));  // zlib only reads it
  stream_.avail_in = count;
  do {
    stream_.next_out = inflated_.data();
    stream_.avail_out = static_cast<uInt>(inflated_.size());
    const int result = ended_ ? Z_BUF_ERROR : inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_BUF_ERROR) return true;  // nothing more to make of this
    if (result != Z_OK && result != Z_STREAM_END) return false;
    if (!walk(inflated_.data(), inflated_.size() - stream_.avail_out)) return false;
    ended_ = result == Z_STREAM_END;
  } while (stream_.avail_in > 0 || stream_.avail_out == 0);
  return true;
}

}  // namespace fanbeam::core
