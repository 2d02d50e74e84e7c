#include "sensors/shadow/shadow_runs.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "core/parallel.h"

namespace fanbeam::sensors {
namespace {

constexpr int kShortest = 4;             // cells of a run
constexpr int kDeepestObstacle = 16;     // cells between bright edge and shadow: a roof of 100 m
constexpr int kLongestAfter = 16;        // cells of lit ground behind a run that are looked at
constexpr double kLeastContrast = 0.25;  // 1 - dark / lit
constexpr double kLeastScore = 3.0;
constexpr double kLeastFluctuation = 0.05;
constexpr double kLeastRoof = 0.1;  // of the lit ground
constexpr double kBrightestGround = 1.5;
constexpr int kBehind = 5;              // rows behind the end
constexpr double kSmoothPicture = 0.2;  // fluctuation up to which one cell tells something

double square(double x) { return x * x; }

double median(const std::vector<double>& values, int from, int to) {
  return core::median(std::vector<double>(values.begin() + from, values.begin() + to));
}

struct Dip {
  int start = 0, end = 0;
  double dark = 0.0, lit = 0.0, score = 0.0;
};

class Column {
 public:
  Column(const ShadowGround& ground, int column);

  std::vector<ShadowRun> runs() const;

 private:
  double at(int row) const { return q_[static_cast<std::size_t>(row)]; }
  // Of q clipped to the brightest ground.
  double mean(int from, int to) const {
    return (sum_[static_cast<std::size_t>(to)] - sum_[static_cast<std::size_t>(from)]) /
           (to - from);
  }
  void weigh(int start, int end, Dip& best) const;
  Dip best_from(int start) const;
  std::vector<Dip> dips() const;
  ShadowRun run_of(const Dip& dip) const;
  double start_offset(const ShadowRun& run) const;
  double end_offset(const ShadowRun& run) const;
  void look_behind(ShadowRun& run) const;
  int roof_rows(const Dip& dip) const;
  bool falls_on_object(int row) const;

