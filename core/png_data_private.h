// The picture data of a PNG file: how many bytes they have to be, and whether they are.
#pragma once

#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fanbeam::core {

// As in the head chunk (ISO/IEC 15948:2004, 11.2.2).
struct PngHead {
  std::uint32_t columns = 0, rows = 0;
  int bits = 0, colour_type = 0, compression = 0, filter = 0, interlace = 0;

  // Whether the standard knows such a picture.
  bool known() const;
  bool with_palette() const { return colour_type == 3; }
};

// Inflates the data as they come, and keeps none of them.
class PngData {
 public:
  explicit PngData(const PngHead& head);
  ~PngData();
  PngData(const PngData&) = delete;
  PngData& operator=(const PngData&) = delete;

  // False where they are damaged, or more than the head promises.
  bool take(const char* bytes, std::uint32_t count);
  // Whether all of them came.
  bool complete() const { return ended_ && pass_ == passes_.size(); }

 private:
  struct Pass {
    std::uint64_t row_bytes = 0;  // with the filter's
    std::uint32_t rows = 0;
  };
  bool walk(const unsigned char* bytes, std::size_t count);

  z_stream stream_{};
  std::array<unsigned char, 16384> inflated_{};
  std::vector<Pass> passes_;
  std::size_t pass_ = 0;
  std::uint32_t row_ = 0;
  std::uint64_t at_ = 0;  // in the row
  bool ended_ = false;
};

}  // namespace fanbeam::core
