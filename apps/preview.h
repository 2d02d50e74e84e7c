// A moving preview of a sequence through the ffmpeg program.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "core/image.h"

namespace fanbeam::apps {

// Feeds pictures of one size to ffmpeg and leaves an MP4 (H.264) or, by extension, an animated GIF
// or PNG.
class Preview {
 public:
  // Throws InputError E-IO when ffmpeg cannot be started; the message names the package.
  Preview(std::filesystem::path file, int columns, int rows, double frame_rate_Hz);
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  void add(const core::Picture8& picture);
  // Closes the video and gives it its final name. Throws InputError E-IO when ffmpeg failed.
  void finish();

 private:
  std::filesystem::path file_, temporary_;
  int pipe_ = -1;
  int process_ = 0;
};

}  // namespace fanbeam::apps
