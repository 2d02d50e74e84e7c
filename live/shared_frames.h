// The newest frames in POSIX shared memory, for programs on the same machine that want them without
// a socket: a ring that readers look into at their own pace.
//
// /dev/shm/NAME, mode 0600, little-endian, written in place; docs/live.md has the layout with readers
// in C and Python. A slot's sequence is odd while it is written and twice the frame's number when it is
// whole: a reader copies the slot and takes the copy when the sequence was
// the same even number before and after. With eight slots it has half a second at 16 Hz to do so.
// Readers cannot hold up or harm the writer's frames, whatever they do. Axes and levels that a control
// moves stand in each slot as they are of its frame, and in the header as of the newest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "live/hub.h"
#include "sensors/sensor.h"

namespace fanbeam::live {

// Offsets in bytes; numbers are u32 and u64 where said, else f64 in SI units and radians.
struct SharedLayout {
  static constexpr char kMagic[8] = {'F', 'A', 'N', 'B', 'E', 'A', 'M', '\0'};
  static constexpr std::uint32_t kVersion = 2;
  static constexpr std::size_t kHeader_bytes = 256, kSlots = 8, kPictures = 192;
  // Of the header: u32 from kVersionAt to kRowsAt, then f64, then the u64 of the newest frame.
  static constexpr std::size_t kVersionAt = 8, kHeaderBytesAt = 12, kSlotsAt = 16,
                               kSlotBytesAt = 20, kBScopeAt = 24, kCScopeAt = 32;
  static constexpr std::size_t kAxesAt = 40;  // eight f64, see shared_frames.cpp
  static constexpr std::size_t kCScopeTopAt = 64, kLevelsAt = 80;  // of those
  static constexpr std::size_t kNewestAt = 104;
  // Text, ended by a zero; in memory of earlier channels of this version nothing but zeros.
  static constexpr std::size_t kUnitsAt = 112;
  static constexpr char kUnits[] =
      "range:m,angle:rad,level:dB,rate:Hz,time:s,position:rad WGS84,height:m ellipsoid,"
      "samples:per cell,error:grey RMS";
  static_assert(kUnitsAt + sizeof kUnits <= kHeader_bytes);
};

// Letters, digits, dots, hyphens and underscores, no dot first, at most 64. Throws InputError E-PARSE for another one.
void check_shared_name(const std::string& name);

class SharedFrames {
 public:
  // Throws InputError: E-PARSE as check_shared_name, E-IO when the system refuses, another process holds it, or a file
  // of that name is another user's or one that others may open. What a process left that has ended is
  // taken over.
  SharedFrames(const std::string& name, const sensors::Sensor& sensor, double rate_Hz);
  ~SharedFrames();  // the name is gone, unless another has it by now; who has it mapped keeps what it sees
  SharedFrames(const SharedFrames&) = delete;
  SharedFrames& operator=(const SharedFrames&) = delete;

  // Of the sensor's sizes. One thread at a time.
  void write(const LiveFrame& frame);
  std::uint64_t newest() const { return newest_; }

 private:
  [[noreturn]] void give_up(const std::string& why);

  std::string name_;
  int file_ = -1;
  std::size_t slot_bytes_ = 0, bytes_ = 0;
  std::uint8_t* memory_ = nullptr;
  std::uint64_t newest_ = 0;
};

}  // namespace fanbeam::live
