#include "scenes/trajectory/track_stale.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "scenes/trajectory/track_check.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

// Nothing that flies stops harder.
constexpr double kHardestBraking_mps2 = 10.0;
// The flight before and after a hold is about as fast as the position's jump says; else a parked
// aircraft's rows would be stale for one wrong position behind them.
constexpr double kSameSpeed = 3.0;

// Rows from one new position to the last that repeats it.
struct Stay {
  std::size_t first = 0, last = 0;
};

std::vector<Stay> stays_of(const std::vector<TrackRow>& rows) {
  std::vector<Stay> stays;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool same = i > 0 && rows[i].position.latitude_rad == rows[i - 1].position.latitude_rad &&
                      rows[i].position.longitude_rad == rows[i - 1].position.longitude_rad;
    if (same)
      stays.back().last = i;
    else
      stays.push_back({i, i});
  }
  return stays;
}

// From the beginning of one stay to that of the next.
std::optional<double> speed_mps(const std::vector<TrackRow>& rows, const std::vector<Stay>& stays,
                                std::size_t k) {
  if (k + 1 >= stays.size()) return std::nullopt;
  const TrackRow& a = rows[stays[k].first];
  const TrackRow& b = rows[stays[k + 1].first];
  return glm::distance(terrain::ecef_from_geodetic(foot_point(a.position)),
                       terrain::ecef_from_geodetic(foot_point(b.position))) /
         (b.time_s - a.time_s);
}

// Of the flight that goes on while stay `k` stands, or nothing when it may really stand.
std::optional<double> going_on_mps(const std::vector<TrackRow>& rows,
                                   const std::vector<Stay>& stays, std::size_t k) {
  const std::optional<double> before = k > 0 ? speed_mps(rows, stays, k - 1) : std::nullopt;
  const std::optional<double> meanwhile = speed_mps(rows, stays, k);
  const std::optional<double> after = speed_mps(rows, stays, k + 1);
  if (!meanwhile) {
    const double step_s = rows[stays[k].first + 1].time_s - rows[stays[k].first].time_s;
    const bool may_stop = !before || *before < kStaleSpeed_mps + kHardestBraking_mps2 * step_s;
    return may_stop ? std::nullopt : before;
  }
  if (*meanwhile < kStaleSpeed_mps) return std::nullopt;
  for (const std::optional<double>& beside : {before, after})
    if (beside && (*beside * kSameSpeed < *meanwhile || *beside > *meanwhile * kSameSpeed))
      return std::nullopt;
  return meanwhile;
}

}  // namespace

std::vector<Hold> find_holds(const RawTrack& track) {
  const std::vector<Stay> stays = stays_of(track.rows);
  std::vector<Hold> holds;
  for (std::size_t k = 0; k < stays.size(); ++k) {
    const auto [first, last] = stays[k];
    if (first == last) continue;
    const std::optional<double> speed = going_on_mps(track.rows, stays, k);
    if (!speed) continue;
    const TrackRow& end = track.rows[last];
    holds.push_back({first, last, end.time_s - track.rows[first].time_s, *speed,
                     end.time_s - track.rows[last - 1].time_s});
  }
  return holds;
}

}  // namespace fanbeam::scenes
