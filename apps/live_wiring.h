// What the options of fanbeam live say, together.
#pragma once

#include "apps/live_command.h"
#include "apps/live_sinks.h"
#include "apps/live_sources.h"

namespace fanbeam::apps {

struct Wiring {
  std::vector<PosesFrom> from;

  const PosesFrom& first() const { return from.front(); }
  FramesTo to;
  live::Endpoint page;
  live::Access access;  // to the page
};

// Throws InputError with all that is wrong.
Wiring wiring_of(const LiveOptions& options);

}  // namespace fanbeam::apps
