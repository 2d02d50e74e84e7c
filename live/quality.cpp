#include "live/quality.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>

#include "core/errors.h"
#include "core/parallel.h"
#include "live/processor_time.h"
#include "renderer/plan/effects.h"

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
  status.errors.reset();
  if (samples_ > 0.0 && samples_ == status.samples) status.errors = errors_;
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
    const double wait_s = look() ? every_s : kAgain_s;
    std::unique_lock<std::mutex> lock(mutex_);
    leave_.wait_for(lock, std::chrono::duration<double>(wait_s),
                    [&] { return stop.reason() != 0; });
  }
}

bool Quality::look() {
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  if (!frame || !frame->under || frame->outside_volume) return false;
  try {
    const std::shared_ptr<const scenes::Scene> scene = session_.scene(frame->under);
    renderer::Sampling sampling = session_.sampling(frame->under);
    sampling.estimate_error = true;
    const renderer::Effects effects =
        renderer::without_draws(renderer::effects_of(scene->plan, session_.seed()));
    const renderer::Frame made = renderer::render_frame(scene->world, sampling, {true, true},
                                                        effects, scene->pose_at(frame->pose));
    if (!made.error) return false;
    const std::lock_guard<std::mutex> lock(mutex_);
    samples_ = frame->samples;
    errors_ = {made.error->rms_grey, made.error->cscope_rms_grey};
    return true;
  } catch (const core::InputError&) {
    return false;  // a pose that nothing can be rendered at
  } catch (const core::Stopped&) {
    return false;
  }
}

}  // namespace fanbeam::live
