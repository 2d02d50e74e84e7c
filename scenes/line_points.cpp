#include "scenes/line_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"

namespace fanbeam::scenes {
namespace {

// z along the line.
glm::dmat3 axes_along(const glm::dvec3& z) {
  const glm::dvec3 aside = std::abs(z.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(aside, z));
  return {x, glm::cross(z, x), z};
}

}  // namespace

double across_wire_rad(double sin_slope, core::Polarisation polarisation) {
  const double slope_rad = std::asin(std::min(1.0, std::abs(sin_slope)));
  return polarisation == core::Polarisation::horizontal ? slope_rad : core::kPi / 2.0 - slope_rad;
}

int line_point_count(const LineDescription& line, double length_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / line.spacing_m)));
}

void add_line_points(const LineDescription& line, const glm::dvec3& begin_m,
                     const glm::dvec3& end_m, core::Polarisation polarisation,
                     std::vector<renderer::PointTarget>& targets) {
  const glm::dvec3 path_m = end_m - begin_m;
  const double length_m = glm::length(path_m);
  const int count = line_point_count(line, length_m);
  materials::RcsModel rcs = materials::ConstantRcs{line.rcs_m2_per_m * length_m / count};
  glm::dmat3 axes(1.0);
  if (line.object) rcs = *line.object;
  if (line.wire && length_m > 0.0) {
    const glm::dvec3 along = path_m / length_m;
    const double across_rad =
        line.wire->polarisation_rad.value_or(across_wire_rad(along.z, polarisation));
    rcs = materials::RoundWire{line.wire->radius_m, length_m / count, across_rad,
                               line.wire->coherence_length_m};
    axes = axes_along(along);
  }
  for (int i = 0; i < count; ++i)
    targets.push_back(
        {line.name, rcs, {{0.0, begin_m + path_m * ((i + 0.5) / count)}}, axes, line.swerling});
}

}  // namespace fanbeam::scenes
