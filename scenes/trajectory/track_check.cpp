#include "scenes/trajectory/track_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scenes/trajectory/track_blame.h"
#include "scenes/trajectory/track_chain.h"
#include "scenes/trajectory/track_motion.h"
#include "scenes/trajectory/track_oddities.h"
#include "scenes/trajectory/track_order.h"
#include "scenes/trajectory/track_stale.h"
#include "scenes/trajectory/track_turning.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using Indices = std::vector<std::size_t>;

// An attitude that changes for good is not a wrong row, unless the track ends with it.
constexpr std::size_t kLongestEnd = 3;

GoodNeighbours around(std::size_t first, std::size_t last, std::size_t count) {
  GoodNeighbours good;
  if (first > 0) good.before = first - 1;
  if (last + 1 < count) good.after = last + 1;
  return good;
}

// Calls `take(first, last)` for every run of neighbours.
template <class Take>
void for_runs(const Indices& indices, Take take) {
  for (std::size_t k = 0; k < indices.size();) {
    std::size_t end = k + 1;
    while (end < indices.size() && indices[end] - indices[k] == end - k) ++end;
    take(indices[k], indices[end - 1]);
    k = end;
  }
}

class TrackCheck {
 public:
  TrackCheck(RawTrack& track, const TrajectoryColumns& columns, const PathSmoothing& smoothing,
             core::ProblemList& problems)
      : track_(track),
        columns_(columns),
        smoothing_(smoothing),
        problems_(problems),
        holds_(find_holds(track)) {}

  void run() {
    const TrackMotion motion(track_, fresh_rows(), smoothing_);
    if (motion.size() < kFewestRows) {
      blame_few(motion);
    } else {
      const Indices off = rows_off_the_chain(
          motion.size(), [&](std::size_t a, std::size_t b) { return motion.misfit(a, b).ratio; });
      const std::string speed =
          "; median ground speed " + rounded_text(motion.median_speed_mps()) + " m/s";
      if (too_many(motion, off, speed, "time, position and height")) return;
      for_runs(off, [&](std::size_t first, std::size_t last) {
        const GoodNeighbours good = around(first, last, motion.size());
        for (std::size_t i = first; i <= last; ++i)
          blamed_.push_back(blame(track_, columns_, motion, i, good, false));
      });
      if (!blame_turning(motion)) return;
      tell_oddities(track_, TrackMotion(track_, unblamed(fresh_rows()), smoothing_), problems_);
    }
    judge_holds(motion.tolerance());
    if (track_.fully_recorded()) warn_of_gaps(track_, problems_);
    if (columns_.outliers == OutlierPolicy::reject)
      reject();
    else
      tell(track_, blamed_, problems_);
  }

 private:
  Indices fresh_rows() const {
    Indices rows;
    auto hold = holds_.begin();
    for (std::size_t i = 0; i < track_.rows.size(); ++i) {
      while (hold != holds_.end() && hold->last < i) ++hold;
      if (hold == holds_.end() || i <= hold->first) rows.push_back(i);
    }
    return rows;
  }

  Indices unblamed(const Indices& rows) const {
    Indices kept;
    auto blamed = blamed_.begin();
    for (const std::size_t row : rows) {
      while (blamed != blamed_.end() && blamed->row < row) ++blamed;
      if (blamed == blamed_.end() || blamed->row != row) kept.push_back(row);
    }
    return kept;
  }

  void blame_few(const TrackMotion& motion) {
    for (std::size_t i = 1; i < motion.size(); ++i)
      if (motion.absolute_misfit(i - 1, i).ratio > 1.0)
        blamed_.push_back(blame(track_, columns_, motion, i, {i - 1, std::nullopt}, true));
  }

  template <class Steps>
  bool too_many(const Steps& steps, const Indices& off, const std::string& value,
                const char* columns) {
    if (static_cast<double>(off.size()) <= kLargestBlamedShare * static_cast<double>(steps.size()))
      return false;
    const TrackRow& row = track_.rows[steps.row(off.front())];
    problems_.error(ErrorClass::range, place_of(track_, row), "rows that contradict the others",
                    std::to_string(off.size()) + " of " + std::to_string(steps.size()) +
                        ", the first row " + std::to_string(row.row) + value,
                    std::string("at most a quarter; check the columns and units of ") + columns +
                        ", and that these rows are of one flight (from_row, to_row)");
    return true;
  }

