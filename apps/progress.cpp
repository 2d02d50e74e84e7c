#include "apps/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace fanbeam::apps {
namespace {

// "0:45", "3:10".
std::string minutes_text(double seconds) {
  const auto whole = std::lround(std::min(seconds, 359999.0));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

std::string duration_text(double seconds) {
  return seconds < 90.0 ? fmt::format("{:.0f} s", std::max(1.0, seconds))
                        : fmt::format("{:.0f} min", std::ceil(seconds / 60.0));
}

ProgressLine::ProgressLine(std::string what, bool quiet)
    : what_(std::move(what)), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (!quiet_ && terminal_) std::fputs("\n", stderr);
}

double ProgressLine::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void ProgressLine::draw_bar(int filled, const std::string& text) const {
  fmt::print(stderr, "\r{} [{}{}] {}", what_, std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(kWidth - filled), '.'), text);
  std::fflush(stderr);
}

void ProgressLine::print_line(const std::string& text) const {
  fmt::print(stderr, "{}: {}\n", what_, text);
}

Progress::Progress(std::string what, int total, bool quiet, std::string things)
    : ProgressLine(std::move(what), quiet), things_(std::move(things)), total_(total) {}

void Progress::step(int done) {
  if (quiet() || total_ <= 0) return;
  const double now_s = elapsed_s();
  const double rate = done / std::max(now_s, 1e-9);
  const double left_s = done > 0 ? (total_ - done) / rate : 0.0;
  if (terminal()) {
    if (done < total_ && now_s - last_drawn_s_ < 0.1) return;
    last_drawn_s_ = now_s;
    draw_bar(static_cast<int>(static_cast<long>(kWidth) * done / total_),
             fmt::format("{}/{} {}  {:.1f} {}/s  {} left ", done, total_, things_, rate, things_,
                         minutes_text(left_s)));
  } else if (100 * done >= next_line_percent_ * total_) {
    next_line_percent_ = 100 * done / total_ / 10 * 10 + 10;
    print_line(fmt::format("{} of {} {}, {:.1f} {}/s, {} left", done, total_, things_, rate,
                           things_, minutes_text(left_s)));
  }
}

std::function<void(int, int)> frames_progress(std::optional<Progress>& bar, std::string what,
                                              bool quiet) {
  return [&bar, what = std::move(what), quiet](int done, int total) {
    if (done == 0)
      bar.emplace(what, total, quiet);
    else
      bar->step(done);
  };
}

CostProgress::CostProgress(std::string what, double total_s, bool quiet)
    : ProgressLine(std::move(what), quiet), total_s_(std::max(total_s, 1e-3)) {}

void CostProgress::begin(const std::string& step, double expected_s) {
  done_s_ += step_s_;
  step_s_ = expected_s;
  if (quiet()) return;
  const double share = std::min(done_s_ / total_s_, 0.99);
  const double left_s = share > 0.05 ? elapsed_s() * (1.0 - share) / share : total_s_ - done_s_;
  if (terminal())
    draw_bar(
        static_cast<int>(kWidth * share),
        fmt::format("{:2.0f} %  {} left  {}\x1b[K", 100.0 * share, duration_text(left_s), step));
  else
    print_line(fmt::format("{:2.0f} %, {} left: {}", 100.0 * share, duration_text(left_s), step));
}

}  // namespace fanbeam::apps
