// A moving preview of a sequence through the ffmpeg program.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "core/child_process.h"
#include "core/image.h"

namespace fanbeam::session {

inline constexpr std::array<std::string_view, 3> kPreviewFormats = {"mp4", "gif", "apng"};

// Feeds pictures of one size to ffmpeg and leaves an MP4 (H.264) or, by extension, an animated GIF
// or PNG; an MP4 has a black column or row more where a side is odd. The film gets its name when it is complete: every picture can be read from it again.
class Preview {
 public:
  // Throws InputError E-IO when ffmpeg cannot be started; the message names the package.
  Preview(std::filesystem::path file, int columns, int rows, double frame_rate_Hz);
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  // Throws InputError E-IO when ffmpeg has given up.
  void add(const core::Picture8& picture);
  // Closes the film, reads it, and gives it its final name. Throws InputError E-IO when ffmpeg
  // failed or the film is not whole, as on a full disk, where ffmpeg reports success.
  void finish();

 private:
  bool is_complete() const;

  struct Temporary {
    std::filesystem::path path;
    ~Temporary();
  };

  std::filesystem::path file_;
  Temporary temporary_;  // outlives ffmpeg, which could make it anew
  int columns_, rows_;   // of the film
  int pictures_ = 0;
  core::ChildProcess ffmpeg_;
};

}  // namespace fanbeam::session
