// What --to of fanbeam live says of where frames go to beside the page, and those places.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "live/radar_video.h"
#include "live/raw_frames.h"
#include "live/shared_frames.h"

namespace fanbeam::live {

struct RawSink {
  RawFrames::Scope scope = RawFrames::Scope::bscope;
  std::string file;
};

struct FramesTo {
  std::vector<std::string> shared;  // names of shared memory
  std::vector<RawSink> raw;
  std::vector<RadarVideoSettings> video;

  bool take_stdout() const;
  // Raw pictures go there, whatever name it goes by; "-" is the standard output.
  bool write_into(const std::string& file) const;
  bool want_received() const;  // LiveFrame::received_W
};

// shm:NAME, raw-bscope:FILE, raw-cscope:FILE, or cat240:ADDRESS:PORT and behind it ",bits=8" or 16,
// ",azimuth=nose" or true, ",compress=none" or zlib, ",source=SAC/SIC", ",interface=ADDRESS" and
// ",hops=N", in any order. Throws InputError.
void add_sink(const std::string& text, FramesTo& to);

// Frames go to all of them.
class Sinks {
 public:
  Sinks(const FramesTo& to, bool every_frame) : to_(to), every_frame_(every_frame) {}
  // Frames are that scene's from now on. Files and pipes are opened the first time and stay open.
  // Throws InputError with all that cannot be opened.
  void begin(const scenes::SceneDescription& scene, double rate_Hz);
  // Behind begin(). Raw video has no word for another size of its pictures: throws InputError (E-UNSUPPORTED) where
  // that scene's are of another one.
  void check_raw_size(const scenes::SceneDescription& next) const;
  void write(const std::shared_ptr<const LiveFrame>& frame);
  bool any_ended() const;
  // No more frames. Throws InputError E-IO with all that could not be written.
  void end();

 private:
  const FramesTo& to_;
  bool every_frame_;
  std::vector<std::unique_ptr<SharedFrames>> shared_;
  std::vector<std::unique_ptr<RawFrames>> raw_;
  sensors::Sensor raw_sensor_;  // that their pictures are of
  std::vector<std::unique_ptr<RadarVideo>> video_;
};

}  // namespace fanbeam::live
