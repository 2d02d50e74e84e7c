#include "renderer/stages/range_response.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "renderer/plan/largest_echo.h"
#include "sensors/receiver/point_response.h"

namespace fanbeam::renderer {
namespace {

constexpr double kNegligibleTail = 1e-13;
constexpr double kLeastDrawnShare = 1e-4;

// Gauss-Legendre, 8 points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> kNodes = {0.1834346424956498, 0.5255324099163290,
                                          0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873,
                                            0.2223810344533745, 0.1012285362903763};

// Integral of (1 - |u|) h((k + u) cell) cell over u from `from` to from + 1, in panels.
double half_share(const sensors::PointResponse& response, double k, double cell_m, double from) {
  const int panels = std::max(2, static_cast<int>(std::ceil(2.0 * cell_m / response.scale_m())));
  const double half = 0.5 / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < kNodes.size(); ++i)
      for (const double u : {middle - half * kNodes[i], middle + half * kNodes[i]})
        sum += kWeights[i] * (1.0 - std::abs(u)) * response.density_per_m((k + u) * cell_m);
  }
  return sum * half * cell_m;
}

std::vector<double> shares_of(const sensors::PointResponse& response, double cell_m, int cells) {
  std::vector<double> shares;
  double left = 1.0;
  for (int k = 0; k < cells && left > kNegligibleTail; ++k) {
    shares.push_back(half_share(response, k, cell_m, -1.0) + half_share(response, k, cell_m, 0.0));
    left -= k == 0 ? shares.back() : 2.0 * shares.back();
  }
  return shares;
}

// One row of a picture whose columns share one response; four rows at a time, for fewer passes over
// `to`.
FANBEAM_HOT(void, gather_row,
            (const double* picture, int columns, int cells, int row,
             const std::vector<double>& shares, double* to),
            (picture, columns, cells, row, shares, to)) {
  const int reach = static_cast<int>(shares.size()) - 1;
  const int last = std::min(cells - 1, row + reach);
  const auto share = [&](int from) {
    return shares[static_cast<std::size_t>(std::abs(from - row))];
  };
  const auto line = [&](int from) {
    return picture + static_cast<std::size_t>(from) * static_cast<std::size_t>(columns);
  };
  int from = std::max(0, row - reach);
  for (; from + 3 <= last; from += 4) {
    const double k0 = share(from), k1 = share(from + 1), k2 = share(from + 2), k3 = share(from + 3);
    const double *a = line(from), *b = line(from + 1), *c = line(from + 2), *d = line(from + 3);
    for (int i = 0; i < columns; ++i) to[i] += (k0 * a[i] + k1 * b[i]) + (k2 * c[i] + k3 * d[i]);
  }
  for (; from <= last; ++from) {
    const double k = share(from);
    const double* a = line(from);
    for (int i = 0; i < columns; ++i) to[i] += k * a[i];
  }
}

double gathered(const std::vector<double>& cell_W, int row, const std::vector<double>& shares) {
  const int reach = static_cast<int>(shares.size()) - 1;
  const int last = std::min(static_cast<int>(cell_W.size()) - 1, row + reach);
  double sum = 0.0;
  for (int from = std::max(0, row - reach); from <= last; ++from)
    sum += shares[static_cast<std::size_t>(std::abs(from - row))] *
           cell_W[static_cast<std::size_t>(from)];
  return sum;
}

// The most of `cell_W` [cell] after the response, in any column.
std::vector<double> largest_after(const RangeResponse& response, const sensors::Sensor& sensor,
                                  const std::vector<double>& cell_W) {
  std::vector<double> most_W(cell_W.size(), 0.0);
  // Columns differ by their bandwidth alone; where they do not, one stands for all.
  const int columns = sensors::point_response_varies(sensor) ? sensor.scan.columns : 1;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < sensor.range.cells; ++row) {
      const double power_W = gathered(cell_W, row, response.shares(column));
      most_W[static_cast<std::size_t>(row)] =
          std::max(most_W[static_cast<std::size_t>(row)], power_W);
    }
  return most_W;
}

}  // namespace

