#include "live/channel.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "live/pace.h"
#include "live/source_clock.h"
#include "renderer/accuracy/sampling_ladder.h"

namespace fanbeam::live {
namespace {

// Wakes often enough to see that it is to stop.
void sleep_until(Clock::time_point when, const core::StopToken& stop) {
  constexpr std::chrono::milliseconds kNap(20);
  while (stop.reason() == 0 && Clock::now() < when)
    std::this_thread::sleep_until(std::min(when, Clock::now() + kNap));
}

class Channel {
 public:
  Channel(session::Session& session, const PoseSource& source, const ChannelSettings& settings,
          Hub& hub)
      : source_(source),
        settings_(settings),
        period_s_(1.0 / settings.rate_Hz),
        pace_(renderer::sampling_ladder(session.scene()->caster.chosen), period_s_),
        maker_(session, hub, settings),
        hub_(hub) {
    maker_.sample(settings.samples > 0.0 ? settings.samples : pace_.samples());
  }

  void run(const Told& told, const core::StopToken& stop) {
    Status& status = maker_.status();
    for (std::uint64_t tick = 0; stop.reason() == 0; ++tick) {
      const double due_s = static_cast<double>(tick) * period_s_;
      sleep_until(settings_.begin + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(due_s)),
                  stop);
      if (stop.reason() != 0) return;
      one_frame(stop);
      told(status);
      hub_.tell(status);
      // The first tick that is still ahead.
      const auto next =
          static_cast<std::uint64_t>(std::max(0.0, std::floor(maker_.now_s() / period_s_)));
      if (next > tick) {
        if (!status.waiting) status.late += next - tick;
        tick = next;
      }
    }
  }

 private:
  void one_frame(const core::StopToken& stop) {
    Status& status = maker_.status();
    const double now_s = maker_.now_s();
    const Tick tick{maker_.next_number(), now_s, now_s + period_s_ / 2};
    const std::optional<Sighting> seen = source_(tick.now_s, tick.at_s);
    status.waiting = !seen;
    if (!seen) return;
    status.stray_poses = seen->strays;
    if (maker_.stands(seen->age_s)) return;
    const auto made = maker_.make(tick, *seen, stop);
    if (!made && stop.reason() == 0) maker_.stands_refused(tick.now_s);
    if (made && !(settings_.samples > 0.0))
      maker_.sample(pace_.after(maker_.now_s(), made->frame_s, made->outside_volume));
  }

  const PoseSource& source_;
  ChannelSettings settings_;
  double period_s_;
  PaceByVolume pace_;
  FrameMaker maker_;
  Hub& hub_;
};

}  // namespace

void run_channel(session::Session& session, const PoseSource& source,
                 const ChannelSettings& settings, Hub& hub, const Told& told,
                 const core::StopToken& stop) {
  Channel(session, source, settings, hub).run(told, stop);
}

void run_lockstep(session::Session& session, const Mailbox& mailbox,
                  const ChannelSettings& settings, Hub& hub, const Told& told,
                  const core::StopToken& stop) {
  constexpr std::chrono::milliseconds kNap(100);
  FrameMaker maker(session, hub, settings);
  maker.sample(settings.samples);
  const auto tell = [&] {
    told(maker.status());
    hub.tell(maker.status());
  };
  LockstepTime time(1.0 / settings.rate_Hz);
  for (std::uint64_t taken = 0; stop.reason() == 0;) {
    const std::vector<Mailbox::Letter> letters = mailbox.wait_after(taken, kNap);
    if (letters.empty()) tell();
    for (const Mailbox::Letter& letter : letters) {
      if (stop.reason() != 0) return;
      maker.status().late += letter.number - taken - 1;
      taken = letter.number;
      const double arrived_s = seconds_between(settings.begin, letter.arrived);
      if (settings.journal != nullptr) settings.journal->packet(arrived_s, letter.packet);
      if (settings.before_letter) settings.before_letter(letter.number);
      const double now_s = maker.now_s();
      core::Pose pose = letter.pose;
      pose.time_s = time.next(letter.clock_s);
      maker.make({maker.next_number(), now_s, now_s}, {pose, now_s - arrived_s}, stop);
      tell();
    }
  }
}

void run_lockstep(session::Session& session, const Flight& flight, const ChannelSettings& settings,
                  Hub& hub, const Told& told, const core::StopToken& stop) {
  FrameMaker maker(session, hub, settings);
  maker.sample(settings.samples);
  for (std::uint64_t number = 0; stop.reason() == 0; ++number) {
    const double at_s = (static_cast<double>(number) + 0.5) / settings.rate_Hz;
    maker.make({maker.next_number(), at_s, at_s}, {flight(at_s), 0.0}, stop);
    told(maker.status());
    hub.tell(maker.status());
  }
}

}  // namespace fanbeam::live