  // False when the attitudes make no sense together.
  bool blame_turning(const TrackMotion& motion) {
    if (!track_.has_roll && !track_.has_pitch && !track_.has_heading) return true;
    Indices rows(track_.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    rows = unblamed(rows);
    std::vector<double> speeds_mps;
    std::size_t moving = 0;
    for (const std::size_t row : rows) {
      while (moving + 1 < motion.size() && motion.row(moving + 1) <= row) ++moving;
      speeds_mps.push_back(motion.speed_mps(moving));
    }
    const TrackTurning turning(track_, rows, speeds_mps);
    Indices off;
    const Indices all_off = rows_off_the_chain(
        turning.size(), [&](std::size_t a, std::size_t b) { return turning.misfit(a, b).ratio; });
    for_runs(all_off, [&](std::size_t first, std::size_t last) {
      const GoodNeighbours good = around(first, last, turning.size());
      if (!(good.before && good.after) && last - first >= kLongestEnd) return;
      for (std::size_t i = first; i <= last; ++i) off.push_back(i);
    });
    if (too_many(turning, off, "", "roll, pitch and heading")) return false;
    for_runs(off, [&](std::size_t first, std::size_t last) {
      const GoodNeighbours good = around(first, last, turning.size());
      for (std::size_t i = first; i <= last; ++i)
        blamed_.push_back(blame(track_, turning, i, good));
    });
    std::sort(blamed_.begin(), blamed_.end(),
              [](const BlamedRow& a, const BlamedRow& b) { return a.row < b.row; });
    return true;
  }

  std::string hold_text(const Hold& hold) const {
    return rounded_text(hold.duration_s) + " s at " + rounded_text(hold.speed_mps) + " m/s";
  }

  // Longer ones miss what no aircraft catches up with.
  void judge_holds(const TrackTolerance& tolerance) {
    if (holds_.empty() || columns_.outliers == OutlierPolicy::reject) return;
    std::size_t rows = 0;
    const Hold* longest = nullptr;
    for (const Hold& hold : holds_) {
      const double allowed_m =
          tolerance.position_m + kHardestTurn_mps2 * hold.last_step_s * hold.last_step_s;
      const TrackRow& first = track_.rows[hold.first + 1];
      if (hold.missed_m() > allowed_m) {
        problems_.error(ErrorClass::range, place_of(track_, first),
                        rows_text(first.row, track_.rows[hold.last].row) + ", position",
                        "that of row " + std::to_string(track_.rows[hold.first].row) + ", for " +
                            hold_text(hold),
                        "at most " + rounded_text(allowed_m) + " m missed, not " +
                            rounded_text(hold.missed_m()) +
                            "; leave them out, or set trajectory.outliers = \"reject\"");
        continue;
      }
      rows += hold.last - hold.first;
      if (longest == nullptr || hold.missed_m() > longest->missed_m()) longest = &hold;
    }
    if (longest == nullptr) return;
    const TrackRow& first = track_.rows[longest->first + 1];
    problems_.warning("STALE", place_of(track_, first), "rows that repeat the position before",
                      std::to_string(rows),
                      "flown as they are; the worst, " +
                          rows_text(first.row, track_.rows[longest->last].row) + ", for " +
                          hold_text(*longest));
  }

  void reject() {
    std::vector<LeftOut> rows;
    for (const BlamedRow& row : blamed_) rows.push_back({row.row, row.what});
    for (const Hold& hold : holds_)
      for (std::size_t i = hold.first + 1; i <= hold.last; ++i) rows.push_back({i, "stale"});
    std::stable_sort(rows.begin(), rows.end(),
                     [](const LeftOut& a, const LeftOut& b) { return a.index < b.index; });
    const auto same = [](const LeftOut& a, const LeftOut& b) { return a.index == b.index; };
    rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
    leave_out(track_, rows);
  }

  RawTrack& track_;
  const TrajectoryColumns& columns_;
  const PathSmoothing& smoothing_;
  core::ProblemList& problems_;
  std::vector<Hold> holds_;
  std::vector<BlamedRow> blamed_;
};

void warn_of_rejected(const RawTrack& track, core::ProblemList& problems) {
  if (track.rejected.empty()) return;
  constexpr std::size_t kMostNamed = 10;
  std::int64_t count = 0;
  std::string named;
  for (std::size_t k = 0; k < track.rejected.size(); ++k) {
    const RejectedRows& rows = track.rejected[k];
    count += rows.count;
    if (k < kMostNamed)
      named +=
          (k > 0 ? ", " : "") + rows_text(rows.first_row, rows.last_row) + " (" + rows.why + ")";
  }
  if (track.rejected.size() > kMostNamed) named += " and more";
  problems.warning("OUTLIER", {track.file, track.rejected.front().first_line},
                   "rows that no aircraft could have flown", std::to_string(count),
                   "left out: " + named);
}

}  // namespace

void check_track(RawTrack& track, const TrajectoryColumns& columns, const PathSmoothing& smoothing,
                 core::ProblemList& problems) {
  if (columns.outliers == OutlierPolicy::keep) return;
  if (track.rows.size() > 1) TrackCheck(track, columns, smoothing, problems).run();
  if (columns.outliers == OutlierPolicy::reject) warn_of_rejected(track, problems);
}

}  // namespace fanbeam::scenes
