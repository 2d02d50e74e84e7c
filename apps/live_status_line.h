// What fanbeam live prints while it runs.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "live/hub.h"
#include "live/mailbox.h"

namespace fanbeam::apps {

// As much of it as is taken at once; no word of what is not. Who prints on the channel's thread must neither
// wait for whoever reads (a terminal that Ctrl-S holds, a pipe that is full) nor end the flight where nobody
// reads any more.
void tell_without_waiting(int descriptor, std::string_view text);

// One line of a terminal on the standard error, made anew twice a second; beside it, terminal or not, a
// line a second at most about packets of no use, poses and weather that are refused.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const live::Status& status, int viewers);

 private:
  void complain(const live::Status& status);

  bool quiet_, shown_;
  live::Clock::time_point last_{}, complained_{};
  std::uint64_t told_ = 0;    // what of it was told so far
  std::string told_weather_;  // and of the weather
};

// Where the page is.
void print_address(const std::string& scene, const std::string& address, std::uint16_t port,
                   std::FILE* to);

}  // namespace fanbeam::apps
