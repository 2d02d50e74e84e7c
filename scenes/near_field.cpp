#include "scenes/near_field.h"

#include <cmath>

namespace fanbeam::scenes {

void NearField::look_at(const materials::RcsModel& rcs, const std::string& name,
                        const core::Place& place) {
  const double far_field_m = materials::far_field_distance_m(rcs, sensor_.wavelength_m());
  if (far_field_m <= sensor_.range.maximum_m()) return;
  if (count_++ > 0) return;
  far_field_m_ = far_field_m;
  name_ = name;
  place_ = place;
}

void NearField::report(core::ProblemList& problems) const {
  if (count_ == 0) return;
  const std::string others =
      count_ > 1 ? " (" + std::to_string(count_ - 1) + " more such targets)" : "";
  problems.warning(
      "NEAR-FIELD", place_, "target '" + name_ + "', far field",
      "from " + core::number_text(std::round(far_field_m_)) + " m",
      "beyond the sensor's " + core::number_text(std::round(sensor_.range.maximum_m())) +
          " m; the far-field cross-section is used, an upper bound: that the parts of the shape "
          "are not in phase nearer by is neglected" +
          others);
}

}  // namespace fanbeam::scenes
