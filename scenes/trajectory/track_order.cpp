#include "scenes/trajectory/track_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::string time_text(const TrackRow& row) {
  return core::number_text(row.time_s) + " s in line " + std::to_string(row.line);
}

}  // namespace

core::Place place_of(const RawTrack& track, const TrackRow& row) { return {track.file, row.line}; }

std::string rounded_text(double value, double parts) {
  return core::number_text(std::round(value * parts) / parts + 0.0);
}

std::string rows_text(std::int64_t first, std::int64_t last) {
  if (first == last) return "row " + std::to_string(first);
  return "rows " + std::to_string(first) + " to " + std::to_string(last);
}

void leave_out(RawTrack& track, const std::vector<LeftOut>& rows) {
  std::size_t kept = 0;
  auto next = rows.begin();
  bool joined = false;  // the row before was left out too
  for (std::size_t i = 0; i < track.rows.size(); ++i) {
    const TrackRow& row = track.rows[i];
    if (next == rows.end() || next->index != i) {
      track.rows[kept++] = row;
      joined = false;
      continue;
    }
    if (!joined || track.rejected.back().why != next->why)
      track.rejected.push_back({row.row, row.row, 0, row.line, row.time_s, next->why});
    track.rejected.back().last_row = row.row;
    ++track.rejected.back().count;
    joined = true;
    ++next;
  }
  track.rows.resize(kept);
}

std::vector<std::size_t> rows_out_of_order(const std::vector<TrackRow>& rows) {
  // Longest increasing subsequence: by length, the row with the earliest time that ends one.
  std::vector<std::size_t> ends;
  std::vector<std::size_t> before(rows.size(), kNone);
  std::size_t last = kNone;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = std::lower_bound(
        ends.begin(), ends.end(), rows[i].time_s,
        [&rows](std::size_t end, double time_s) { return rows[end].time_s < time_s; });
    if (at != ends.begin()) before[i] = *(at - 1);
    if (at == ends.end()) {
      ends.push_back(i);
      last = i;
    } else if (rows[i].time_s < rows[*at].time_s) {  // of equal ones the earlier row stays
      *at = i;
    }
  }
  std::vector<std::size_t> out;
  for (std::size_t i = rows.size(); i-- > 0;) {
    if (i == last)
      last = before[i];
    else
      out.push_back(i);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

void bring_into_order(RawTrack& track, const TrajectoryColumns& columns,
                      core::ProblemList& problems) {
  const std::vector<std::size_t> out = rows_out_of_order(track.rows);
  if (columns.outliers == OutlierPolicy::reject) {
    std::vector<LeftOut> rows;
    for (const std::size_t index : out) rows.push_back({index, "time"});
    leave_out(track, rows);
    return;
  }
  const TrackRow* kept = nullptr;  // the last good row before
  std::size_t at = 0;
  for (std::size_t k = 0; k < out.size() && !problems.is_full(); ++k) {
    for (; at < out[k]; ++at) kept = &track.rows[at];
    const TrackRow& row = track.rows[at++];
    std::string expected;
    if (kept != nullptr && row.time_s <= kept->time_s) {
      expected = "later than " + time_text(*kept);
    } else {
      std::size_t after = k;
      while (after + 1 < out.size() && out[after + 1] == out[after] + 1) ++after;
      expected = "earlier than " + time_text(track.rows[out[after] + 1]);
    }
    problems.error(core::ErrorClass::time, place_of(track, row), columns.time.name,
                   core::number_text(row.time_s) + " s", expected);
  }
}

}  // namespace fanbeam::scenes
