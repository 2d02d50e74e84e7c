// Values of pictures and fans.
#pragma once

#include <cstring>
#include <numeric>
#include <vector>

namespace fanbeam::tests {

inline bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

inline double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace fanbeam::tests
