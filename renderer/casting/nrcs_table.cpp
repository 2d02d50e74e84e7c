#include "renderer/casting/nrcs_table.h"

namespace fanbeam::renderer {

NrcsTable::NrcsTable(const materials::PhongNrcs& nrcs) : nrcs_(nrcs) {
  for (int i = 0; i <= kSteps + 1; ++i) {
    const double sine = std::fmin(static_cast<double>(i) / kSteps, 1.0);
    values_.push_back(i == 0 ? 0.0 : nrcs.sigma0(sine) / sine);
  }
  const double half = nrcs.sigma0(0.5) / 0.5;
  flat_ = half == values_[kSteps] && half == nrcs.sigma0(0.1) / 0.1;
  values_[0] = flat_ ? half : values_[1];
}

}  // namespace fanbeam::renderer
