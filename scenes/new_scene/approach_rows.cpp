#include "scenes/new_scene/approach_rows.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace fanbeam::scenes {
namespace {

constexpr double kLongestPause_s = 120.0;
constexpr double kShortestApproach_m = 1000.0;
constexpr double kBackwards_m = 50.0;     // positions wander
constexpr double kEndsBefore_m = 3000.0;  // a recording that ends there was on its way down
constexpr std::size_t kMostFitted = 200;

bool is_near_centre_line(const ApproachRow& row) {
  return std::abs(row.left_m) < 300.0 + 0.15 * std::max(row.before_m, 0.0);
}

bool follows(const ApproachRow& a, const ApproachRow& b) {
  return b.time_s > a.time_s && b.time_s - a.time_s < kLongestPause_s;
}

// Back from the row `arrived` while the flight comes nearer.
std::size_t first_of(const std::vector<ApproachRow>& rows, std::size_t arrived,
                     double start_distance_m) {
  std::size_t first = arrived;
  while (first > 0) {
    const ApproachRow& before = rows[first - 1];
    if (!before.over_terrain || !is_near_centre_line(before) || !follows(before, rows[first]) ||
        before.before_m > start_distance_m || before.before_m < rows[first].before_m - kBackwards_m)
      break;
    --first;
  }
  return first;
}

}  // namespace

std::vector<ApproachPart> find_approaches(const std::vector<ApproachRow>& rows,
                                          double start_distance_m, double runway_length_m) {
  std::vector<ApproachPart> parts;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const ApproachRow& row = rows[i];
    const bool crosses = rows[i - 1].before_m > 0.0 && row.before_m <= 0.0;
    const bool ends = i + 1 == rows.size() && row.before_m > 0.0 && row.before_m < kEndsBefore_m;
    if ((!crosses && !ends) || !row.over_terrain || !is_near_centre_line(row)) continue;
    ApproachPart part{first_of(rows, i, start_distance_m), i};
    const double from_m = rows[part.first].before_m;
    const bool goes_away = from_m <= row.before_m;
    if (goes_away || from_m < kShortestApproach_m) continue;
    while (part.last + 1 < rows.size()) {
      const ApproachRow& next = rows[part.last + 1];
      if (!next.over_terrain || !is_near_centre_line(next) || !follows(rows[part.last], next) ||
          next.before_m < -runway_length_m || next.before_m > rows[part.last].before_m)
        break;
      ++part.last;
    }
    parts.push_back(part);
  }
  return parts;
}

std::optional<ApproachPart> find_nearest_part(const std::vector<ApproachRow>& rows,
                                              double start_distance_m) {
  const auto distance_m = [&](const ApproachRow& row) {
    return std::hypot(row.before_m, row.left_m);
  };
  const auto inside = [&](const ApproachRow& row) {
    return row.over_terrain && distance_m(row) <= start_distance_m;
  };
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (inside(rows[i]) && (!nearest || distance_m(rows[i]) < distance_m(rows[*nearest])))
      nearest = i;
  if (!nearest) return std::nullopt;
  ApproachPart part{*nearest, *nearest};
  while (part.first > 0 && inside(rows[part.first - 1]) &&
         follows(rows[part.first - 1], rows[part.first]))
    --part.first;
  while (part.last + 1 < rows.size() && inside(rows[part.last + 1]) &&
         follows(rows[part.last], rows[part.last + 1]))
    ++part.last;
  if (part.first == part.last) return std::nullopt;
  return part;
}

double height_at_threshold_m(const std::vector<double>& before_m,
                             const std::vector<double>& height_m) {
  const std::size_t step = std::max<std::size_t>(1, before_m.size() / kMostFitted);
  std::vector<double> slopes;
  for (std::size_t i = 0; i < before_m.size(); i += step)
    for (std::size_t j = i + step; j < before_m.size(); j += step)
      if (std::abs(before_m[j] - before_m[i]) > 1.0)
        slopes.push_back((height_m[j] - height_m[i]) / (before_m[j] - before_m[i]));
  const double slope = slopes.empty() ? 0.0 : core::median(slopes);
  std::vector<double> offsets_m;
  for (std::size_t i = 0; i < before_m.size(); i += step)
    offsets_m.push_back(height_m[i] - slope * before_m[i]);
  return core::median(offsets_m);
}

}  // namespace fanbeam::scenes
