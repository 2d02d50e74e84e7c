#include "live/pace.h"

#include <algorithm>

namespace fanbeam::live {

double Pace::after(double now_s, double frame_s) {
  const double most_s = kShare * period_s_;
  taken_.push_back({now_s, frame_s});
  while (taken_.front().at_s < now_s - kLook_s) taken_.pop_front();
  if (frame_s > most_s && step_ > 0) {
    refused_step_ = step_;
    refused_until_s_ = now_s + kPatience_s;
    go_to(step_ - 1);
    return samples();
  }
  if (now_s - taken_.front().at_s <= 0.9 * kLook_s) return samples();
  const double slowest_s =
      std::max_element(taken_.begin(), taken_.end(), [](const Taken& a, const Taken& b) {
        return a.frame_s < b.frame_s;
      })->frame_s;
  const std::size_t end =
      now_s < refused_until_s_ ? std::min(refused_step_, ladder_.size()) : ladder_.size();
  std::size_t step = step_;
  while (step + 1 < end && slowest_s * ladder_[step + 1] / ladder_[step_] <= most_s) ++step;
  if (step != step_) go_to(step);
  return samples();
}

}  // namespace fanbeam::live
