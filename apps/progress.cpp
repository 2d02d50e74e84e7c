#include "apps/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace fanbeam::apps {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

std::string minutes_text(double seconds) {
  const auto whole = static_cast<long>(std::min(seconds, 359999.0) + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string what, int total, bool quiet, std::string things)
    : what_(std::move(what)),
      things_(std::move(things)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      last_drawn_(begin_) {}

Progress::~Progress() {
  if (!quiet_ && terminal_) std::fputs("\n", stderr);
}

void Progress::step(int done) {
  if (quiet_ || total_ <= 0) return;
  const Clock::time_point now = Clock::now();
  const double elapsed_s = std::max(Seconds(now - begin_).count(), 1e-9);
  const double rate = done / elapsed_s;
  const double left_s = done > 0 ? (total_ - done) / rate : 0.0;
  if (terminal_) {
    if (done < total_ && Seconds(now - last_drawn_).count() < 0.1) return;
    last_drawn_ = now;
    draw_bar(done, rate, left_s);
  } else if (100 * done >= next_line_percent_ * total_) {
    next_line_percent_ = 100 * done / total_ / 10 * 10 + 10;
    fmt::print(stderr, "{}: {} of {} {}, {:.1f} {}/s, {} left\n", what_, done, total_, things_,
               rate, things_, minutes_text(left_s));
  }
}

void Progress::draw_bar(int done, double rate, double left_s) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(static_cast<long>(kWidth) * done / total_);
  fmt::print(stderr, "\r{} [{}{}] {}/{} {}  {:.1f} {}/s  {} left ", what_,
             std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(kWidth - filled), '.'), done, total_, things_,
             rate, things_, minutes_text(left_s));
  std::fflush(stderr);
}

}  // namespace fanbeam::apps