  const ShadowGround& ground_;
  int column_;
  int rows_end_;
  double fluctuation_;
  std::vector<double> q_, sum_;
};

Column::Column(const ShadowGround& ground, int column)
    : ground_(ground),
      column_(column),
      rows_end_(ground.rows_end),
      fluctuation_(std::max(ground.fluctuation, kLeastFluctuation)),
      sum_(1, 0.0) {
  for (int row = 0; row < rows_end_; ++row) {
    q_.push_back(ground.at(row, column));
    sum_.push_back(sum_.back() + std::min(q_.back(), kBrightestGround));
  }
}

void Column::weigh(int start, int end, Dip& best) const {
  const int n = end - start;
  const int m = std::clamp(n / 2, 3, kLongestAfter);
  const double dark = std::max(mean(start, end), 0.0);
  double lit = std::min(mean(start - 2, start), 1.0);
  if (end < rows_end_) {
    const int to = std::min(end + m, rows_end_);
    lit = std::min(lit, mean(end, to));
    // Ground goes on behind its first cells, a thing inside the shadow does not.
    if (end + 2 < to) lit = std::min(lit, mean(end + 2, to));
  } else if (mean(end - m, end) > 0.5 * (dark + lit)) {
    return;  // lit again before the end of the gate
  }
  if (!(lit > 0.0) || dark > (1.0 - kLeastContrast) * lit) return;
  const double noise = ground_.noise[static_cast<std::size_t>(start)];
  const double deviation =
      fluctuation_ * std::sqrt(square(dark + noise) / n + square(lit + noise) / m);
  const double score = (lit - dark) / deviation;
  if (score > best.score) best = {start, end, dark, lit, score};
}

Dip Column::best_from(int start) const {
  Dip best;
  for (int n = kShortest; start + n <= rows_end_; n += std::max(1, n / 8)) {
    weigh(start, start + n, best);
    // Longer runs may score higher: on ground that is dark itself a later one is another thing.
    if (best.score >= kLeastScore && 2 * n > 3 * (best.end - start) + 6) break;
    if (n + n / 8 + 1 > rows_end_ - start) weigh(start, rows_end_, best);
  }
  if (best.score == 0.0) return best;
  const int reach = (best.end - start) / 8;
  const int from = std::max(best.end - reach, start + kShortest);
  const int to = std::min(best.end + reach, rows_end_);
  for (int end = from; end <= to; ++end) weigh(start, end, best);
  return best;
}

std::vector<Dip> Column::dips() const {
  std::vector<Dip> all;
  for (int start = 2; start + kShortest <= rows_end_; ++start) {
    const Dip dip = best_from(start);
    if (dip.score >= kLeastScore) all.push_back(dip);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Dip& a, const Dip& b) { return a.score > b.score; });
  std::vector<Dip> taken;
  for (const Dip& dip : all)
    if (std::none_of(taken.begin(), taken.end(), [&](const Dip& other) {
          return dip.start < other.end && other.start < dip.end;
        }))
      taken.push_back(dip);
  std::sort(taken.begin(), taken.end(),
            [](const Dip& a, const Dip& b) { return a.start < b.start; });
  return taken;
}

// The first dark cell may be part roof: its excess over the next ones is the
// length of that part. Only where one cell tells more than it fluctuates.
double Column::start_offset(const ShadowRun& run) const {
  if (ground_.fluctuation > kSmoothPicture || run.roof_rows > 0) return 0.0;
  const double dark = median(q_, run.start_row + 1, run.start_row + kShortest);
  const double bright = std::min(at(run.start_row - 1), run.lit);
  if (!(bright > dark)) return 0.0;
  return std::clamp((at(run.start_row) - dark) / (bright - dark), 0.0, 1.0);
}

// The cells about the end are part dark, part lit: their deficit is the length
// of the dark part.
double Column::end_offset(const ShadowRun& run) const {
  if (ground_.fluctuation > kSmoothPicture || !(run.behind > run.dark)) return 0.0;
  double dark_cells = -2.0;
  for (int row = run.end_row - 2; row < run.end_row + 2; ++row)
    dark_cells += std::clamp((run.behind - at(row)) / (run.behind - run.dark), 0.0, 1.0);
  return std::clamp(dark_cells, -1.0, 1.0);
}

void Column::look_behind(ShadowRun& run) const {
  const int from = run.end_row + 1, to = from + kBehind;
  if (to > rows_end_) return;
  run.behind = run.behind_least = run.behind_most = mean(from, to);
  if (ground_.fluctuation > kSmoothPicture) return;
  run.behind = median(q_, from, to);
  run.behind_least = *std::min_element(q_.begin() + from, q_.begin() + to);
  run.behind_most = *std::max_element(q_.begin() + from, q_.begin() + to);
}

// A roof seen at grazing incidence may be darker than the ground, but echoes: the run then begins
// with rows that stand out of the rest of it.
int Column::roof_rows(const Dip& dip) const {
  const int n = dip.end - dip.start;
  const double noise = ground_.noise[static_cast<std::size_t>(dip.start)];
  int rows = 0;
  double best = kLeastScore;
  for (int k = kShortest - 1; k <= std::min(kDeepestObstacle, n / 2); ++k) {
    const double roof = mean(dip.start, dip.start + k);
    const double dark = std::max(mean(dip.start + k, dip.end), 0.0);
    const double last = mean(dip.start + k - 2, dip.start + k);
    // Level to its end: not the smeared face of an oblique wall.
    if (roof < kLeastRoof * dip.lit || roof < 2.0 * dark || last < 0.7 * roof) continue;
    const double deviation =
        fluctuation_ * std::sqrt(square(roof + noise) / k + square(dark + noise) / (n - k));
    if ((roof - dark) / deviation <= best) continue;
    best = (roof - dark) / deviation;
    rows = k;
  }
  return rows;
}

// Bright at the end and darker behind: not the ground, but an object in the shadow.
bool Column::falls_on_object(int row) const {
  if (row + 4 >= rows_end_) return false;
  const double brightest = std::max({at(row), at(row + 1), at(row + 2)});
  const double behind = std::max(mean(row + 3, std::min(row + 9, rows_end_)), 0.25);
  return brightest > kBrightestGround * (1.0 + 3.0 * ground_.fluctuation) * behind;
}

ShadowRun Column::run_of(const Dip& dip) const {
  ShadowRun run;
  run.column = column_;
  run.start_row = dip.start;
  run.end_row = dip.end;
  run.roof_rows = roof_rows(dip);
  run.dark = dip.dark;
  run.lit = dip.lit;
  look_behind(run);
  run.start_offset = start_offset(run);
  run.end_offset = end_offset(run);
  run.score = dip.score;
  const double bright = 0.5 * (dip.dark + dip.lit);
  run.edge_row = dip.start - 1;
  for (int row = dip.start - 1; row >= std::max(dip.start - kDeepestObstacle, 0); --row) {
    if (at(row) < bright && row < dip.start - 2) break;
    if (at(row) > at(run.edge_row)) run.edge_row = row;
  }
  run.edge = at(run.edge_row);
  run.before = run.edge_row >= 8 ? mean(run.edge_row - 8, run.edge_row - 2) : run.edge;
  run.truncated = dip.end + 2 >= rows_end_ || falls_on_object(dip.end);
  const double thing = kBrightestGround * (1.0 + 3.0 * ground_.fluctuation) * dip.lit;
  for (int row = dip.start + 1; row + 1 < dip.end; ++row)
    run.merged = run.merged || at(row) > thing;
  return run;
}

std::vector<ShadowRun> Column::runs() const {
  std::vector<ShadowRun> runs;
  for (const Dip& dip : dips()) runs.push_back(run_of(dip));
  return runs;
}

}  // namespace

std::vector<ShadowRun> shadow_runs(const ShadowGround& ground) {
  std::vector<std::vector<ShadowRun>> found(static_cast<std::size_t>(ground.columns));
  core::parallel_for(found.size(), [&](std::size_t column) {
    found[column] = Column(ground, static_cast<int>(column)).runs();
  });
  std::vector<ShadowRun> runs;
  for (const std::vector<ShadowRun>& column : found)
    runs.insert(runs.end(), column.begin(), column.end());
  return runs;
}

}  // namespace fanbeam::sensors
