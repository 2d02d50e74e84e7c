// What live/journal.h wrote, read back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "live/journal.h"

namespace fanbeam::live {

struct RecordedPacket {
  double arrived_s = 0.0;
  std::vector<std::uint8_t> bytes;
  std::size_t source = 0;  // its place in FlownBy::from
};

struct RecordedFrame {
  Tick tick;
  double samples = 0.0;  // 0: the scene's own
};

struct RecordedControl {
  std::string path, body;
  int line = 0;
};

struct Recording {
  std::string file;
  FlownBy flown_by;
  std::vector<std::variant<RecordedPacket, RecordedFrame, RecordedControl>> events;
};

// Throws InputError with every problem (the first 20 lines that have one): E-IO, E-LIMIT above 2 GiB,
// E-PARSE and E-RANGE with the line, E-REF alone for a file that begins otherwise. A last line without its
// end, of a channel that was killed, is left out.
Recording read_recording(const std::filesystem::path& file);

}  // namespace fanbeam::live
