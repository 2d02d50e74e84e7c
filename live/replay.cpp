#include "live/replay.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "live/frame_maker.h"
#include "live/predictor.h"

namespace fanbeam::live {
namespace {

ChannelSettings channel_settings(const Recording& recording, const ReplaySettings& settings) {
  ChannelSettings channel{recording.flown_by.rate_Hz, 0.0, settings.begin};
  channel.keep_received = settings.keep_received;
  return channel;
}

class Replay {
 public:
  Replay(session::Session& session, const Recording& recording,
         const std::vector<const Feed*>& feeds, const Flight* flight, const Desk& desk,
         const ReplaySettings& settings, Hub& hub, const Told& told, const core::StopToken& stop)
      : recording_(recording),
        feeds_(feeds),
        flight_(flight),
        desk_(desk),
        settings_(settings),
        hub_(hub),
        told_(told),
        stop_(stop),
        predictor_(session.scene()->frame),
        lockstep_time_(1.0 / recording.flown_by.rate_Hz),
        maker_(session, hub, channel_settings(recording, settings)) {}

  void run() {
    for (const auto& event : recording_.events) {
      if (stop_.reason() != 0) return;
      std::visit([&](const auto& what) { take(what); }, event);
    }
  }

 private:
  void take(const RecordedPacket& packet) {
    if (packet.source >= feeds_.size()) return;
    auto heard = feeds_[packet.source]->heard_in(packet.bytes);
    if (!heard) return;
    if (recording_.flown_by.from.size() > 1)
      maker_.status().source = recording_.flown_by.from[packet.source];
    predictor_.take(heard->pose, packet.arrived_s, heard->clock_s, packet.source);
    heard->pose.time_s = lockstep_time_.next(heard->clock_s);
    newest_ = {heard->pose, packet.arrived_s};
  }

  void take(const RecordedControl& control) {
    try {
      desk_.control(control.path, control.body);
    } catch (const core::InputError& error) {
      std::vector<core::Problem> problems = error.problems();
      for (core::Problem& problem : problems) problem.place = {recording_.file, control.line};
      throw core::InputError(std::move(problems));
    }
  }

  void take(const RecordedFrame& frame) {
    const bool shows = settings_.lockstep || in_time(frame.tick);
    last_number_ = frame.tick.number;
    known_s_ = predictor_.newest_s();
    if (!shows) return;
    maker_.sample(frame.samples);
    const auto seen = sighting(frame.tick);
    // One that is refused leaves its number to the next, or to the picture that is shown once more.
    if (seen && !maker_.make(frame.tick, *seen, stop_) && !stands_refused(frame.tick))
      --last_number_;
    told_(maker_.status());
    hub_.tell(maker_.status());
  }

  // Waits until the frame is due. One that is due for longer than a period is left out.
  bool in_time(const Tick& tick) {
    constexpr std::chrono::milliseconds kNap(20);
    if (!first_s_) first_s_ = tick.now_s;
    const double due_s = (tick.now_s - *first_s_) / settings_.speed;
    const Clock::time_point due = settings_.begin + std::chrono::duration_cast<Clock::duration>(
                                                        std::chrono::duration<double>(due_s));
    while (stop_.reason() == 0 && Clock::now() < due) {
      std::this_thread::sleep_until(std::min(due, Clock::now() + kNap));
      if (tick.number > last_number_ + 1) grow_old();
    }
    const bool in_time = maker_.now_s() <= due_s + 1.0 / maker_.status().wanted_Hz;
    if (!in_time) ++maker_.status().late;
    return in_time && stop_.reason() == 0;
  }

  // While no pose came: the number that is left out is that of the picture that was shown once more.
  void grow_old() {
    const double now_s = *first_s_ + settings_.speed * maker_.now_s();
    if (!known_s_ || !maker_.stands(now_s - *known_s_)) return;
    told_(maker_.status());
    hub_.tell(maker_.status());
  }

  // In time, as the channel did.
  bool stands_refused(const Tick& tick) {
    return !settings_.lockstep && stop_.reason() == 0 && maker_.stands_refused(tick.now_s);
  }

  std::optional<Sighting> sighting(const Tick& tick) const {
    if (feeds_.empty()) return Sighting{(*flight_)(std::max(0.0, tick.at_s)), 0.0};
    if (recording_.flown_by.lockstep)
      return newest_ ? std::optional(Sighting{newest_->first, tick.now_s - newest_->second})
                     : std::nullopt;
    const auto pose = predictor_.at(tick.at_s);
    if (!pose) return std::nullopt;
    return Sighting{*pose, std::max(0.0, tick.now_s - *predictor_.newest_s())};
  }

  const Recording& recording_;
  const std::vector<const Feed*>& feeds_;
  const Flight* flight_;
  const Desk& desk_;
  ReplaySettings settings_;
  Hub& hub_;
  const Told& told_;
  const core::StopToken& stop_;
  Predictor predictor_;
  LockstepTime lockstep_time_;
  FrameMaker maker_;
  std::optional<std::pair<core::Pose, double>> newest_;  // and when it arrived
  std::optional<double> first_s_;
  // The number of the last frame, shown or late, and when the newest pose arrived that the last tick knew.
  std::uint64_t last_number_ = 0;
  std::optional<double> known_s_;
};

}  // namespace

void run_replay(session::Session& session, const Recording& recording,
                const std::vector<const Feed*>& feeds, const Flight* flight, const Desk& desk,
                const ReplaySettings& settings, Hub& hub, const Told& told,
                const core::StopToken& stop) {
  Replay(session, recording, feeds, flight, desk, settings, hub, told, stop).run();
}

}  // namespace fanbeam::live
