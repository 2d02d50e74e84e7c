// Optimal assignment of rows to columns, each column at most once, where leaving a row alone has a
// price too: global nearest neighbour.
//
// Least sum of cost(row, assigned column), plus miss_cost(row) for rows without a column. Shortest
// augmenting paths with potentials, exact.
// Source: R. Jonker, A. Volgenant, "A shortest augmenting path algorithm for dense and sparse
// linear assignment problems", Computing 38, 1987 (the augmenting step alone, without its heuristic
// start).
// Inputs: infinite costs forbid a pair; NaN, negative infinity and infinite miss costs are
// E-NONFINITE, sizes that do not fit E-RANGE. Equal sums: one of them, always the same.
// Cost: rows^2 (rows + columns).
#pragma once

#include <vector>

namespace fanbeam::tracking {

// Row after row.
struct CostMatrix {
  int rows = 0, columns = 0;
  std::vector<double> cost;
  CostMatrix(int row_count, int column_count, double value);
  double& at(int row, int column) { return cost[index(row, column)]; }
  double at(int row, int column) const { return cost[index(row, column)]; }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

struct Assignment {
  std::vector<int> column_of;  // of each row; -1 for none
  double cost = 0.0;
};

Assignment assign(const CostMatrix& costs, const std::vector<double>& miss_cost);

}  // namespace fanbeam::tracking
