#include "signal/detection/cfar.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/detection/cfar_window_private.h"

namespace fanbeam::signal {
namespace {

void check_reach(const CfarReach& reach) {
  check_count("cfar.guard", reach.guard, 0, 10000);
  check_count("cfar.reference", reach.reference, 0, 10000);
}

// Factors for every number of cells before and after that a map brings, made when first met.
class Factors {
 public:
  explicit Factors(const CfarSettings& settings) : settings_(settings) {}

  double of(const CfarReference& reference) {
    const std::lock_guard<std::mutex> lock(mutex_);
    // Only the detectors of halves care how the cells are split.
    const auto key = has_halves(reference.kind) ? std::pair(reference.before, reference.after)
                                                : std::pair(reference.before + reference.after, 0);
    const auto found = factors_.find(key);
    if (found != factors_.end()) return found->second;
    return factors_[key] = cfar_factor(reference, settings_.design_probability);
  }

 private:
  const CfarSettings& settings_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, double> factors_;
};

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// One row's worth of detection, with room for the reference cells that is used again.
class RowDetector {
 public:
  RowDetector(const PowerMap& map, const CfarSettings& settings,
              const std::vector<CfarOffset>& offsets, Factors& factors)
      : map_(map), settings_(settings), offsets_(offsets), factors_(factors) {
    for (const CfarOffset& offset : offsets) {
      steps_.push_back(static_cast<std::ptrdiff_t>(offset.row) * map.columns + offset.column);
      ++(offset.after ? all_after_ : all_before_);
      row_reach_ = std::max(row_reach_, std::abs(offset.row));
      column_reach_ = std::max(column_reach_, std::abs(offset.column));
    }
  }

  void run(int row, std::vector<CfarCell>& found) {
    CfarReference last{.before = -1};
    double factor = 0.0;
    for (int column = 0; column < map_.columns; ++column) {
      const int before = gather(row, column);
      if (cells_.empty()) continue;
      const CfarReference reference =
          reference_of(settings_, before, static_cast<int>(cells_.size()) - before);
      if (!(reference == last)) factor = factors_.of(reference);
      last = reference;
      const double power_W = map_.at(row, column);
      // Ranks are only sorted out for what is reported: as many cells below the threshold as the
      // rank says is the same decision.
      if (reference.kind == CfarKind::ordered_statistic && below(power_W, factor) < reference.rank)
        continue;
      const double background_W = cfar_background(reference, cells_);
      if (power_W > factor * background_W)
        found.push_back({row, column, power_W, background_W / settings_.mean_estimate,
                         power_W / (factor * background_W)});
    }
  }

 private:
  static int wrapped(int place, int count, bool wraps) {
    if (place >= 0 && place < count) return place;
    if (!wraps) return -1;
    return (place % count + count) % count;
  }

  // Returns how many of the cells come before the cell under test; they are the first.
  int gather(int row, int column) {
    cells_.clear();
    if (row >= row_reach_ && row + row_reach_ < map_.rows && column >= column_reach_ &&
        column + column_reach_ < map_.columns) {
      const double* const cell = map_.values_W.data() + map_.index(row, column);
      for (const std::ptrdiff_t step : steps_) cells_.push_back(cell[step]);
      return all_before_;
    }
    int before = 0;
    for (const CfarOffset& offset : offsets_) {
      const int r = wrapped(row + offset.row, map_.rows, settings_.along_rows.wraps);
      const int c = wrapped(column + offset.column, map_.columns, settings_.along_columns.wraps);
      if (r < 0 || c < 0) continue;
      cells_.push_back(map_.at(r, c));
      before += offset.after ? 0 : 1;
    }
    return has_halves(settings_.kind) ? without_remnant(before) : before;
  }

  // At the end of the map a few cells may be left of a half, which tell too little: the other one alone.
  int without_remnant(int before) {
    constexpr int kLeastShare = 4;
    if (kLeastShare * before < all_before_) {
      cells_.erase(cells_.begin(), cells_.begin() + before);
      return 0;
    }
    if (kLeastShare * (static_cast<int>(cells_.size()) - before) < all_after_)
      cells_.resize(static_cast<std::size_t>(before));
    return before;
  }

  int below(double power_W, double factor) const {
    int count = 0;
    for (const double value_W : cells_) count += factor * value_W < power_W ? 1 : 0;
    return count;
  }

