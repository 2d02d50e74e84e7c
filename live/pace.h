// How finely a live frame may be sampled: the controller that keeps a rate.
//
// A ladder of samplings, coarsest first. At most one of the last hundred frames may take more than its
// share of the period: at the second, or at one that takes two periods, the next is made a step
// coarser. When all but one of the last two seconds would still fit finer ones, the next is made as
// fine as fits; time is taken to grow as the samples and a half, for what does not depend on them
// (measured: docs/performance-notes.md). A step that was left because it was too slow is not tried
// again for ten seconds, so that the picture does not flicker between two.
// Outside the planned volume every frame is made by a plan of its own, whose cost says nothing of the
// sampling inside: what is too slow there makes frames coarser there alone, and for half a second at the border.
// Pure: time comes in as an argument.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace fanbeam::live {

class Pace {
 public:
  // Of the period, what a frame may take: the rest is for whoever shares the machine.
  static constexpr double kShare = 0.8;
  static constexpr double kLook_s = 2.0, kPatience_s = 10.0;

  // `ladder` rises and is not empty.
  Pace(std::vector<double> ladder, double period_s)
      : ladder_(std::move(ladder)), period_s_(period_s) {}

  double samples() const { return ladder_[step_]; }
  // Sampling of the next frame, after one that ended at `now_s` and took `frame_s`.
  double after(double now_s, double frame_s);
  // Whether a frame that took so long takes more than its share.
  bool is_late(double frame_s) const { return frame_s > kShare * period_s_; }
  // What frames took so far says nothing of those to come.
  void forget() { taken_.clear(); }

 private:
  struct Taken {
    double at_s = 0.0, frame_s = 0.0;
  };

  void keep(const Taken& frame);
  bool too_slow() const;
  // Over which frames are looked at before the sampling becomes finer.
  double look_s() const;
  // What the slowest frame but one of the last two seconds took; 0 while there are none.
  double usual_s(double now_s) const;
  void go_to(std::size_t step) {
    step_ = step;
    taken_.clear();
  }

  std::vector<double> ladder_;
  double period_s_;
  std::size_t step_ = 0;
  std::size_t refused_step_ = 0;  // until then
  double refused_until_s_ = 0.0;
  std::deque<Taken> taken_;  // with this step: of look_s(), and the last hundred
};

// Inside and outside the planned volume: out there it begins as it was inside, which goes on as it was.
// For the first frames after the border each is as coarse as the coarser side needs, as the next may be of
// either. What was learnt outside is kept for ten seconds inside.
class PaceByVolume {
 public:
  PaceByVolume(std::vector<double> ladder, double period_s)
      : inside_(std::move(ladder), period_s) {}

  double samples() const;
  // As Pace::after, of a frame that was `outside` or not, made with samples().
  double after(double now_s, double frame_s, bool outside);

 private:
  static constexpr int kAtBorder = 8;  // frames

  void change_side(double now_s, bool outside);

  Pace inside_;
  std::optional<Pace> outside_;
  bool is_outside_ = false;
  int on_side_ = kAtBorder;  // frames since the border
  double changed_s_ = 0.0;
};

}  // namespace fanbeam::live
