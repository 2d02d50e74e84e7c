// What fanbeam live prints while it runs.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "live/hub.h"
#include "live/mailbox.h"

namespace fanbeam::apps {

// One line of a terminal on the standard error, made anew twice a second.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const live::Status& status, int viewers);

 private:
  bool shown_;
  live::Clock::time_point last_{};
};

// Where the page is.
void print_address(const std::string& scene, const std::string& address, std::uint16_t port,
                   std::FILE* to);

}  // namespace fanbeam::apps
