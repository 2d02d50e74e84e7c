#include "renderer/surfaces/nrcs_table.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

double NrcsTable::sine_of(int index) {
  if (index < kCoarse) return index / kFinePer;
  if (index < kSteep) return (index - kCoarseAt0) / kCoarsePer;
  return std::min((index - kSteepAt0) / kSteepPer, 1.0);
}

NrcsTable::NrcsTable(const materials::NrcsCurve& nrcs) {
  const auto ratio = [&nrcs](double sine) { return nrcs.sigma0(sine) / sine; };
  values_.reserve(kEntries);
  // At 0 the limit, unless it is infinite.
  values_.push_back(std::min(ratio(sine_of(1) * 1e-9), ratio(sine_of(1))));
  for (int i = 1; i < kEntries; ++i) values_.push_back(ratio(sine_of(i)));
  const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
  constexpr double kRounding = 1e-14;
  // Exactly even where sigma0 is proportional to sin(psi).
  if (*most - *least <= kRounding * *most) std::fill(values_.begin(), values_.end(), values_[0]);
}

double NrcsTable::largest() const { return *std::max_element(values_.begin(), values_.end()); }

double NrcsTable::largest_change_dB(const NrcsTable& other) const {
  double most_dB = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (values_[i] != other.values_[i])
      most_dB = std::max(most_dB, std::abs(10.0 * std::log10(values_[i] / other.values_[i])));
  return most_dB;
}

}  // namespace fanbeam::renderer
