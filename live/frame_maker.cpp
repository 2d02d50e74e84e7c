#include "live/frame_maker.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/errors.h"
#include "live/processor_time.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::live {
namespace {

// A picture that is older than that is out of date.
constexpr double kStale_s = 1.0;

}  // namespace

FrameMaker::FrameMaker(session::Session& session, Hub& hub, const ChannelSettings& settings)
    : session_(session),
      hub_(hub),
      settings_(settings),
      status_(hub.status()),
      number_(settings.newest_number) {
  const std::shared_ptr<const scenes::Scene> scene = session.scene();
  status_.scene = scene->description.name;
  status_.caster = renderer::name_of(scene->caster.chosen);
  status_.wanted_Hz = settings.rate_Hz;
  status_.samples = session.samples();
}

void FrameMaker::sample(double samples) {
  if (samples == told_samples_ || !(samples > 0.0)) return;
  session_.set(session::Samples{samples});
  told_samples_ = status_.samples = samples;
}

session::Session::Moment FrameMaker::conditions(const Tick& tick) {
  std::unique_lock<std::mutex> quiet;
  if (settings_.journal != nullptr) {
    quiet = settings_.journal->quiet();
    settings_.journal->frame(tick, told_samples_);
  }
  return session_.now();
}

void FrameMaker::journal_made(bool shown) const {
  if (settings_.journal != nullptr) settings_.journal->made(shown);
}

std::shared_ptr<LiveFrame> FrameMaker::rendered(const session::Session::Moment& under,
                                                const Tick& tick, const core::Pose& pose,
                                                const core::StopToken& stop) {
  const renderer::Frame made = session_.render(under, pose, tick.number, {true, true}, stop);
  auto frame = std::make_shared<LiveFrame>();
  const auto& scene = frame->scene = session_.scene(under);
  frame->bscope = sensors::bscope_picture(scene->description.sensor, made.bscope_grey);
  frame->cscope = sensors::cscope_picture(scene->description.sensor, made.cscope_grey);
  const sensors::GreyScale grey(scene->description.sensor);
  frame->low_dB = grey.low_dB();
  frame->high_dB = grey.high_dB();
  frame->cscope_top_rad = scene->description.sensor.display.cscope_top_rad;
  if (settings_.keep_received) frame->received_W = made.received_W();
  frame->outside_volume =
      std::find(made.events.begin(), made.events.end(), "outside_volume") != made.events.end();
  return frame;
}

std::optional<FrameMaker::Made> FrameMaker::make(const Tick& tick, const Sighting& seen,
                                                 const core::StopToken& stop) {
  const Clock::time_point from = Clock::now();
  const double spent_s = processor_s();
  status_.waiting = status_.stale = false;
  status_.pose_age_ms = 1e3 * seen.age_s;
  const session::Session::Moment under = conditions(tick);
  std::shared_ptr<LiveFrame> frame;
  try {
    frame = rendered(under, tick, seen.pose, stop);
  } catch (const core::InputError& error) {
    journal_made(true);
    ++status_.refused;
    status_.refusal = core::to_string(error.problems().front());
    look_back();
    return std::nullopt;
  } catch (const core::Stopped&) {
    journal_made(false);
    return std::nullopt;
  }
  journal_made(true);
  const double frame_s = seconds_between(from, Clock::now());
  ++status_.frames;
  frame->number = number_ = tick.number;
  shown_s_ = tick.now_s;
  frame->pose = seen.pose;
  frame->under = under;
  frame->samples = status_.samples;
  frame->errors = status_.errors;
  frame->frame_ms = 1e3 * frame_s;
  frame->pose_age_ms = status_.pose_age_ms;
  frame->began_s = std::chrono::duration<double>(from.time_since_epoch()).count();
  tell(frame_s, processor_s() - spent_s);
  const bool outside = frame->outside_volume;
  if (settings_.dress) settings_.dress(*frame);
  hub_.publish(std::move(frame));
  return Made{frame_s, outside};
}

bool FrameMaker::stands(double age_s) {
  status_.stale = age_s > kStale_s;
  if (!status_.stale) return false;
  status_.pose_age_ms = 1e3 * age_s;
  show_stale(status_.pose_age_ms);
  look_back();
  return true;
}

bool FrameMaker::stands_refused(double now_s) {
  const std::shared_ptr<const LiveFrame> newest = hub_.newest();
  const double since_s = now_s - shown_s_;
  status_.stale = newest && since_s > kStale_s;
  return status_.stale && show_stale(newest->pose_age_ms + 1e3 * since_s);
}

bool FrameMaker::show_stale(double pose_age_ms) {
  const std::shared_ptr<const LiveFrame> newest = hub_.newest();
  if (!newest || newest->stale) return false;
  auto frame = std::make_shared<LiveFrame>(*newest);
  frame->number = ++number_;
  frame->stale = true;
  frame->pose_age_ms = pose_age_ms;
  hub_.publish(std::move(frame));
  return true;
}

double FrameMaker::processor_s() const {
  const double beside_s = settings_.beside_s ? settings_.beside_s() : 0.0;
  return processor_time_s(CLOCK_PROCESS_CPUTIME_ID) - beside_s;
}

void FrameMaker::tell(double frame_s, double processor_s) {
  status_.frame_ms = 1e3 * frame_s;
  status_.processor_ms = 1e3 * processor_s;
  if (processor_s * settings_.rate_Hz > std::max(1U, settings_.threads))
    ++status_.late_by_processor;
  recent_.emplace_back(now_s(), status_.frame_ms);
  look_back();
}

void FrameMaker::look_back() {
  constexpr double kLook_s = 2.0;
  const double now_s = this->now_s();
  while (!recent_.empty() && recent_.front().first < now_s - kLook_s) recent_.pop_front();
  status_.slowest_ms = 0.0;
  for (const auto& [end_s, frame_ms] : recent_)
    status_.slowest_ms = std::max(status_.slowest_ms, frame_ms);
  const double span_s = recent_.empty() ? 0.0 : now_s - recent_.front().first;
  status_.rate_Hz = span_s > 0.0 ? static_cast<double>(recent_.size() - 1) / span_s : 0.0;
}

}  // namespace fanbeam::live
