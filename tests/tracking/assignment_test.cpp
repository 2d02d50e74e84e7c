#include "tracking/association/assignment.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "core/errors.h"
#include "tests/tracking/simulated.h"
#include "tracking/association/joint_probabilities.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using tests::run_key;

namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

double uniform(int run, int row, int column) {
  return core::uniform_from(core::random_words(run_key(run, 1003), static_cast<std::uint64_t>(row),
                                               static_cast<std::uint32_t>(column))[0]);
}

// Calls `event` for every way to give rows distinct columns, or none (-1).
void every_event(int rows, int columns, std::vector<int>& chosen,
                 const std::function<void(const std::vector<int>&)>& event) {
  if (static_cast<int>(chosen.size()) == rows) return event(chosen);
  for (int column = -1; column < columns; ++column) {
    if (column >= 0 && std::count(chosen.begin(), chosen.end(), column) > 0) continue;
    chosen.push_back(column);
    every_event(rows, columns, chosen, event);
    chosen.pop_back();
  }
}

struct Problem {
  CostMatrix costs;
  std::vector<double> miss;
};

Problem random_problem(int run) {
  const int rows = 1 + static_cast<int>(5.0 * uniform(run, 90, 0));
  const int columns = static_cast<int>(6.0 * uniform(run, 91, 0));
  Problem problem{CostMatrix(rows, columns, 0.0), {}};
  for (int row = 0; row < rows; ++row) {
    problem.miss.push_back(10.0 * uniform(run, row, 50) - 2.0);
    for (int column = 0; column < columns; ++column)
      problem.costs.at(row, column) = uniform(run, row, column + 20) < 0.2
                                          ? kForbidden
                                          : 14.0 * uniform(run, row, column) - 4.0;
  }
  return problem;
}

}  // namespace

TEST_CASE("The assignment is the cheapest of all", "[association]") {
  for (int run = 0; run < 400; ++run) {
    const Problem problem = random_problem(run);
    double least = kForbidden;
    std::vector<int> chosen;
    every_event(problem.costs.rows, problem.costs.columns, chosen, [&](const auto& columns) {
      double sum = 0.0;
      for (std::size_t row = 0; row < columns.size(); ++row)
        sum += columns[row] < 0 ? problem.miss[row]
                                : problem.costs.at(static_cast<int>(row), columns[row]);
      least = std::min(least, sum);
    });
    const Assignment found = assign(problem.costs, problem.miss);
    REQUIRE(found.cost == Approx(least).epsilon(0.0).margin(1e-12));
    for (const int column : found.column_of)
      if (column >= 0)
        CHECK(std::count(found.column_of.begin(), found.column_of.end(), column) == 1);
  }
}

TEST_CASE("The nearest pair alone is not the best assignment", "[association]") {
  // Greedy takes 1 and is left with 10: 11 instead of 4.
  CostMatrix costs(2, 2, 0.0);
  costs.cost = {1.0, 2.0, 2.0, 10.0};
  const Assignment found = assign(costs, {20.0, 20.0});
  CHECK(found.cost == Approx(4.0));
  CHECK(found.column_of == std::vector<int>{1, 0});
}

TEST_CASE("Assignments without pairs, and wrong ones", "[association]") {
  CHECK(assign(CostMatrix(0, 3, 0.0), {}).column_of.empty());
  const Assignment none = assign(CostMatrix(2, 2, kForbidden), {1.0, 2.0});
  CHECK(none.column_of == std::vector<int>{-1, -1});
  CHECK(none.cost == Approx(3.0));
  CHECK_THROWS_AS(assign(CostMatrix(1, 1, std::nan("")), {1.0}), core::InputError);
  CHECK_THROWS_AS(assign(CostMatrix(1, 1, 0.0), {kForbidden}), core::InputError);
  CHECK_THROWS_AS(assign(CostMatrix(1, 1, 0.0), {}), core::InputError);
}

