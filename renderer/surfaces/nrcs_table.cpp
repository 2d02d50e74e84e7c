#include "renderer/surfaces/nrcs_table.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

NrcsTable::NrcsTable(const materials::NrcsCurve& nrcs) {
  const auto ratio = [&nrcs](double sine) { return nrcs.sigma0(sine) / sine; };
  // At 0 the limit, unless it is infinite.
  const auto lowest = [&ratio](double first_sine) {
    return std::min(ratio(first_sine * 1e-9), ratio(first_sine));
  };
  values_.reserve(kEntries);
  for (int i = 0; i < kCoarseEntries; ++i) {
    const double sine = std::min(static_cast<double>(i) / kSteps, 1.0);
    values_.push_back(i == 0 ? lowest(1.0 / kSteps) : ratio(sine));
  }
  for (int i = 0; i <= kFineSteps; ++i) {
    const double sine = kFineBelow * i / kFineSteps;
    values_.push_back(i == 0 ? lowest(kFineBelow / kFineSteps) : ratio(sine));
  }
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
