#include "core/stop.h"

namespace fanbeam::core {
namespace {

thread_local const StopToken* innermost = nullptr;

}  // namespace

StopScope::StopScope(const StopToken& token) noexcept : before_(innermost) { innermost = &token; }

StopScope::~StopScope() { innermost = before_; }

StopToken StopScope::current() { return innermost != nullptr ? *innermost : StopToken(); }

void throw_if_stopped() {
  if (innermost != nullptr && innermost->reason() != 0) throw Stopped();
}

}  // namespace fanbeam::core
