#include "live/pace.h"

#include <algorithm>

#include "core/median.h"

namespace fanbeam::live {
namespace {

constexpr double kMostLoads = 1000.0;
// Of late frames: paid off by each frame; up to which a step may be finer, above which it is coarser; at most.
constexpr double kPaidOff = 0.009, kForFiner = 4.0, kForCoarser = 5.0, kMostDebt = 7.0;
constexpr double kMayBeLate = 0.007;  // with a finer step
constexpr double kRoom = 0.95;        // of the share, that a finer step may be expected to take
constexpr double kMostPatience_s = 320.0;

double effort_of(double samples) { return samples + 0.5; }

}  // namespace

void Pace::forget() {
  loads_.clear();
  std::fill(refused_.begin(), refused_.end(), Refused{});
  heaviest_load_s_ = 0.0;
}

void Pace::keep(double frame_s) {
  loads_.push_back(frame_s / effort_of(samples()));
  if (static_cast<double>(loads_.size()) > kMostLoads) loads_.pop_front();
  debt_ = std::max(0.0, debt_ - kPaidOff);
  if (!is_late(frame_s)) return;
  debt_ = std::min(kMostDebt, debt_ + 1.0);
  ++late_;
}

std::size_t Pace::frames_in(double span_s, double fewest) const {
  return static_cast<std::size_t>(std::clamp(span_s / period_s_, fewest, kMostLoads));
}

std::vector<double> Pace::newest_loads(std::size_t count) const {
  const auto kept = static_cast<std::ptrdiff_t>(std::min(count, loads_.size()));
  return {loads_.end() - kept, loads_.end()};
}

bool Pace::is_late_with(std::size_t step, double load_s) const {
  return is_late(load_s * effort_of(ladder_[step]));
}

bool Pace::has_fallen() {
  const std::size_t enough = frames_in(10.0, 16.0);
  if (loads_.size() < enough) return false;
  const double load_s = core::median(newest_loads(enough));
  heaviest_load_s_ = std::max(heaviest_load_s_, load_s);
  return load_s < 0.8 * heaviest_load_s_;
}

bool Pace::has_jumped(double now_s) {
  std::vector<double> loads_s = newest_loads(5);
  std::sort(loads_s.rbegin(), loads_s.rend());
  if (loads_s.size() < 3 || !is_late_with(step_, loads_s[2])) return false;
  std::size_t step = step_;
  while (step > 0 && is_late_with(step, loads_s[0])) --step;
  if (step == step_) return true;
  go_coarser(now_s, step);
  loads_.clear();
  heaviest_load_s_ = loads_s[2];
  return true;
}

bool Pace::has_room(std::size_t step) const {
  const auto late = std::count_if(loads_.begin(), loads_.end(), [&](double load_s) {
    return is_late_with(step, load_s / kRoom);
  });
  return static_cast<double>(late) <=
         std::max(1.0, kMayBeLate * static_cast<double>(loads_.size()));
}

void Pace::go_coarser(double now_s, std::size_t step) {
  Refused& refused = refused_[step_];
  refused.patience_s = std::clamp(2.0 * refused.patience_s, kPatience_s, kMostPatience_s);
  refused.until_s = now_s + refused.patience_s;
  step_ = step;
  late_ = 0;
}

void Pace::go_finer(double now_s) {
  std::size_t step = step_;
  while (step + 1 < ladder_.size() && now_s >= refused_[step + 1].until_s && has_room(step + 1))
    ++step;
  if (step == step_) return;
  step_ = step;
  late_ = 0;
  loads_.clear();
}

double Pace::after(double now_s, double frame_s) {
  keep(frame_s);
  if (has_fallen()) forget();
  if (has_jumped(now_s)) return samples();
  if (debt_ > kForCoarser && late_ > 1 && step_ > 0)
    go_coarser(now_s, step_ - 1);
  else if (debt_ <= kForFiner && loads_.size() >= frames_in(2.0, 4.0))
    go_finer(now_s);
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
