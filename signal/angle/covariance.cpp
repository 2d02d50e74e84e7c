#include "signal/angle/covariance.h"

#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

int checked_elements(const Snapshots& snapshots) {
  if (snapshots.empty() || snapshots.front().empty())
    refuse("snapshots", static_cast<double>(snapshots.size()), "at least one, not empty");
  for (const auto& snapshot : snapshots) {
    if (snapshot.size() != snapshots.front().size())
      refuse("snapshots", static_cast<double>(snapshot.size()), "all of one size");
    check_finite("snapshots", snapshot);
  }
  return static_cast<int>(snapshots.front().size());
}

}  // namespace

Covariance sample_covariance(const Snapshots& snapshots) {
  Covariance covariance;
  covariance.elements = checked_elements(snapshots);
  const int n = covariance.elements;
  covariance.values.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (const auto& x : snapshots)
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        covariance.at(row, column) +=
            x[static_cast<std::size_t>(row)] * std::conj(x[static_cast<std::size_t>(column)]);
  for (auto& value : covariance.values) value /= static_cast<double>(snapshots.size());
  return covariance;
}

Covariance smoothed_covariance(const Snapshots& snapshots, int subarray_elements) {
  const int n = checked_elements(snapshots);
  const int k = subarray_elements;
  if (k < 1 || k > n) refuse("subarray_elements", k, "1 to the number of elements");
  Snapshots shifted;
  shifted.reserve(2 * snapshots.size() * static_cast<std::size_t>(n - k + 1));
  for (const auto& x : snapshots)
    for (int first = 0; first + k <= n; ++first) {
      const std::vector<std::complex<double>> forward(x.begin() + first, x.begin() + first + k);
      std::vector<std::complex<double>> backward(forward.rbegin(), forward.rend());
      for (auto& value : backward) value = std::conj(value);
      shifted.push_back(forward);
      shifted.push_back(backward);
    }
  return sample_covariance(shifted);
}

}  // namespace fanbeam::signal
