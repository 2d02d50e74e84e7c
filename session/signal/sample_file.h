// Beat samples that somebody recorded, as NumPy files: of this program (product beat) or of a radar.
//
// What the axes mean is text, outermost first: frame, chirp, transmitter, receiver, channel, sample.
//   channel      transmitter * receivers + receiver; instead of transmitter and receiver
//   chirp        of one transmitter; where the array has several in time division (slots of its waveform) and
//                the axes name neither channel nor transmitter, the chirps of all of them in turn
//   missing      an axis of length 1
// The default, "channel, chirp, sample", is what product beat writes, a frame a file; with a fourth axis
// in front frames follow each other in one file. Types <c8, <c16, and <f4, <f8, <i2 for real samples.
// Values times `scale_sqrtW` are square roots of watts at a receiver's port: it changes the powers that
// are told, never what is found. `conjugate` is for mixers that give received minus
// transmitted, where the beat of rising chirps falls with range. Falling chirps cannot be read: conjugated or real, they
// have the sign of speeds and azimuths wrong. Parts of samples are within 1e10 sqrt(W), far above any receiver's: their
// sum over a frame, squared, still is a float. Of a file with anything but zeros the largest is 1e-30 sqrt(W) or more, and
// 1e-30 without the scale: noise far below it still is a float.
#pragma once

#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/npy.h"
#include "session/signal/radar.h"
#include "session/signal/sample_layout.h"
#include "signal/cube.h"

namespace fanbeam::session {

// The axes of a text, each at most once; nothing for any other text.
inline constexpr const char* kAxesWords =
    "sample, and of frame, chirp, transmitter and receiver (or channel), each at most once";
std::optional<std::vector<std::string>> sample_axes(const std::string& text);

class SampleFiles {
 public:
  // All headers and values are read, and what is wrong with them is told together: shapes have to fit the radar's first
  // stage (E-RANGE with what was expected; more samples or chirps than the waveform has are left out, of a ramp's
  // end); of each file the first value that is not finite or too large is told, or that all are too small.
  SampleFiles(std::vector<std::filesystem::path> files, const FmcwRadar& radar,
              SampleLayout layout);

  int frames() const { return frames_; }
  signal::FloatCube frame(int index) const;

 private:
  struct File {
    std::filesystem::path path;
    core::NpyHeader header;
    std::size_t frames = 1;
  };
  void add(std::filesystem::path path, core::ProblemList& problems);
  bool fits(const File& file, core::ProblemList& problems) const;
  void correct(core::ProblemList& problems);
  void check_values(const File& file, core::ProblemList& problems) const;

  std::vector<File> files_;
  SampleLayout layout_;
  std::vector<std::complex<float>> corrections_;  // of each channel
  signal::CubeShape shape_;
  int transmitters_ = 1, receivers_ = 1, slots_ = 1;
  bool real_ = false;
  // How far from 0 a value in the files may be and the largest of a file has to be, before any scale.
  double most_value_ = core::kMostFloat, least_value_ = 0.0;
  int frames_ = 0;
};

}  // namespace fanbeam::session
