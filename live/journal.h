// A record of a live channel, from which every picture can be made again: packets as the channel took
// them, the tick and sampling of each frame, controls between the frames that they came between.
//
// JSON, a line each: first what was flown, then {"packet": HEX, "s": ARRIVAL}, {"frame": NUMBER,
// "now_s", "at_s", "samples"} and {"control": PATH, "body": TEXT}, in their order. Times are seconds
// since the channel began; samples of 0 are the scene's own. Of several sources "from" is a list, and
// "from" of a packet its place there, from 0 up (0 is left out). A frame that the end of the channel left
// unmade is not in it. live/recording.h reads it. Thread-safe.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "live/own_file.h"

namespace fanbeam::live {

// What else the same pictures need: the options that were given beside these have to be the same. Of
// recordings from before they kept sensor and effects, nothing is known of these.
struct FlownBy {
  static constexpr std::size_t kMostSources = 8;

  std::string scene;
  std::vector<std::string> from;
  double rate_Hz = 16.0;
  bool lockstep = false;
  std::optional<std::string> sensor{};   // its name
  std::optional<std::string> effects{};  // the wishes about them, as they were told
};

// When a frame was asked for, and for when.
struct Tick {
  std::uint64_t number = 0;  // of the frame, from 1 up
  double now_s = 0.0, at_s = 0.0;
};

class Journal {
 public:
  // Throws InputError E-IO, also where another process records there. When lines cannot be written,
  // what stands there is whole up to the line before, nothing comes behind it, and whoever flies is
  // told so by that error: from begin(), packet(), made(), throw_if_failed() and close().
  Journal(const std::filesystem::path& file, const FlownBy& flown_by);

  // The channel flies: what was in the file is gone. The first line that is written does so too.
  void begin();

  void packet(double arrived_s, std::span<const std::uint8_t> bytes, std::size_t source = 0);
  // Waits for made(), and with it whatever comes after.
  void frame(const Tick& tick, double samples);
  // The frame is there to be shown, or will never be: then its line is left out.
  void made(bool shown);
  // Of any thread, which is told nothing where it cannot be written: it is in force all the same.
  void control(const std::string& path, const std::string& body);
  void throw_if_failed();
  // The flight is over; what still comes is left out. Throws as above, also where the system refuses
  // only now.
  void close();

  // While it is held no control comes into force: whoever sets one, or takes the conditions of a
  // frame, holds it until that is written.
  std::unique_lock<std::mutex> quiet() { return std::unique_lock(conditions_); }

 private:
  void write(const std::string& line);
  void put(const std::string& text);

  OwnFile file_;
  std::string head_;  // until it is written
  std::mutex conditions_, writing_;
  std::string frame_, behind_;  // lines of the frame that is being made, and of what came since
  core::ProblemList fault_;     // of the first line that could not be written
};

}  // namespace fanbeam::live
