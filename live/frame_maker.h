// One live frame: from where the aircraft is to what the hub shows, and what is said of it.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

#include "core/stop.h"
#include "live/hub.h"
#include "live/journal.h"
#include "live/pose_source.h"
#include "session/session.h"

namespace fanbeam::live {

struct ChannelSettings {
  double rate_Hz = 16.0;
  double samples = 0.0;  // 0: as the rate allows; in lockstep the scene's own
  Clock::time_point begin = Clock::now();
  Journal* journal = nullptr;
  unsigned threads = std::thread::hardware_concurrency();  // that frames may take
  // In lockstep: before the frame of a letter of the mailbox; none: nothing.
  std::function<void(std::uint64_t number)> before_letter{};
  // What is done to a frame before it is shown; none: nothing.
  std::function<void(LiveFrame&)> dress{};
  bool keep_received = false;  // LiveFrame::received_W
  // Processor time that this process spent on other things than frames, s; none: it does not.
  std::function<double()> beside_s{};
  std::uint64_t newest_number = 0;  // that was shown before; those to come go on from it
};

class FrameMaker {
 public:
  struct Made {
    double frame_s = 0.0;         // that it took by the clock
    bool outside_volume = false;  // by a plan of its own
  };

  // All must outlive it.
  FrameMaker(session::Session& session, Hub& hub, const ChannelSettings& settings);

  // Of the frames to come. 0 leaves it: the scene's own, until it was told otherwise.
  void sample(double samples);
  // Publishes frame tick.number; nothing where its pose was refused, which is counted, or where
  // `stop` asked.
  std::optional<Made> make(const Tick& tick, const Sighting& seen, const core::StopToken& stop);

  // Whether the newest pose, which is so old, is out of date. At the first time that it is, the newest frame is
  // shown once more as such.
  bool stands(double age_s);
  // Behind a pose that was refused, at tick.now_s: where no other could be rendered for a second, the newest frame
  // is as out of date. Gives whether it was shown once more just now.
  bool stands_refused(double now_s);

  Status& status() { return status_; }
  double now_s() const { return seconds_between(settings_.begin, Clock::now()); }
  std::uint64_t next_number() const { return number_ + 1; }

 private:
  // What the frame is made under, once the journal knows of it.
  session::Session::Moment conditions(const Tick& tick);
  void journal_made(bool shown) const;
  // Its pictures; throws what Session::render throws.
  std::shared_ptr<LiveFrame> rendered(const session::Session::Moment& under, const Tick& tick,
                                      const core::Pose& pose, const core::StopToken& stop);
  // Unless it is shown so already, or there is none.
  bool show_stale(double pose_age_ms);
  // Of the last two seconds up to now.
  void look_back();
  // Spent on frames so far.
  double processor_s() const;
  void tell(double frame_s, double processor_s);

  session::Session& session_;
  Hub& hub_;
  ChannelSettings settings_;
  Status status_;
  std::uint64_t number_ = 0;   // of the newest frame that was shown, also once more as a stale one
  double shown_s_ = 0.0;       // tick.now_s of the newest one that was rendered
  double told_samples_ = 0.0;  // 0: none
  std::deque<std::pair<double, double>> recent_;  // of two seconds: end, milliseconds taken
};

}  // namespace fanbeam::live
