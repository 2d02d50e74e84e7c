#include "live/frame_maker.h"

#include <algorithm>
#include <mutex>

#include "core/errors.h"
#include "sensors/display/display.h"

namespace fanbeam::live {

FrameMaker::FrameMaker(session::Session& session, Hub& hub, double wanted_Hz,
                       Clock::time_point begin, Journal* journal)
    : session_(session), hub_(hub), begin_(begin), journal_(journal), status_(hub.status()) {
  const std::shared_ptr<const scenes::Scene> scene = session.scene();
  status_.scene = scene->description.name;
  status_.caster = renderer::name_of(scene->caster.chosen);
  status_.wanted_Hz = wanted_Hz;
  const double own = scene->description.rays_per_cell;
  status_.samples = own > 0.0 ? own : renderer::default_samples(scene->caster.chosen);
}

void FrameMaker::sample(double samples) {
  if (samples == told_samples_ || !(samples > 0.0)) return;
  session_.set(session::Samples{samples});
  told_samples_ = status_.samples = samples;
}

session::Session::Moment FrameMaker::conditions(const Tick& tick) {
  std::unique_lock<std::mutex> quiet;
  if (journal_ != nullptr) {
    quiet = journal_->quiet();
    journal_->frame(tick, told_samples_);
  }
  return session_.now();
}

std::shared_ptr<LiveFrame> FrameMaker::rendered(const session::Session::Moment& under,
                                                const Tick& tick, const core::Pose& pose,
                                                const core::StopToken& stop) {
  const renderer::Frame made = session_.render(under, pose, tick.number, {true, true}, stop);
  const std::shared_ptr<const scenes::Scene> scene = session_.scene(under);
  auto frame = std::make_shared<LiveFrame>();
  frame->bscope = sensors::bscope_picture(scene->description.sensor, made.bscope_grey);
  frame->cscope = sensors::cscope_picture(scene->description.sensor, made.cscope_grey);
  frame->outside_volume =
      std::find(made.events.begin(), made.events.end(), "outside_volume") != made.events.end();
  return frame;
}

std::optional<FrameMaker::Made> FrameMaker::make(const Tick& tick, const Sighting& seen,
                                                 const core::StopToken& stop) {
  const Clock::time_point from = Clock::now();
  status_.waiting = false;
  status_.pose_age_ms = 1e3 * seen.age_s;
  const session::Session::Moment under = conditions(tick);
  std::shared_ptr<LiveFrame> frame;
  try {
    frame = rendered(under, tick, seen.pose, stop);
  } catch (const core::InputError& error) {
    ++status_.refused;
    status_.refusal = core::to_string(error.problems().front());
    return std::nullopt;
  } catch (const core::Stopped&) {
    return std::nullopt;
  }
  const double frame_s = seconds_between(from, Clock::now());
  frame->number = status_.frames = tick.number;
  frame->pose = seen.pose;
  frame->under = under;
  frame->samples = status_.samples;
  frame->errors = status_.errors;
  frame->frame_ms = 1e3 * frame_s;
  frame->pose_age_ms = status_.pose_age_ms;
  tell(frame_s);
  const bool outside = frame->outside_volume;
  hub_.publish(std::move(frame));
  return Made{frame_s, outside};
}

void FrameMaker::tell(double frame_s) {
  constexpr double kLook_s = 2.0;
  status_.frame_ms = 1e3 * frame_s;
  recent_.emplace_back(now_s(), status_.frame_ms);
  while (recent_.front().first < recent_.back().first - kLook_s) recent_.pop_front();
  status_.slowest_ms = 0.0;
  for (const auto& [end_s, frame_ms] : recent_)
    status_.slowest_ms = std::max(status_.slowest_ms, frame_ms);
  const double span_s = recent_.back().first - recent_.front().first;
  status_.rate_Hz = span_s > 0.0 ? static_cast<double>(recent_.size() - 1) / span_s : 0.0;
}

}  // namespace fanbeam::live
