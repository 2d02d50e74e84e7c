#include "terrain/landscape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/random.h"

namespace fanbeam::terrain {
namespace {

std::uint64_t lattice_cell(std::int64_t i, std::int64_t j) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(static_cast<std::int32_t>(i)))
          << 32U) |
         static_cast<std::uint32_t>(static_cast<std::int32_t>(j));
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

Landscape::Landscape(const LandscapeSettings& settings, LandscapeMaterials materials)
    : settings_(settings), materials_(std::move(materials)) {
  // The noise of is_wood has a nearly normal distribution of deviation 0.31; the quantile is the
  // logistic one.
  const double share = std::clamp(settings.wood_share, 1e-6, 1.0 - 1e-6);
  wood_threshold_ =
      settings.wood_share > 0.0 ? 0.31 / 1.702 * std::log((1.0 - share) / share) : 2.0;
}

double Landscape::noise(glm::dvec2 position_m, double lattice_m, std::uint32_t octave) const {
  const core::RandomKey key{settings_.seed, core::kStreamTerrain, octave};
  const double u = position_m.x / lattice_m;
  const double v = position_m.y / lattice_m;
  const auto i = static_cast<std::int64_t>(std::floor(u));
  const auto j = static_cast<std::int64_t>(std::floor(v));
  const double fu = smooth(u - static_cast<double>(i));
  const double fv = smooth(v - static_cast<double>(j));
  const auto at = [&](std::int64_t di, std::int64_t dj) {
    return 2.0 * core::uniform_from(core::random_words(key, lattice_cell(i + di, j + dj), 0)[0]) -
           1.0;
  };
  return (at(0, 0) * (1 - fu) + at(1, 0) * fu) * (1 - fv) +
         (at(0, 1) * (1 - fu) + at(1, 1) * fu) * fv;
}

double Landscape::ground_m(glm::dvec2 position_m) const {
  return settings_.relief_m / 2 *
         (0.6 * noise(position_m, 2000.0, 0) + 0.28 * noise(position_m, 800.0, 1) +
          0.12 * noise(position_m, 320.0, 2));
}

bool Landscape::is_wood(glm::dvec2 position_m) const {
  return 0.8 * noise(position_m, 700.0, 3) + 0.2 * noise(position_m, 150.0, 4) > wood_threshold_;
}

double Landscape::canopy_m(glm::dvec2 position_m) const {
  if (!is_wood(position_m)) return 0.0;
  return settings_.canopy_m * (1.0 + 0.1 * noise(position_m, 40.0, 5));
}

MaterialId Landscape::material(glm::dvec2 position_m) const {
  return is_wood(position_m) ? materials_.wood : field(position_m);
}

MaterialId Landscape::field(glm::dvec2 position_m) const {
  const core::RandomKey key{settings_.seed, core::kStreamTerrain, 6};
  const double size_m = settings_.field_size_m;
  const auto i = static_cast<std::int64_t>(std::floor(position_m.x / size_m));
  const auto j = static_cast<std::int64_t>(std::floor(position_m.y / size_m));
  double nearest = 1e300;
  std::uint32_t chosen = 0;
  for (std::int64_t dj = -1; dj <= 1; ++dj) {
    for (std::int64_t di = -1; di <= 1; ++di) {
      const auto words = core::random_words(key, lattice_cell(i + di, j + dj), 0);
      const glm::dvec2 seed(size_m * (static_cast<double>(i + di) + core::uniform_from(words[0])),
                            size_m * (static_cast<double>(j + dj) + core::uniform_from(words[1])));
      const double distance = glm::length(seed - position_m);
      if (distance < nearest) {
        nearest = distance;
        chosen = words[2];
      }
    }
  }
  return materials_.fields[chosen % materials_.fields.size()];
}

}  // namespace fanbeam::terrain
