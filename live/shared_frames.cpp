#include "live/shared_frames.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/errors.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::live {
namespace {

using Layout = SharedLayout;

static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free);

[[noreturn]] void refuse(const std::string& name, const std::string& why,
                         const char* expected = "shared memory of this process alone") {
  core::throw_input_error(core::ErrorClass::io, core::Place{"/dev/shm/" + name}, "", why, expected);
}

// Anybody may put a file there, and would read what is written into it, or change it.
void check_own(const std::string& name, int file) {
  struct stat facts {};
  if (fstat(file, &facts) == 0 && facts.st_uid == geteuid() && (facts.st_mode & 077U) == 0) return;
  close(file);
  refuse(name, fmt::format("a file of user {}, mode {:03o}", facts.st_uid, facts.st_mode & 0777U),
         "none, or one of this user's that nobody else may open");
}

// Another one may have removed the name between opening and locking, or taken it since.
bool has_name(const std::string& name, int file) {
  const int other = shm_open(("/" + name).c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (other < 0) return false;
  struct stat mine {
  }, there{};
  const bool same = fstat(file, &mine) == 0 && fstat(other, &there) == 0 &&
                    mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
  close(other);
  return same;
}

// Of a file that is locked: nobody else takes its name away.
void remove_name(const std::string& name, int file) {
  if (has_name(name, file)) shm_unlink(("/" + name).c_str());
}

int opened(const std::string& name) {
  const int file = shm_open(("/" + name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) refuse(name, std::generic_category().message(errno));
  check_own(name, file);
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  close(file);
  refuse(name, "in use by another process");
}

// Empty, locked and of that name. A lock dies with its process, so what can be locked belongs to nobody; whoever
// still has that mapped keeps it.
int claimed(const std::string& name) {
  constexpr int kTries = 10;
  for (int tries = 0; tries < kTries; ++tries) {
    const int file = opened(name);
    struct stat facts {};
    const bool empty = fstat(file, &facts) == 0 && facts.st_size == 0;
    if (empty && has_name(name, file)) return file;
    if (!empty) remove_name(name, file);
    close(file);
  }
  refuse(name, "taken away by another process again and again");
}

template <class T>
void put(std::uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

std::atomic_ref<std::uint64_t> counter(void* at) {
  return std::atomic_ref<std::uint64_t>(*static_cast<std::uint64_t*>(at));
}

std::size_t pixels(const sensors::Sensor& sensor, int rows) {
  return static_cast<std::size_t>(sensor.scan.columns) * static_cast<std::size_t>(rows);
}

void write_header(std::uint8_t* memory, const sensors::Sensor& sensor, double rate_Hz,
                  std::size_t slot_bytes) {
  const auto whole = [&](std::size_t at, std::size_t value) {
    put(memory + at, static_cast<std::uint32_t>(value));
  };
  whole(Layout::kVersionAt, Layout::kVersion);
  whole(Layout::kHeaderBytesAt, Layout::kHeader_bytes);
  whole(Layout::kSlotsAt, Layout::kSlots);
  whole(Layout::kSlotBytesAt, slot_bytes);
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  whole(Layout::kBScopeAt, columns);
  whole(Layout::kBScopeAt + 4, static_cast<std::size_t>(sensor.range.cells));
  whole(Layout::kCScopeAt, columns);
  whole(Layout::kCScopeAt + 4, static_cast<std::size_t>(sensor.display.cscope_rows));
  const sensors::GreyScale grey(sensor);
  std::size_t at = Layout::kAxesAt;
  for (const double value :
       {sensor.range.minimum_m, sensor.range.cell_m, sensor.scan.field_of_view_rad,
        sensor.display.cscope_top_rad, sensor.display.cscope_span_rad, grey.low_dB(),
        grey.high_dB(), rate_Hz}) {
    put(memory + at, value);
    at += sizeof value;
  }
  std::memcpy(memory + Layout::kUnitsAt, Layout::kUnits, sizeof Layout::kUnits);
  // Last: who sees it sees the rest.
  std::atomic_thread_fence(std::memory_order_release);
  std::memcpy(memory, Layout::kMagic, sizeof Layout::kMagic);
}

}  // namespace

void check_shared_name(const std::string& name) {
  constexpr const char* kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  if (name.empty() || name.size() > 64 || name[0] == '.' ||
      name.find_first_not_of(kPlain) != std::string::npos)
    core::throw_input_error(core::ErrorClass::parse, "--to shm", "\"" + name + "\"",
                            "a name of letters, digits, '.', '-' and '_'");
}

SharedFrames::SharedFrames(const std::string& name, const sensors::Sensor& sensor, double rate_Hz)
    : name_(name) {
  check_shared_name(name);
  const std::size_t bytes = Layout::kPictures + pixels(sensor, sensor.range.cells) +
                            pixels(sensor, sensor.display.cscope_rows);
  slot_bytes_ = (bytes + 63) / 64 * 64;
  bytes_ = Layout::kHeader_bytes + Layout::kSlots * slot_bytes_;
  file_ = claimed(name);
  if (const int fault = posix_fallocate(file_, 0, static_cast<off_t>(bytes_)); fault != 0)
    give_up(std::generic_category().message(fault));
  void* const memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED) give_up(std::generic_category().message(errno));
  memory_ = static_cast<std::uint8_t*>(memory);
  write_header(memory_, sensor, rate_Hz, slot_bytes_);
}

SharedFrames::~SharedFrames() {
  remove_name(name_, file_);
  munmap(memory_, bytes_);
  close(file_);
}

void SharedFrames::give_up(const std::string& why) {
  remove_name(name_, file_);
  close(file_);
  refuse(name_, why);
}

void SharedFrames::write(const LiveFrame& frame) {
  if (Layout::kPictures + frame.bscope.pixels.size() + frame.cscope.pixels.size() > slot_bytes_)
    throw core::InternalError("a frame of another size than the sensor's");
  std::uint8_t* const slot =
      memory_ + Layout::kHeader_bytes + frame.number % Layout::kSlots * slot_bytes_;
  counter(slot).store(2 * frame.number - 1, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  put(slot + 8, frame.number);
  const core::Attitude attitude = core::attitude_from(frame.pose.q_NB);
  const PictureErrors errors = frame.errors.value_or(PictureErrors{-1.0, -1.0});
  std::size_t at = 16;
  for (const double value :
       {frame.pose.time_s, frame.pose.position.latitude_rad, frame.pose.position.longitude_rad,
        frame.pose.position.height_m, attitude.roll_rad, attitude.pitch_rad, attitude.heading_rad,
        1e-3 * frame.frame_ms, 1e-3 * frame.pose_age_ms, frame.samples,
        frame.outside_volume ? 1.0 : 0.0, frame.cscope_top_rad, frame.low_dB, frame.high_dB,
        errors.bscope_grey, errors.cscope_grey, frame.began_s}) {
    put(slot + at, value);
    at += sizeof value;
  }
  put(memory_ + Layout::kCScopeTopAt, frame.cscope_top_rad);
  put(memory_ + Layout::kLevelsAt, frame.low_dB);
  put(memory_ + Layout::kLevelsAt + sizeof(double), frame.high_dB);
  std::uint8_t* const picture = slot + Layout::kPictures;
  std::copy(frame.cscope.pixels.begin(), frame.cscope.pixels.end(),
            std::copy(frame.bscope.pixels.begin(), frame.bscope.pixels.end(), picture));
  counter(slot).store(2 * frame.number, std::memory_order_release);
  newest_ = frame.number;
  counter(memory_ + Layout::kNewestAt).store(newest_, std::memory_order_release);
}

}  // namespace fanbeam::live
