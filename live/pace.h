// How finely a live frame may be sampled: the controller that keeps a rate.
//
// A ladder of samplings, coarsest first. One frame in a hundred may take more than its share of the period (is late).
// * Each late one is a debt of one, of which every frame pays off 0.009. With a debt above five, at the second late one
//   of a step, the next frame is a step coarser; none is finer before the debt is down to four. So 0.009 of the frames and
//   seven are late at most, as long as a step is coarse enough: of 20 minutes at 16 Hz less than a hundredth. What a jump
//   takes beyond seven is not owed, or the picture would stay coarse for long after it.
// * Three late ones of five: the load has jumped, and the next is as coarse as the slowest of them needs.
// * Finer is as of what the last thousand frames would have taken, of which 0.007 (of few: one) may be late. Time is
//   taken to grow as the samples and a half, for what does not depend on them (measured: docs/performance-notes.md).
// * A step that was too slow is left alone for ten seconds, each time twice as long as the time before, up to five minutes:
//   the picture does not flicker between two, and few frames are late of trying.
// * Where the median of ten seconds falls by a fifth the load has fallen, and what was too slow before is forgotten.
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
  static constexpr double kPatience_s = 10.0;

  // `ladder` rises and is not empty.
  Pace(std::vector<double> ladder, double period_s)
      : ladder_(std::move(ladder)), refused_(ladder_.size()), period_s_(period_s) {}

  double samples() const { return ladder_[step_]; }
  // Sampling of the next frame, after one that ended at `now_s` and took `frame_s`.
  double after(double now_s, double frame_s);
  // Whether a frame that took so long takes more than its share.
  bool is_late(double frame_s) const { return frame_s > kShare * period_s_; }
  // What frames took so far says nothing of those to come.
  void forget();

 private:
  struct Refused {
    double until_s = 0.0, patience_s = 0.0;
  };

  void keep(double frame_s);
  // Frames in that time, as many as are kept at most.
  std::size_t frames_in(double span_s, double fewest) const;
  std::vector<double> newest_loads(std::size_t count) const;
  bool is_late_with(std::size_t step, double load_s) const;
  bool has_fallen();
  bool has_jumped(double now_s);  // then the step is as coarse as it needs
  bool has_room(std::size_t step) const;
  void go_coarser(double now_s, std::size_t step);
  void go_finer(double now_s);

  std::vector<double> ladder_;
  std::vector<Refused> refused_;  // of each step
  double period_s_;
  std::size_t step_ = 0;
  int late_ = 0;                  // with this step
  double debt_ = 0.0;             // of late frames
  std::deque<double> loads_;      // of the last frames: time by their effort, s
  double heaviest_load_s_ = 0.0;  // median of ten seconds, or at a jump
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
