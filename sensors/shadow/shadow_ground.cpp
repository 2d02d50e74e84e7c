#include "sensors/shadow/shadow_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/decibel.h"
#include "core/median.h"

namespace fanbeam::sensors {
namespace {

constexpr int kBandRows = 16;   // half of a histogram's band
constexpr int kTrendRows = 40;  // half of the window that smooths the modes over range
constexpr std::size_t kBins = 200;
constexpr double kBinsPerDecibel = 2.0;
constexpr double kLeastClutter = 0.26;  // over noise: 1 dB above it
constexpr double kClearlyAboveNoise = 4.0;

using Histogram = std::array<int, kBins>;

std::size_t bin_of(double power_over_noise) {
  if (!(power_over_noise > 1.0)) return 0;
  const double bin = kBinsPerDecibel * core::dB_from_power(power_over_noise, 0.0);
  return static_cast<std::size_t>(std::min(bin, kBins - 1.0));
}

// Clutter over noise at the fullest place of five bins; never quite 0.
double mode(const Histogram& histogram) {
  int most = -1;
  std::size_t middle = 0;
  for (std::size_t bin = 2; bin + 2 < kBins; ++bin) {
    const auto first = histogram.begin() + static_cast<std::ptrdiff_t>(bin) - 2;
    int sum = 0;
    for (auto count = first; count != first + 5; ++count) sum += *count;
    if (sum <= most) continue;
    most = sum;
    middle = bin;
  }
  // The lowest place stands for noise alone.
  const double level_dB =
      middle == 2 ? 0.25 : (static_cast<double>(middle) + 0.5) / kBinsPerDecibel;
  return core::power_from_dB(level_dB) - 1.0;
}

// Clutter over noise by row.
std::vector<double> clutter_by_row(std::span<const double> power_W, int rows, std::size_t columns,
                                   double noise_W) {
  std::vector<std::size_t> bins(power_W.size());
  std::transform(power_W.begin(), power_W.end(), bins.begin(),
                 [&](double value_W) { return bin_of(value_W / noise_W); });
  Histogram histogram{};
  const auto count_row = [&](int row, int step) {
    if (row < 0 || row >= rows) return;
    const auto begin = bins.begin() + static_cast<std::ptrdiff_t>(row * static_cast<int>(columns));
    for (auto bin = begin; bin != begin + static_cast<std::ptrdiff_t>(columns); ++bin)
      histogram[*bin] += step;
  };
  for (int row = 0; row < kBandRows; ++row) count_row(row, 1);
  std::vector<double> sum_ln(static_cast<std::size_t>(rows) + 1, 0.0);
  for (int row = 0; row < rows; ++row) {
    count_row(row + kBandRows, 1);
    count_row(row - kBandRows - 1, -1);
    const auto i = static_cast<std::size_t>(row);
    sum_ln[i + 1] = sum_ln[i] + std::log(mode(histogram));
  }
  std::vector<double> clutter(static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    const int from = std::max(row - kTrendRows, 0), to = std::min(row + kTrendRows + 1, rows);
    clutter[static_cast<std::size_t>(row)] =
        std::exp((sum_ln[static_cast<std::size_t>(to)] - sum_ln[static_cast<std::size_t>(from)]) /
                 (to - from));
  }
  return clutter;
}

double fluctuation_of(std::span<const double> power_W, std::size_t columns, double noise_W) {
  std::vector<double> steps;
  const double least_W = kClearlyAboveNoise * noise_W;
  for (std::size_t i = columns; i < power_W.size(); ++i)
    if (power_W[i] > least_W && power_W[i - columns] > least_W)
      steps.push_back(std::abs(std::log(power_W[i] / power_W[i - columns])));
  return core::median(std::move(steps)) / std::log(3.0);
}

}  // namespace

ShadowGround shadow_ground(const Sensor& sensor, std::span<const double> power_W) {
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const double noise_W = sensor.noise_power_W();
  const std::vector<double> clutter = clutter_by_row(power_W, sensor.range.cells, columns, noise_W);
  ShadowGround ground;
  ground.columns = sensor.scan.columns;
  ground.fluctuation = fluctuation_of(power_W, columns, noise_W);
  for (std::size_t row = 0; row < clutter.size(); ++row) {
    ground.noise.push_back(1.0 / clutter[row]);
    if (clutter[row] > kLeastClutter) ground.rows_end = static_cast<int>(row) + 1;
  }
  ground.q.resize(power_W.size());
  for (std::size_t i = 0; i < power_W.size(); ++i)
    ground.q[i] = (power_W[i] / noise_W - 1.0) * ground.noise[i / columns];
  return ground;
}

}  // namespace fanbeam::sensors