  const PowerMap& map_;
  const CfarSettings& settings_;
  const std::vector<CfarOffset>& offsets_;
  Factors& factors_;
  std::vector<double> cells_;  // the reference cells of the cell under test
  // The window as steps through the map, for cells that it does not leave.
  std::vector<std::ptrdiff_t> steps_;
  int all_before_ = 0, all_after_ = 0;
  int row_reach_ = 0;
  int column_reach_ = 0;
};

void check_map(const PowerMap& map, const CfarSettings& settings) {
  if (map.values_W.size() !=
      static_cast<std::size_t>(map.rows) * static_cast<std::size_t>(map.columns))
    refuse("map.values_W", static_cast<double>(map.values_W.size()), "rows x columns");
  for (const double value_W : map.values_W) {
    if (!std::isfinite(value_W))
      core::throw_input_error(core::ErrorClass::nonfinite, "map.values_W", value_W, "finite");
    if (value_W < 0.0) refuse("map.values_W", value_W, "0 or more");
  }
  // A window that meets itself would count cells twice.
  const auto fits = [](const CfarReach& reach, int count) {
    return !reach.wraps || 2 * (reach.guard + reach.reference) < count || count == 0;
  };
  if (!fits(settings.along_rows, map.rows))
    refuse("map.rows", map.rows, "more than the window's reach on both sides where it wraps");
  if (!fits(settings.along_columns, map.columns))
    refuse("map.columns", map.columns, "more than the window's reach on both sides where it wraps");
}

}  // namespace

std::vector<CfarOffset> cfar_offsets(const CfarSettings& settings) {
  check_reach(settings.along_rows);
  check_reach(settings.along_columns);
  check_positive("cfar.mean_estimate", settings.mean_estimate);
  core::require_range("cfar.rank_fraction", settings.rank_fraction, {0.0, 1.0, true});
  const int rows = settings.along_rows.guard + settings.along_rows.reference;
  const int columns = settings.along_columns.guard + settings.along_columns.reference;
  std::vector<CfarOffset> offsets;
  for (int r = -rows; r <= rows; ++r)
    for (int c = -columns; c <= columns; ++c)
      if (std::abs(r) > settings.along_rows.guard || std::abs(c) > settings.along_columns.guard)
        offsets.push_back({r, c, c > 0 || (c == 0 && r > 0)});
  if (offsets.empty()) refuse("cfar.reference", 0, "a reference cell along one axis at least");
  if (has_halves(settings.kind))
    std::stable_partition(offsets.begin(), offsets.end(),
                          [](const CfarOffset& offset) { return !offset.after; });
  return offsets;
}

CfarReference reference_of(const CfarSettings& settings, int before, int after) {
  CfarReference reference{settings.kind, before, after, 1};
  const int count = before + after;
  if (settings.kind == CfarKind::ordered_statistic)
    reference.rank = std::clamp(static_cast<int>(std::lround(settings.rank_fraction * count)), 1,
                                std::max(1, count));
  if (has_halves(settings.kind) && std::min(before, after) == 0)
    reference.kind = CfarKind::cell_averaging;
  return reference;
}

double cfar_background(const CfarReference& reference, std::span<double> cells) {
  if (reference.kind == CfarKind::cell_averaging) return mean(cells);
  if (has_halves(reference.kind)) {
    const auto count = static_cast<std::size_t>(reference.before);
    const double before = mean(cells.first(count)), after = mean(cells.subspan(count));
    return reference.kind == CfarKind::greatest_of ? std::max(before, after)
                                                   : std::min(before, after);
  }
  const auto ranked = cells.begin() + (reference.rank - 1);
  std::nth_element(cells.begin(), ranked, cells.end());
  return *ranked;
}

CfarReference cfar_reference(const CfarSettings& settings) {
  int before = 0;
  int after = 0;
  for (const CfarOffset& offset : cfar_offsets(settings)) ++(offset.after ? after : before);
  return reference_of(settings, before, after);
}

std::vector<CfarCell> cfar_detections(const PowerMap& map, const CfarSettings& settings) {
  check_map(map, settings);
  const std::vector<CfarOffset> offsets = cfar_offsets(settings);
  Factors factors(settings);
  factors.of(cfar_reference(settings));  // refuses a bad probability even for an empty map
  std::vector<std::vector<CfarCell>> by_row(static_cast<std::size_t>(map.rows));
  core::parallel_for(by_row.size(), [&](std::size_t row) {
    RowDetector(map, settings, offsets, factors).run(static_cast<int>(row), by_row[row]);
  });
  std::vector<CfarCell> all;
  for (const auto& row : by_row) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace fanbeam::signal
