// Another project's program: uses what fanbeam installs and exits with 0 when the answers are
// right.
#include <cmath>

#include "core/decibel.h"
#include "terrain/local_frame.h"

int main() {
  const fanbeam::terrain::LocalFrame frame({0.9, 0.2, 100.0});
  const glm::dvec3 origin_m = frame.to_local_m({0.9, 0.2, 100.0});
  const bool at_origin = std::abs(origin_m.x) + std::abs(origin_m.y) + std::abs(origin_m.z) < 1e-6;
  return at_origin && fanbeam::core::power_from_dB(0.0) == 1.0 ? 0 : 1;
}
