#include "materials/rcs/aspect_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace fanbeam::materials {

double lobed_rcs_m2(const LobedRcs& object, const glm::dvec3& direction) {
  const double azimuth_rad = std::atan2(direction.y, direction.x);
  const double elevation_rad = std::asin(std::clamp(direction.z, -1.0, 1.0));
  double strongest_m2 = object.floor_m2;
  for (const AspectLobe& lobe : object.lobes) {
    const double up = (elevation_rad - lobe.elevation_rad) / lobe.elevation_width_rad;
    const double aside =
        lobe.azimuth_width_rad > 0.0
            ? core::wrap_pi_rad(azimuth_rad - lobe.azimuth_rad) / lobe.azimuth_width_rad
            : 0.0;
    strongest_m2 =
        std::max(strongest_m2, lobe.peak_m2 * std::pow(10.0, -1.2 * (up * up + aside * aside)));
  }
  return strongest_m2;
}

}  // namespace fanbeam::materials
