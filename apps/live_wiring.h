// What the options of fanbeam live say, together.
#pragma once

#include "apps/live_command.h"
#include "live/wiring/sinks.h"
#include "live/wiring/sources.h"

namespace fanbeam::apps {

struct Wiring {
  std::vector<live::PosesFrom> from;

  const live::PosesFrom& first() const { return from.front(); }
  live::FramesTo to;
  live::Endpoint page;
  live::Access access;  // to the page
};

// Throws InputError with all that is wrong.
Wiring wiring_of(const LiveOptions& options);

}  // namespace fanbeam::apps
