#include "renderer/stages/fluctuation.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/constants.h"
#include "core/parallel.h"
#include "core/random.h"
#include "renderer/stages/echo_shares.h"

namespace fanbeam::renderer {
namespace {

using core::Swerling;
using core::uniform_from;

constexpr std::uint32_t kWholeFrame = 0xFFFFFFFFU;  // in place of a column

core::RandomKey key_of(const Fluctuation& fluctuation, std::uint32_t stream) {
  return {fluctuation.seed, stream, fluctuation.frame};
}

std::array<std::uint32_t, 4> target_words(const Fluctuation& fluctuation, std::uint32_t target,
                                          std::uint32_t column, std::uint32_t look) {
  return core::random_words(key_of(fluctuation, core::kStreamTarget),
                            target + (std::uint64_t{column} << 32U), look);
}

// Attempt k takes the draws 2k and 2k + 1; fewer than 1 in 100 need a second.
double gamma_by_rejection(const core::RandomKey& key, std::uint64_t cell, int order) {
  const double d = order - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  for (std::uint32_t attempt = 0;; ++attempt) {
    const double x = core::normal_pair(key, cell, 2 * attempt)[0];
    const double u = uniform_from(core::random_words(key, cell, 2 * attempt + 1)[0]);
    const double root = 1.0 + c * x;
    if (!(root > 0.0)) continue;
    const double v = root * root * root;
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v;
  }
}

// One cell with targets in it: look by look, as complex amplitudes.
double realised_cell(std::span<const TargetShare> shares, std::span<const Swerling> cases,
                     const Fluctuation& fluctuation, std::uint32_t stream, double diffuse) {
  const double deviation = std::sqrt(0.5 * diffuse);
  double sum = 0.0;
  for (std::uint32_t look = 0; look < static_cast<std::uint32_t>(fluctuation.looks); ++look) {
    const auto [real, imaginary] =
        core::normal_pair(key_of(fluctuation, stream), shares[0].cell, look);
    std::complex<double> amplitude(deviation * real, deviation * imaginary);
    for (const TargetShare& share : shares) {
      const double power = share.power * target_factor(cases[share.target], fluctuation,
                                                       share.target, share.column, look);
      const std::uint32_t word = target_words(fluctuation, share.target, share.column, look)[0];
      amplitude += std::polar(std::sqrt(power), 2.0 * core::kPi * uniform_from(word));
    }
    sum += std::norm(amplitude);
  }
  return sum / fluctuation.looks;
}

double mean_factor(const TargetShare& share, Swerling target_case, const Fluctuation& fluctuation) {
  double sum = 0.0;
  for (std::uint32_t look = 0; look < static_cast<std::uint32_t>(fluctuation.looks); ++look)
    sum += target_factor(target_case, fluctuation, share.target, share.column, look);
  return sum / fluctuation.looks;
}

void realise_row(std::size_t begin, std::span<double> row, const std::vector<TargetShare>& shares,
                 std::span<const Swerling> cases, const Fluctuation& fluctuation,
                 std::uint32_t stream, double noise) {
  auto share = std::lower_bound(
      shares.begin(), shares.end(), begin,
      [](const TargetShare& candidate, std::size_t cell) { return candidate.cell < cell; });
  thread_local std::vector<double> factors;
  factors.resize(row.size());
  speckle_factors(fluctuation, stream, begin, factors);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double diffuse = row[i] + noise;
    const auto first = share;
    while (share != shares.end() && share->cell == begin + i) ++share;
    if (first != share)
      row[i] = realised_cell({first, share}, cases, fluctuation, stream, diffuse);
    else if (diffuse > 0.0)
      row[i] = diffuse * factors[i];
  }
}

}  // namespace

std::vector<TargetShare> bscope_shares(const std::vector<core::Echo>& echoes,
                                       const sensors::Sensor& sensor) {
  std::vector<TargetShare> shares;
  for (const core::Echo& echo : echoes)
    share_echo(echo, sensor, [&](int cell, int column, double power_W) {
      shares.push_back({echo.object_id, static_cast<std::uint32_t>(column),
                        static_cast<std::size_t>(cell * sensor.scan.columns + column), power_W});
    });
  return shares;
}

std::vector<TargetShare> cscope_shares(const std::vector<core::Echo>& echoes,
                                       const sensors::Sensor& sensor) {
  std::vector<TargetShare> shares;
  for (const core::Echo& echo : echoes) {
    const int row = sensors::cscope_row(sensor.display, echo.elevation_rad);
    if (row == sensors::kOutside) continue;
    share_echo(echo, sensor, [&](int, int column, double power_W) {
      shares.push_back({echo.object_id, static_cast<std::uint32_t>(column),
                        static_cast<std::size_t>(row * sensor.scan.columns + column),
                        power_W * echo.range_m * echo.range_m * echo.range_m});
    });
  }
  return shares;
}

void realise(std::vector<TargetShare> shares, std::span<const Swerling> cases,
             const Fluctuation& fluctuation, std::uint32_t stream, double noise, int columns,
             std::vector<double>& picture) {
  if (!fluctuation.speckle) {
    for (const TargetShare& share : shares)
      picture[share.cell] += share.power * mean_factor(share, cases[share.target], fluctuation);
    return;
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const TargetShare& a, const TargetShare& b) { return a.cell < b.cell; });
  const auto width = static_cast<std::size_t>(columns);
  core::parallel_for(picture.size() / width, [&](std::size_t row) {
    realise_row(row * width, std::span(picture).subspan(row * width, width), shares, cases,
                fluctuation, stream, noise);
  });
}

void speckle_factors(const Fluctuation& fluctuation, std::uint32_t stream, std::uint64_t first,
                     std::span<double> factors) {
  const core::RandomKey key = key_of(fluctuation, stream);
  const int looks = fluctuation.looks;
  if (looks <= core::kMostExponentials) {
    core::sums_of_exponentials(key, first, looks, factors);
  } else {
    for (std::size_t i = 0; i < factors.size(); ++i)
      factors[i] = gamma_by_rejection(key, first + i, looks);
  }
  for (double& factor : factors) factor /= looks;
}

double target_factor(Swerling target_case, const Fluctuation& fluctuation, std::uint32_t target,
                     std::uint32_t column, std::uint32_t look) {
  if (!fluctuation.swerling || target_case == Swerling::steady) return 1.0;
  const bool whole_frame = target_case == Swerling::case1 || target_case == Swerling::case3;
  const auto words = whole_frame ? target_words(fluctuation, target, kWholeFrame, 0)
                                 : target_words(fluctuation, target, column, look);
  const double u = uniform_from(words[1]);
  if (target_case == Swerling::case1 || target_case == Swerling::case2) return -std::log(u);
  return -0.5 * std::log(u * uniform_from(words[2]));
}

}  // namespace fanbeam::renderer
