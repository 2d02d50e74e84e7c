// What a CIGI host asks of the scene, until it is answered.
//
// One that is asked once waits for its turn. One with a period waits once, from a frame that its period falls on
// until its turn comes; periods that come round meanwhile are left out and counted. Each kind has its turn in the
// order in which it came to wait, and the kinds take turns: however many of one wait, they do not keep out the
// other. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "feeds/cigi/host_packets.h"

namespace fanbeam::live {

class CigiQuestions {
 public:
  static constexpr std::size_t kMost = 1024;  // of each kind

  using Question = std::variant<feeds::cigi::HeightRequest, feeds::cigi::SightRequest>;
  struct Asked {
    Question question;
    std::uint32_t host_frame = 0;  // that the answer names
  };

  // Takes the place of one with a period that has its number. Beyond kMost it is left out and counted.
  void ask(const Question& question, std::uint32_t host_frame);
  void clear();
  // Those whose period the frame falls on wait from now on.
  void begin_frame(std::uint32_t ig_frame);
  // The next one to be answered; one with a period names `host_frame`, the others that of their message.
  std::optional<Asked> next(std::uint32_t host_frame);

  // So far.
  std::uint64_t too_many() const { return too_many_; }
  std::uint64_t periods_left_out() const { return periods_left_out_; }

 private:
  // Heights and lines of sight have numbers of their own.
  using Key = std::pair<std::size_t, std::uint16_t>;
  struct Periodic {
    Question question;
    std::uint8_t period = 0;  // frames
    bool waits = false;       // is in due_
  };

  std::deque<Asked> once_;
  std::map<Key, Periodic> periodic_;
  std::deque<Key> due_;
  Key answered_{};  // the last one of due_
  bool once_had_its_turn_ = false;
  std::uint64_t too_many_ = 0, periods_left_out_ = 0;
};

}  // namespace fanbeam::live
