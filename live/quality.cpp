#include "live/quality.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "core/parallel.h"
#include "live/processor_time.h"
#include "renderer/plan/effects.h"
#include "scenes/frame_plan.h"

namespace fanbeam::live {

Quality::Quality(const session::Session& session, const Hub& hub, double every_s)
    : session_(session), hub_(hub), thread_([this, every_s] { run(every_s); }) {}

Quality::~Quality() {
  stop_.request();
  {
    const std::lock_guard<std::mutex> lock(
        mutex_);  // it is waiting, or will see that it is to stop
    leave_.notify_all();
  }
  thread_.join();
}

void Quality::tell(Status& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = errors_.find(status.samples);
  status.errors = known == errors_.end() ? std::nullopt : std::optional(known->second);
}

double Quality::processor_s() {
  clockid_t clock{};
  ::pthread_getcpuclockid(thread_.native_handle(), &clock);  // there until the thread is joined
  return processor_time_s(clock);
}

void Quality::run(double every_s) {
  constexpr double kAgain_s = 0.2;
  // On Linux the priority is that of this thread alone.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 19);
  const core::ThreadLimit alone(1);
  const core::StopToken stop = stop_.token();
  const core::StopScope scope(stop);
  while (stop.reason() == 0) {
    const double wait_s = look() ? every_s : kAgain_s, step_s = std::min(wait_s, kAgain_s);
    std::unique_lock<std::mutex> lock(mutex_);
    double waited_s = 0.0;
    do {
      leave_.wait_for(lock, std::chrono::duration<double>(step_s),
                      [&] { return stop.reason() != 0; });
      waited_s += step_s;
    } while (stop.reason() == 0 && waited_s < wait_s && !is_new());
  }
}

bool Quality::is_new() const {
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  return frame && errors_.count(frame->samples) == 0;
}

renderer::Frame Quality::estimated(const LiveFrame& frame) const {
  const std::shared_ptr<const scenes::Scene> scene = session_.scene(frame.under);
  const renderer::FramePose pose = scene->pose_at(frame.pose);
  renderer::Sampling sampling = session_.sampling(frame.under);
  sampling.estimate_error = true;
  const auto render = [&](const renderer::World& world, const core::EffectPlan& plan) {
    return renderer::render_frame(
        world, sampling, {true, true},
        renderer::without_draws(renderer::effects_of(plan, session_.seed())), pose);
  };
  if (!frame.outside_volume) return render(scene->world, scene->plan);
  const core::EffectPlan plan = scenes::plan_alone(*scene, pose);
  return render(scenes::world_for(*scene, plan), plan);
}

bool Quality::look() {
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  if (!frame || !frame->under) return false;
  try {
    const renderer::Frame made = estimated(*frame);
    if (!made.error) return false;
    const std::lock_guard<std::mutex> lock(mutex_);
    errors_[frame->samples] = {made.error->rms_grey, made.error->cscope_rms_grey};
    return true;
  } catch (const std::exception&) {
    return false;  // a pose that nothing can be rendered at, no memory, the end: the frames go on
  }
}

}  // namespace fanbeam::live
