#include "core/stop.h"

namespace fanbeam::core {
namespace {

thread_local const StopToken* watched = nullptr;

}  // namespace

StopScope::StopScope(const StopToken& token) noexcept : before_(watched) { watched = &token; }

StopScope::~StopScope() { watched = before_; }

StopToken StopScope::current() { return watched != nullptr ? *watched : StopToken(); }

void throw_if_stopped() {
  if (watched != nullptr && watched->reason() != 0) throw Stopped();
}

}  // namespace fanbeam::core
