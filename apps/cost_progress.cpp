#include "apps/cost_progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fanbeam::apps {

std::string duration_text(double seconds) {
  return seconds < 90.0 ? fmt::format("{:.0f} s", std::max(1.0, seconds))
                        : fmt::format("{:.0f} min", std::ceil(seconds / 60.0));
}

CostProgress::CostProgress(std::string what, double total_s, bool quiet)
    : what_(std::move(what)),
      total_s_(std::max(total_s, 1e-3)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()) {}

CostProgress::~CostProgress() {
  if (!quiet_ && terminal_) std::fputs("\n", stderr);
}

void CostProgress::begin(const std::string& step, double expected_s) {
  done_s_ += step_s_;
  step_s_ = expected_s;
  if (quiet_) return;
  const double share = std::min(done_s_ / total_s_, 0.99);
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double left_s = share > 0.05 ? elapsed_s * (1.0 - share) / share : total_s_ - done_s_;
  if (!terminal_) {
    fmt::print(stderr, "{}: {:2.0f} %, {} left: {}\n", what_, 100.0 * share, duration_text(left_s),
               step);
    return;
  }
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(kWidth * share);
  fmt::print(stderr, "\r{} [{}{}] {:2.0f} %  {} left  {}\x1b[K", what_,
             std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(kWidth - filled), '.'), 100.0 * share,
             duration_text(left_s), step);
  std::fflush(stderr);
}

}  // namespace fanbeam::apps
