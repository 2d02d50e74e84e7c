// The radar channel: a frame at every tick of the sensor's rate, or for every pose, for as long as
// nobody asks to stop.
#pragma once

#include <functional>

#include "core/stop.h"
#include "live/frame_maker.h"
#include "session/session.h"

namespace fanbeam::live {

// Called after each frame, and some times a second while there are none; it may fill in what the
// source knows.
using Told = std::function<void(Status&)>;

// Frames of `session` into `hub`. A frame that takes longer than a period is late, never torn and
// never queued: the ticks that it ran over are left out. Its sampling follows live/pace.h unless it is
// told. Poses that nothing can be rendered at are counted. Throws what `journal` throws.
void run_channel(session::Session& session, const PoseSource& source,
                 const ChannelSettings& settings, Hub& hub, const Told& told,
                 const core::StopToken& stop);

// Lockstep: a frame for each pose as it was received, none carried on, none left out as long as no
// more than Mailbox::kKeptInLockstep wait; those beyond are counted as late. Sampling stays as it is
// told. So the bytes depend on the poses, their order and the conditions alone.
void run_lockstep(session::Session& session, const Mailbox& mailbox,
                  const ChannelSettings& settings, Hub& hub, const Told& told,
                  const core::StopToken& stop);
// The same of a flight: at each tick of the rate, without waiting for it.
void run_lockstep(session::Session& session, const Flight& flight, const ChannelSettings& settings,
                  Hub& hub, const Told& told, const core::StopToken& stop);

}  // namespace fanbeam::live
