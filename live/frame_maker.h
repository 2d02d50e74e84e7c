// One live frame: from where the aircraft is to what the hub shows, and what is said of it.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "core/stop.h"
#include "live/hub.h"
#include "live/journal.h"
#include "live/pose_source.h"
#include "session/session.h"

namespace fanbeam::live {

class FrameMaker {
 public:
  struct Made {
    double frame_s = 0.0;         // that it took
    bool outside_volume = false;  // by a plan of its own
  };

  // `journal` may be null. All must outlive it.
  FrameMaker(session::Session& session, Hub& hub, double wanted_Hz, Clock::time_point begin,
             Journal* journal);

  // Of the frames to come. 0 leaves it: the scene's own, until it was told otherwise.
  void sample(double samples);
  // Publishes frame tick.number; nothing where its pose was refused, which is counted, or where
  // `stop` asked.
  std::optional<Made> make(const Tick& tick, const Sighting& seen, const core::StopToken& stop);

  Status& status() { return status_; }
  double now_s() const { return seconds_between(begin_, Clock::now()); }
  std::uint64_t next_number() const { return status_.frames + 1; }

 private:
  // What the frame is made under, once that is in the journal.
  session::Session::Moment conditions(const Tick& tick);
  // Its pictures; throws what Session::render throws.
  std::shared_ptr<LiveFrame> rendered(const session::Session::Moment& under, const Tick& tick,
                                      const core::Pose& pose, const core::StopToken& stop);
  void tell(double frame_s);

  session::Session& session_;
  Hub& hub_;
  Clock::time_point begin_;
  Journal* journal_;
  Status status_;
  double told_samples_ = 0.0;                     // 0: none
  std::deque<std::pair<double, double>> recent_;  // of two seconds: end, milliseconds taken
};

}  // namespace fanbeam::live
