#include "apps/live_status_line.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>

namespace fanbeam::apps {
namespace {

// Empty while simulator and scene agree on the ground.
std::string offset_text(const live::Status& status) {
  if (!live::is_lasting_offset(status)) return {};
  return fmt::format("  heights {:+.0f} m off: is its datum right?", -*status.height_offset_m);
}

std::string error_text(const live::Status& status) {
  if (!status.errors) return {};
  return fmt::format(" ({:.1f}, {:.1f} grey)", status.errors->bscope_grey,
                     status.errors->cscope_grey);
}

// A terminal that takes some of a line waits with the rest. Opened anew, as the flags of what is open are also
// those of whoever else has it; -1 for what is none, or may not be opened.
int terminal_without_waiting(int descriptor) {
  if (isatty(descriptor) != 1) return -1;
  return ::open(fmt::format("/proc/self/fd/{}", descriptor).c_str(),
                O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

}  // namespace

void tell_without_waiting(int descriptor, std::string_view text) {
  const int own = terminal_without_waiting(descriptor);
  const int to = own >= 0 ? own : descriptor;
  constexpr std::size_t kPart_bytes = 256;  // a pipe or socket that is ready takes so many at once
  while (!text.empty()) {
    pollfd ready{to, POLLOUT, 0};
    if (::poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0) break;
    const ssize_t count = ::write(to, text.data(), std::min(text.size(), kPart_bytes));
    if (count <= 0) break;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  if (own >= 0) ::close(own);
}

StatusLine::StatusLine(bool quiet) : quiet_(quiet), shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  if (shown_) tell_without_waiting(STDERR_FILENO, "\n");
}

void StatusLine::complain(const live::Status& status) {
  std::uint64_t faults = status.refused;
  for (const auto& [reason, count] : status.bad_packets) faults += count;
  if (quiet_ || (faults == told_ && status.weather_refusal == told_weather_)) return;
  const auto now = live::Clock::now();
  if (now - complained_ < std::chrono::seconds(1)) return;
  complained_ = now;
  std::string text;
  for (const auto& [reason, count] : status.bad_packets)
    text += fmt::format("{}{} ({})", text.empty() ? "packets of no use: " : ", ", count, reason);
  if (status.refused > 0)
    text += fmt::format("{}{} poses refused ({})", text.empty() ? "" : "; ", status.refused,
                        status.refusal);
  if (!status.weather_refusal.empty())
    text += (text.empty() ? "" : "; ") + ("weather refused: " + status.weather_refusal);
  if (!text.empty())
    tell_without_waiting(STDERR_FILENO, fmt::format("{}{}\n", shown_ ? "\r\033[K" : "", text));
  told_ = faults;
  told_weather_ = status.weather_refusal;
}

void StatusLine::show(const live::Status& status, int viewers) {
  complain(status);
  const auto now = live::Clock::now();
  if (!shown_ || now - last_ < std::chrono::milliseconds(500)) return;
  last_ = now;
  tell_without_waiting(
      STDERR_FILENO,
      status.waiting
          ? fmt::format("\r\033[Kwaiting for a pose from {}", status.source)
          : fmt::format(
                "\r\033[K{:.1f} Hz  frame {:.0f} ms  sampling {}{}  pose age {:.0f} ms{}  late {}  "
                "{} watching{}",
                status.rate_Hz, status.frame_ms,
                status.samples > 0.0 ? fmt::format("{:g}", status.samples) : "by accuracy",
                error_text(status), status.pose_age_ms, status.stale ? " (stale)" : "", status.late,
                viewers, offset_text(status)));
}

void print_address(const std::string& scene, const std::string& address, std::uint16_t port,
                   std::FILE* to) {
  const bool six = address.find(':') != std::string::npos;
  const std::string text = fmt::format("{}: look at http://{}:{}/ (Ctrl-C ends)\n", scene,
                                       six ? "[" + address + "]" : address, port);
  if (to == stderr) return tell_without_waiting(STDERR_FILENO, text);
  fmt::print(to, "{}", text);
  std::fflush(to);
}

}  // namespace fanbeam::apps