TEST_CASE("Joint probabilities are those of all events added up", "[association]") {
  const JointSettings settings{0.9, 0.99, 0.2};
  for (int run = 0; run < 200; ++run) {
    Problem problem = random_problem(run);
    for (double& value : problem.costs.cost) value = std::isinf(value) ? 0.0 : std::exp(-value);
    std::vector<double> existence;
    for (int row = 0; row < problem.costs.rows; ++row) existence.push_back(uniform(run, row, 70));
    CostMatrix belongs(problem.costs.rows, problem.costs.columns, 0.0);
    double total = 0.0;
    std::vector<int> chosen;
    every_event(problem.costs.rows, problem.costs.columns, chosen, [&](const auto& columns) {
      double weight = 1.0;
      for (std::size_t row = 0; row < columns.size(); ++row)
        weight *= columns[row] < 0 ? 1.0 - 0.9 * 0.99 * existence[row]
                                   : 0.9 * existence[row] / 0.2 *
                                         problem.costs.at(static_cast<int>(row), columns[row]);
      total += weight;
      for (std::size_t row = 0; row < columns.size(); ++row)
        if (columns[row] >= 0) belongs.at(static_cast<int>(row), columns[row]) += weight;
    });
    const JointProbabilities found = joint_probabilities(problem.costs, existence, settings);
    for (std::size_t i = 0; i < belongs.cost.size(); ++i)
      REQUIRE(found.belongs.cost[i] == Approx(belongs.cost[i] / total).epsilon(0.0).margin(1e-12));
    for (int row = 0; row < problem.costs.rows; ++row) {
      double sum = found.missed[static_cast<std::size_t>(row)];
      for (int column = 0; column < problem.costs.columns; ++column)
        sum += found.belongs.at(row, column);
      CHECK(sum == Approx(1.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("A track that is not seen becomes less likely to exist, as Bayes has it",
          "[association]") {
  const JointSettings settings{0.9, 1.0, 1e-3};
  const auto unseen = joint_probabilities(CostMatrix(1, 0, 0.0), {0.8}, settings);
  CHECK(unseen.existence[0] == Approx(0.8 * 0.1 / (0.8 * 0.1 + 0.2)).epsilon(1e-12));
  const auto seen = joint_probabilities(CostMatrix(1, 1, 2.0), {0.8}, settings);
  const double there = 0.8 * (0.1 + 0.9 * 2.0 / 1e-3);
  CHECK(seen.existence[0] == Approx(there / (there + 0.2)).epsilon(1e-12));
  CHECK_THROWS_AS(joint_probabilities(CostMatrix(1, 1, -1.0), {0.8}, settings), core::InputError);
}

// More than 16 shared ones were E-LIMIT, in the middle of a run.
TEST_CASE(
    "Where tracks share more measurements than can be summed over, the likeliest count, and the "
    "others are told",
    "[association]") {
  const JointSettings settings{0.9, 0.99, 1e-2};
  constexpr int kColumns = 20;
  CostMatrix likelihood(2, kColumns, 0.0);
  for (int j = 0; j < kColumns; ++j)
    likelihood.at(0, j) = likelihood.at(1, kColumns - 1 - j) = std::ldexp(1.0, -j);
  CHECK(joint_probabilities(CostMatrix(2, 16, 1.0), {0.8, 0.8}, settings).left_out == 0);
  CHECK(joint_probabilities(CostMatrix(2, 17, 1.0), {0.8, 0.8}, settings).left_out == 2);
  // All pairs of two tracks, added up; what lies below 2^-15 of the likeliest is left out.
  const double miss = 1.0 - 0.9 * 0.99 * 0.8, hit = 0.9 * 0.8 / 1e-2;
  double total = miss * miss;
  std::vector<double> first(kColumns, 0.0);
  for (int i = 0; i < kColumns; ++i) {
    double others = miss;
    for (int j = 0; j < kColumns; ++j)
      if (j != i) others += hit * likelihood.at(1, j);
    first[static_cast<std::size_t>(i)] = hit * likelihood.at(0, i) * others;
    total += first[static_cast<std::size_t>(i)] + miss * hit * likelihood.at(1, i);
  }
  const JointProbabilities found = joint_probabilities(likelihood, {0.8, 0.8}, settings);
  CHECK(found.left_out == 2 * 4);
  for (int j = 0; j < kColumns; ++j)
    CHECK(found.belongs.at(0, j) ==
          Approx(first[static_cast<std::size_t>(j)] / total).margin(2e-5).epsilon(0.0));
  // Thirty tracks in forty measurements, all in all gates.
  CostMatrix dense(30, 40, 0.0);
  for (int t = 0; t < dense.rows; ++t)
    for (int j = 0; j < dense.columns; ++j) dense.at(t, j) = 0.1 + 0.02 * ((7 * t + 11 * j) % 37);
  const JointProbabilities all = joint_probabilities(dense, std::vector<double>(30, 0.9), settings);
  CHECK(all.left_out == 30 * 36);  // four each
  for (int t = 0; t < dense.rows; ++t) {
    double sum = all.missed[static_cast<std::size_t>(t)];
    for (int j = 0; j < dense.columns; ++j) sum += all.belongs.at(t, j);
    CHECK(sum == Approx(1.0).epsilon(1e-12));
  }
}

// A column of 40 cars, each near its neighbours' measurements too: 41 measurements in one group. Where the
// middle of the column shares them with a likelihood that does not count, its halves are what they are alone.
TEST_CASE("Joint probabilities take any number of tracks that share measurements with neighbours",
          "[association]") {
  const JointSettings settings{0.9, 0.99, 1e-2};
  constexpr int kTracks = 40;
  const auto likelihood = [](int track, int column) {
    return track == column ? 0.8 : 0.3 + 0.01 * ((7 * track + 3 * column) % 11);
  };
  CostMatrix all(kTracks, kTracks + 1, 0.0);
  for (int t = 0; t < kTracks; ++t)
    for (int j = std::max(t - 1, 0); j <= t + 1; ++j) all.at(t, j) = likelihood(t, j);
  const int half = kTracks / 2;
  all.at(half - 1, half) = all.at(half, half - 1) = 1e-18;
  const std::vector<double> existence(kTracks, 0.9);
  const JointProbabilities found = joint_probabilities(all, existence, settings);
  for (const int first : {0, half}) {
    CostMatrix part(half, half + 1, 0.0);
    for (int t = 0; t < half; ++t)
      for (int j = 0; j <= half; ++j)
        if (all.at(first + t, first + j) > 1e-9) part.at(t, j) = all.at(first + t, first + j);
    const JointProbabilities alone =
        joint_probabilities(part, std::vector<double>(half, 0.9), settings);
    for (int t = 0; t < half; ++t) {
      const auto at = static_cast<std::size_t>(first + t);
      CHECK(found.missed[at] == Approx(alone.missed[static_cast<std::size_t>(t)]).epsilon(1e-9));
      double sum = found.missed[at];
      for (int j = 0; j <= kTracks; ++j) sum += found.belongs.at(first + t, j);
      CHECK(sum == Approx(1.0).epsilon(1e-12));
      for (int j = 0; j <= half; ++j)
        CHECK(found.belongs.at(first + t, first + j) ==
              Approx(alone.belongs.at(t, j)).margin(1e-12).epsilon(1e-9));
    }
  }
}
