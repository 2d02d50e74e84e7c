#include "live/pace.h"

#include <algorithm>

namespace fanbeam::live {
namespace {

constexpr std::size_t kFrames = 100;
constexpr double kMostPeriods = 2.0;
constexpr double kRoom = 0.9;    // of its share, that a finer step may be expected to take
constexpr double kFewest = 4.0;  // frames to look at, however slow the rate

double effort_of(double samples) { return samples + 0.5; }

}  // namespace

// A fast rate has more than a hundred in the time that is looked at, a slow one fewer.
void Pace::keep(const Taken& frame) {
  taken_.push_back(frame);
  while (taken_.size() > kFrames && taken_.front().at_s < frame.at_s - look_s()) taken_.pop_front();
}

bool Pace::too_slow() const {
  const auto last = static_cast<std::ptrdiff_t>(std::min(taken_.size(), kFrames));
  const auto over = [&](double limit_s) {
    return std::count_if(taken_.end() - last, taken_.end(),
                         [&](const Taken& taken) { return taken.frame_s > limit_s; });
  };
  return over(kShare * period_s_) > 1 || over(kMostPeriods * period_s_) > 0;
}

double Pace::look_s() const { return std::max(kLook_s, kFewest * period_s_); }

double Pace::usual_s(double now_s) const {
  if (now_s - taken_.front().at_s <= 0.9 * look_s()) return 0.0;
  double slowest_s = 0.0, next_s = 0.0;
  for (const Taken& taken : taken_) {
    if (taken.at_s < now_s - look_s()) continue;
    next_s = std::max(next_s, std::min(slowest_s, taken.frame_s));
    slowest_s = std::max(slowest_s, taken.frame_s);
  }
  return next_s;
}

double Pace::after(double now_s, double frame_s) {
  keep({now_s, frame_s});
  if (too_slow()) {
    if (step_ == 0) return samples();
    refused_step_ = step_;
    refused_until_s_ = now_s + kPatience_s;
    go_to(step_ - 1);
    return samples();
  }
  const double usual_s = this->usual_s(now_s);
  if (!(usual_s > 0.0)) return samples();
  const std::size_t end =
      now_s < refused_until_s_ ? std::min(refused_step_, ladder_.size()) : ladder_.size();
  std::size_t step = step_;
  while (step + 1 < end && usual_s * effort_of(ladder_[step + 1]) / effort_of(ladder_[step_]) <=
                               kRoom * kShare * period_s_)
    ++step;
  if (step != step_) go_to(step);
  return samples();
}

double PaceByVolume::samples() const {
  if (!outside_) return inside_.samples();
  if (on_side_ < kAtBorder) return std::min(inside_.samples(), outside_->samples());
  return is_outside_ ? outside_->samples() : inside_.samples();
}

void PaceByVolume::change_side(double now_s, bool outside) {
  if (on_side_ >= kAtBorder) {
    inside_.forget();
    if (outside_) outside_->forget();
  }
  if (!outside_) outside_ = inside_;
  is_outside_ = outside;
  on_side_ = 0;
  changed_s_ = now_s;
}

double PaceByVolume::after(double now_s, double frame_s, bool outside) {
  const double made_with = samples();
  if (outside != is_outside_) change_side(now_s, outside);
  Pace& side = outside ? *outside_ : inside_;
  // A frame of another sampling tells of this one only that it is too slow as well.
  if (made_with == side.samples() || (made_with < side.samples() && side.is_late(frame_s)))
    side.after(now_s, frame_s);
  on_side_ = std::min(on_side_ + 1, kAtBorder);
  if (!is_outside_ && now_s - changed_s_ >= Pace::kPatience_s) outside_.reset();
  return samples();
}

}  // namespace fanbeam::live
