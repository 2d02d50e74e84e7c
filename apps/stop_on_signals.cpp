#include "apps/stop_on_signals.h"

#include <csignal>
#include <cstdio>

#include "core/stop.h"

namespace fanbeam::apps {
namespace {

core::StopSource& source() {
  static core::StopSource source;
  return source;
}

extern "C" void stop_on_signal(int signal) { source().request(signal); }

void handle(int signal) {
  struct sigaction before {};
  sigaction(signal, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = stop_on_signal;
  sigemptyset(&action.sa_mask);
  // Restarted calls: a write that is interrupted would look like a full disk.
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}

void release(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  if (now.sa_handler == stop_on_signal) std::signal(signal, SIG_DFL);
}

}  // namespace

StopOnSignals::StopOnSignals() : token_(source().token()), scope_(token_) {
  handle(SIGINT);
  handle(SIGTERM);
}

StopOnSignals::~StopOnSignals() {
  release(SIGINT);
  release(SIGTERM);
}

int end_by_stop_signal() {
  const int signal = source().token().reason();
  std::fflush(nullptr);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return 128 + signal;
}

}  // namespace fanbeam::apps
