#include "tracking/metrics/ospa.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/number_range.h"
#include "tracking/association/assignment.h"

namespace fanbeam::tracking {
namespace {

void check(const std::vector<Place>& targets, const std::vector<Place>& tracks,
           const SetDistance& settings) {
  for (const auto* places : {&targets, &tracks})
    for (const Place& place : *places)
      if (!std::isfinite(place.x_m) || !std::isfinite(place.y_m))
        core::throw_input_error(core::ErrorClass::nonfinite, "place", place.x_m, "finite");
  core::require_range("order", settings.order, {.low = 1.0});
  core::require_range("cut_off_m", settings.cut_off_m, {.low = 0.0, .above_low = true});
  core::require_range("alpha", settings.alpha, {0.0, 2.0, true});
}

// Every place of the smaller set gets one of the larger, at d^p, d cut off.
struct Pairs {
  double sum = 0.0;       // of all
  double location = 0.0;  // of those nearer than the cut-off
  int near = 0;
};

Pairs best_pairs(const std::vector<Place>& targets, const std::vector<Place>& tracks,
                 const SetDistance& settings) {
  const bool swap = targets.size() > tracks.size();
  const std::vector<Place>& few = swap ? tracks : targets;
  const std::vector<Place>& many = swap ? targets : tracks;
  const double limit = std::pow(settings.cut_off_m, settings.order);
  CostMatrix costs(static_cast<int>(few.size()), static_cast<int>(many.size()), 0.0);
  for (int row = 0; row < costs.rows; ++row)
    for (int column = 0; column < costs.columns; ++column)
      costs.at(row, column) =
          std::min(limit, std::pow(distance_m(few[static_cast<std::size_t>(row)],
                                              many[static_cast<std::size_t>(column)]),
                                   settings.order));
  // A pair costs at most the cut-off, so no row is better off without one.
  const Assignment found = assign(costs, std::vector<double>(few.size(), limit));
  Pairs pairs;
  pairs.sum = found.cost;
  for (int row = 0; row < costs.rows; ++row) {
    const int column = found.column_of[static_cast<std::size_t>(row)];
    if (column < 0 || costs.at(row, column) >= limit) continue;
    pairs.location += costs.at(row, column);
    ++pairs.near;
  }
  return pairs;
}

}  // namespace

double distance_m(const Place& a, const Place& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

double ospa_m(const std::vector<Place>& targets, const std::vector<Place>& tracks,
              const SetDistance& settings) {
  check(targets, tracks, settings);
  const std::size_t more = std::max(targets.size(), tracks.size());
  if (more == 0) return 0.0;
  const auto surplus = static_cast<double>(more - std::min(targets.size(), tracks.size()));
  const double sum = best_pairs(targets, tracks, settings).sum +
                     std::pow(settings.cut_off_m, settings.order) * surplus;
  return std::pow(sum / static_cast<double>(more), 1.0 / settings.order);
}

Gospa gospa(const std::vector<Place>& targets, const std::vector<Place>& tracks,
            const SetDistance& settings) {
  check(targets, tracks, settings);
  const Pairs pairs = best_pairs(targets, tracks, settings);
  const double limit = std::pow(settings.cut_off_m, settings.order);
  const auto n = static_cast<double>(targets.size()), m = static_cast<double>(tracks.size());
  Gospa result;
  result.total_m =
      std::pow(pairs.sum + limit / settings.alpha * std::abs(n - m), 1.0 / settings.order);
  if (settings.alpha == 2.0) {
    result.location = pairs.location;
    result.missed = 0.5 * limit * (n - pairs.near);
    result.unwanted = 0.5 * limit * (m - pairs.near);
  }
  return result;
}

}  // namespace fanbeam::tracking
