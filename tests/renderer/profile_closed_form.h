// What the profile caster must deliver: the radar equation integrated over straight visible pieces
// of a vertical half-plane, range cell by range cell.
//
//   dP/daz = K integral g_el^2 [sigma0 / sin(psi)] p ds / (p^2 + s^2)^2 ,
// p the sensor's distance from the piece's line, s along it, sin(psi) = q / R with q the distance
// from the facet's plane. Gauss-Legendre quadrature, 8 points between cell borders: relative error
// below 1e-13 for cells shorter than a tenth of their range.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "renderer/casting/profile/profile_caster.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/test_worlds.h"

namespace fanbeam::tests {

// HiVision with a two-way gain of 1 at every elevation.
inline sensors::Sensor even_hivision(int columns) {
  sensors::Sensor sensor = hivision(columns);
  const double reach_rad = core::radians(90.0);
  sensors::BeamCut& elevation = sensor.antenna.elevation;
  elevation.shape = sensors::BeamCut::Shape::table;
  elevation.table_angle_rad = {-reach_rad, reach_rad};
  elevation.table_gain = {1.0, 1.0};
  elevation.cut_rad = reach_rad;
  sensor.antenna.boresight_elevation_rad = 0.0;
  return sensor;
}

// sigma0 = 0.02 sin(psi): the local grazing angle drops out of the radar equation.
inline const materials::PhongNrcs kGamma(0.02, 0.0, 1.0);

// Distance and height of its ends as seen from the sensor, near end first.
struct VisiblePiece {
  glm::dvec2 near_m, far_m;
  materials::PhongNrcs nrcs = kGamma;
  double facet_m = 0.0;  // distance of the facet's plane; 0: the facet lies across the half-plane
};

class PieceIntegral {
 public:
  PieceIntegral(const sensors::Sensor& sensor, const VisiblePiece& piece)
      : sensor_(sensor),
        piece_(piece),
        along_(glm::normalize(piece.far_m - piece.near_m)),
        from_m_(glm::dot(piece.near_m, along_)),
        to_m_(glm::dot(piece.far_m, along_)),
        foot_(piece.near_m - from_m_ * along_),
        facet_m_(piece.facet_m > 0.0 ? piece.facet_m : glm::length(foot_)) {}

  // The part of it at ranges from `near_m` to `far_m`.
  double between(double near_m, double far_m) const {
    const auto along_m = [this](double range_m) {
      return std::sqrt(std::max(range_m * range_m - glm::dot(foot_, foot_), 0.0));
    };
    const double a = along_m(near_m), b = along_m(far_m);
    return integral(std::max(a, from_m_), std::min(b, to_m_)) +
           integral(std::max(-b, from_m_), std::min(-a, to_m_));
  }

 private:
  double integral(double from_m, double to_m) const {
    if (!(to_m > from_m)) return 0.0;
    constexpr std::array<double, 4> kPlace{0.1834346424956498, 0.5255324099163290,
                                           0.7966664774136267, 0.9602898564975363};
    constexpr std::array<double, 4> kWeight{0.3626837833783620, 0.3137066458778873,
                                            0.2223810344533745, 0.1012285362903763};
    const double half_m = (to_m - from_m) / 2, middle_m = (from_m + to_m) / 2;
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      sum += kWeight[i] *
             (density(middle_m - half_m * kPlace[i]) + density(middle_m + half_m * kPlace[i]));
    return sensor_.radar_constant_W_m2() * half_m * sum;
  }
  double density(double along_m) const {
    const glm::dvec2 point = foot_ + along_m * along_;
    const double range_m = glm::length(point), sine = facet_m_ / range_m;
    const double gain = sensors::two_way_gain(
        sensor_.antenna.elevation,
        std::asin(point.y / range_m) - sensor_.antenna.boresight_elevation_rad);
    return gain * piece_.nrcs.sigma0(sine) / sine * glm::length(foot_) / std::pow(range_m, 4);
  }

  const sensors::Sensor& sensor_;
  const VisiblePiece& piece_;
  glm::dvec2 along_;
  double from_m_, to_m_;
  glm::dvec2 foot_;
  double facet_m_;
};

// Power per radian and range cell.
inline std::vector<double> closed_form(const sensors::Sensor& sensor,
                                       const std::vector<VisiblePiece>& pieces) {
  std::vector<double> power_W_per_rad(static_cast<std::size_t>(sensor.range.cells), 0.0);
  for (const VisiblePiece& piece : pieces) {
    const PieceIntegral integral(sensor, piece);
    for (std::size_t k = 0; k < power_W_per_rad.size(); ++k) {
      const double near_m = sensor.range.minimum_m + sensor.range.cell_m * static_cast<double>(k);
      power_W_per_rad[k] += integral.between(near_m, near_m + sensor.range.cell_m);
    }
  }
  return power_W_per_rad;
}

inline sensors::AntennaFrame level_antenna(const glm::dvec3& position_m, double heading_rad = 0.0) {
  const double s = std::sin(heading_rad), c = std::cos(heading_rad);
  return {position_m, {s, c, 0.0}, {c, -s, 0.0}, {0.0, 0.0, 1.0}};
}

inline renderer::FanSums cast_profile(const renderer::World& world, int slices_per_column,
                                      const sensors::AntennaFrame& antenna,
                                      bool with_cscope = false) {
  renderer::FanSums sums;
  renderer::ProfileCaster(world, renderer::profile_sampling_for(slices_per_column))
      .cast(antenna, with_cscope, sums);
  return sums;
}

// With up to 8 slices per column each sub-column has one, in its middle.
inline double slice_azimuth_rad(const renderer::FanSums& sums, int sub_column) {
  return sums.first_azimuth_rad + (sub_column + 0.5) * sums.step_rad;
}

// Largest relative difference of one sub-column; infinite when a cell is lit that should be dark.
// Power below `slivers` of level ground's, `level`, counts relative to that: rounding of where a
// shadow ends is all of a cell that it barely lets be seen.
inline double largest_error(const renderer::FanSums& sums, int sub_column,
                            const std::vector<double>& expected,
                            const std::vector<double>& level = {}, double slivers = 0.0) {
  double largest = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double found = sums.range_W_per_rad[static_cast<std::size_t>(sub_column) *
                                                  static_cast<std::size_t>(sums.cells) +
                                              k];
    if (found == expected[k]) continue;
    const double scale = std::max(expected[k], level.empty() ? 0.0 : slivers * level[k]);
    const double error = std::abs(found - expected[k]) / scale;
    largest =
        std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(largest, error);
  }
  return largest;
}

// A number in (0, 1) for each place of a grid or draw of a test.
inline double uniform(std::uint64_t seed, std::uint64_t cell, std::uint32_t draw = 0) {
  return core::uniform_from(core::random_words({seed, core::kStreamTerrain, 0}, cell, draw)[0]);
}

}  // namespace fanbeam::tests
