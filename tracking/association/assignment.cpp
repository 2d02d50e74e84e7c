#include "tracking/association/assignment.h"

#include <cmath>
#include <limits>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(const CostMatrix& costs, const std::vector<double>& miss_cost) {
  if (costs.rows < 0 || costs.columns < 0 ||
      costs.cost.size() !=
          static_cast<std::size_t>(costs.rows) * static_cast<std::size_t>(costs.columns) ||
      miss_cost.size() != static_cast<std::size_t>(costs.rows))
    core::throw_input_error(core::ErrorClass::range, "assignment.size",
                            static_cast<double>(miss_cost.size()), "one miss cost for each row");
  for (const double cost : costs.cost)
    if (std::isnan(cost) || cost == -kInfinity)
      core::throw_input_error(core::ErrorClass::nonfinite, "assignment.cost", cost,
                              "finite, or infinite to forbid");
  for (const double cost : miss_cost)
    if (!std::isfinite(cost))
      core::throw_input_error(core::ErrorClass::nonfinite, "assignment.miss_cost", cost, "finite");
}

// Rows and columns count from 1; 0 is the start of every path. Behind the real columns every row
// has one of its own, for its miss.
class Solver {
 public:
  Solver(const CostMatrix& costs, const std::vector<double>& miss_cost)
      : costs_(costs),
        miss_cost_(miss_cost),
        columns_(costs.columns + costs.rows),
        row_potential_(static_cast<std::size_t>(costs.rows) + 1, 0.0),
        column_potential_(static_cast<std::size_t>(columns_) + 1, 0.0),
        row_of_(static_cast<std::size_t>(columns_) + 1, 0) {}

  Assignment solve() {
    for (int row = 1; row <= costs_.rows; ++row) augment(row);
    Assignment result;
    result.column_of.assign(static_cast<std::size_t>(costs_.rows), -1);
    for (int column = 1; column <= costs_.columns; ++column)
      if (const int row = row_of_[static_cast<std::size_t>(column)]; row > 0)
        result.column_of[static_cast<std::size_t>(row - 1)] = column - 1;
    for (int row = 0; row < costs_.rows; ++row) {
      const int column = result.column_of[static_cast<std::size_t>(row)];
      result.cost +=
          column < 0 ? miss_cost_[static_cast<std::size_t>(row)] : costs_.at(row, column);
    }
    return result;
  }

 private:
  double cost(int row, int column) const {
    if (column <= costs_.columns) return costs_.at(row - 1, column - 1);
    return column - costs_.columns == row ? miss_cost_[static_cast<std::size_t>(row - 1)]
                                          : kInfinity;
  }

  // Grows a tree of shortest paths from the new row until it reaches a free column. There always is
  // one at a finite cost: the row's own.
  void augment(int new_row) {
    const auto size = static_cast<std::size_t>(columns_) + 1;
    std::vector<double> least(size, kInfinity);
    std::vector<int> before(size, 0);
    std::vector<bool> used(size, false);
    row_of_[0] = new_row;
    std::size_t here = 0;
    do {
      used[here] = true;
      const int row = row_of_[here];
      double step = kInfinity;
      std::size_t next = 0;
      for (std::size_t column = 1; column < size; ++column) {
        if (used[column]) continue;
        const double reduced = cost(row, static_cast<int>(column)) -
                               row_potential_[static_cast<std::size_t>(row)] -
                               column_potential_[column];
        if (reduced < least[column]) {
          least[column] = reduced;
          before[column] = static_cast<int>(here);
        }
        if (least[column] < step) {
          step = least[column];
          next = column;
        }
      }
      for (std::size_t column = 0; column < size; ++column) {
        if (used[column]) {
          row_potential_[static_cast<std::size_t>(row_of_[column])] += step;
          column_potential_[column] -= step;
        } else {
          least[column] -= step;
        }
      }
      here = next;
    } while (row_of_[here] != 0);
    while (here != 0) {
      const auto from = static_cast<std::size_t>(before[here]);
      row_of_[here] = row_of_[from];
      here = from;
    }
  }

  const CostMatrix& costs_;
  const std::vector<double>& miss_cost_;
  int columns_;
  std::vector<double> row_potential_, column_potential_;
  std::vector<int> row_of_;
};

}  // namespace

CostMatrix::CostMatrix(int row_count, int column_count, double value)
    : rows(row_count), columns(column_count) {
  if (row_count < 0 || column_count < 0)
    core::throw_input_error(core::ErrorClass::range, "cost_matrix.size", row_count, "0 or more");
  cost.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), value);
}

Assignment assign(const CostMatrix& costs, const std::vector<double>& miss_cost) {
  check(costs, miss_cost);
  return Solver(costs, miss_cost).solve();
}

}  // namespace fanbeam::tracking
