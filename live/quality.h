// How far live pictures are from the converged one: the error that the sampling of now has, estimated
// beside the frames and told with them.
//
// Every few seconds, and as soon as there is one of a sampling that has no figure yet, the newest frame is rendered
// once more, by its own plan outside the planned volume too, with an estimate of its error
// (renderer/accuracy/error_estimate.h: it lies within a factor of 1.5 of the true one in nineteen of
// twenty frames), by one thread of the lowest priority. The figure is of the expected picture's B-scope and C-scope, in
// grey levels RMS; speckle, which a radar's own pictures have too, is not in it. Each sampling keeps its last figure:
// back on that step of the ladder it is told at once, though of another place and perhaps other conditions.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "core/stop.h"
#include "live/hub.h"
#include "session/session.h"

namespace fanbeam::live {

class Quality {
 public:
  // Looks at a frame `every_s`, the first as soon as there is one. Both must outlive it.
  Quality(const session::Session& session, const Hub& hub, double every_s = 5.0);
  ~Quality();
  Quality(const Quality&) = delete;
  Quality& operator=(const Quality&) = delete;

  // The last figures of this sampling; none where there are none yet.
  void tell(Status& status) const;
  // Processor time that it took so far.
  double processor_s();

 private:
  void run(double every_s);
  // False while there is no frame to look at.
  bool look();
  renderer::Frame estimated(const LiveFrame& frame) const;
  bool is_new() const;  // the newest frame's sampling

  const session::Session& session_;
  const Hub& hub_;
  core::StopSource stop_;
  mutable std::mutex mutex_;
  std::condition_variable leave_;
  std::map<double, PictureErrors> errors_{};  // by samples
  std::thread thread_;
};

}  // namespace fanbeam::live