RangeResponse::RangeResponse(const sensors::Sensor& sensor)
    : columns_(sensor.scan.columns), cells_(sensor.range.cells) {
  shares_.resize(sensors::point_response_varies(sensor) ? static_cast<std::size_t>(columns_) : 1);
  core::parallel_for(shares_.size(), [&](std::size_t column) {
    shares_[column] = shares_of(sensors::PointResponse(sensor, static_cast<int>(column)),
                                sensor.range.cell_m, cells_);
  });
}

const std::vector<double>& RangeResponse::shares(int column) const {
  return shares_.size() == 1 ? shares_.front() : shares_[static_cast<std::size_t>(column)];
}

void RangeResponse::apply(std::vector<double>& image) const {
  const std::vector<double> before = image;
  const auto columns = static_cast<std::size_t>(columns_);
  core::parallel_for(static_cast<std::size_t>(cells_), [&](std::size_t row) {
    double* const to = &image[row * columns];
    std::fill(to, to + columns, 0.0);
    if (shares_.size() == 1) {
      gather_row(before.data(), columns_, cells_, static_cast<int>(row), shares_.front(), to);
      return;
    }
    for (std::size_t from = 0; from < static_cast<std::size_t>(cells_); ++from) {
      const std::size_t k = from > row ? from - row : row - from;
      for (std::size_t column = 0; column < columns; ++column)
        if (k < shares_[column].size())
          to[column] += shares_[column][k] * before[from * columns + column];
    }
  });
}

std::vector<TargetShare> RangeResponse::spread(const std::vector<TargetShare>& targets,
                                               std::vector<double>& image) const {
  std::vector<TargetShare> drawn;
  const auto columns = static_cast<std::size_t>(columns_);
  for (const TargetShare& target : targets) {
    const std::vector<double>& part = shares(static_cast<int>(target.column));
    const auto row = static_cast<int>(target.cell / columns);
    const int reach = static_cast<int>(part.size()) - 1;
    for (int to = std::max(0, row - reach); to <= std::min(cells_ - 1, row + reach); ++to) {
      const double share = part[static_cast<std::size_t>(std::abs(to - row))];
      const std::size_t cell = static_cast<std::size_t>(to) * columns + target.column;
      if (share >= kLeastDrawnShare) {
        drawn.push_back({target.target, target.column, cell, target.power * share});
      } else {
        image[cell] += target.power * share;
      }
    }
  }
  return drawn;
}

bool has_range_response(const SceneFacts& facts) {
  return sensors::has_point_response(facts.sensor);
}

std::vector<double> largest_spread(const sensors::Sensor& sensor, std::vector<double> cell_W) {
  if (!sensors::has_point_response(sensor)) return cell_W;
  const std::vector<double> after_W = largest_after(RangeResponse(sensor), sensor, cell_W);
  for (std::size_t i = 0; i < cell_W.size(); ++i) cell_W[i] = std::max(cell_W[i], after_W[i]);
  return cell_W;
}

double range_response_bound_dB(const SceneFacts& facts) {
  const sensors::Sensor& sensor = facts.sensor;
  if (corners_possible(facts)) return window_dB(sensor);
  const RangeResponse response(sensor);
  double least_kept = 1.0;
  for (int column = 0; column < sensor.scan.columns; ++column)
    least_kept = std::min(least_kept, response.shares(column)[0]);
  const std::vector<double> echo_W =
      largest_echo(all_sources(facts), whole_beam(sensor), sensor).cell_W;
  AddedPower beside{largest_after(response, sensor, echo_W)};
  for (std::size_t i = 0; i < echo_W.size(); ++i) beside.cell_W[i] -= least_kept * echo_W[i];
  return std::clamp(-10.0 * std::log10(least_kept), largest_change_dB(beside, facts),
                    window_dB(sensor));
}

}  // namespace fanbeam::renderer
