// A recorded channel flown again: the same packets, ticks, samplings and controls, and so the same
// bytes, as long as scene, options and program are the same.
#pragma once

#include <vector>

#include "live/channel.h"
#include "live/desk.h"
#include "live/feed.h"
#include "live/recording.h"

namespace fanbeam::live {

struct ReplaySettings {
  double speed = 1.0;  // times that of the recording
  // Every frame, as fast as they are made; else frames that are late are left out, and pictures become stale as
  // they did.
  bool lockstep = false;
  Clock::time_point begin = Clock::now();
  bool keep_received = false;  // LiveFrame::received_W
};

// `feeds` decode the packets of a recording that has some, each those of its source (their mailbox is not
// used); `flight` is that of one without, else null. Controls go through `desk`; one that it refuses (of another scene)
// is thrown as InputError with its line in the recording. Ends with the recording.
void run_replay(session::Session& session, const Recording& recording,
                const std::vector<const Feed*>& feeds, const Flight* flight, const Desk& desk,
                const ReplaySettings& settings, Hub& hub, const Told& told,
                const core::StopToken& stop);

}  // namespace fanbeam::live
