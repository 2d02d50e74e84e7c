#include "scenes/new_scene/terrain_extent.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

constexpr int kPointsOfSide = 41;
constexpr double kStep_m = 50.0;
constexpr double kBeyondFlight_m = 20.0;  // the last posts lie up to a spacing further out
constexpr int kMostSteps = 4000;

// How many points of each side lie outside the data: west, east, south, north.
std::array<int, 4> outside_of(const terrain::LocalFrame& frame, const TerrainExtent& extent,
                              const std::function<bool(const core::Geodetic&)>& covers) {
  std::array<int, 4> outside{};
  const auto test = [&](std::size_t side, double x_m, double y_m) {
    const core::Geodetic at = frame.to_geodetic({x_m + std::copysign(kBeyondFlight_m, x_m),
                                                 y_m + std::copysign(kBeyondFlight_m, y_m), 0.0});
    if (!covers(at)) ++outside[side];
  };
  for (int i = 0; i < kPointsOfSide; ++i) {
    const double t = static_cast<double>(i) / (kPointsOfSide - 1);
    const double x_m = -extent.west_m + t * (extent.west_m + extent.east_m);
    const double y_m = -extent.south_m + t * (extent.south_m + extent.north_m);
    test(0, -extent.west_m, y_m);
    test(1, extent.east_m, y_m);
    test(2, x_m, -extent.south_m);
    test(3, x_m, extent.north_m);
  }
  return outside;
}

}  // namespace

TerrainExtent extent_around(const core::Geodetic& origin, const std::vector<core::Geodetic>& places,
                            double margin_m) {
  const terrain::LocalFrame frame(origin);
  TerrainExtent extent;
  for (const core::Geodetic& place : places) {
    const glm::dvec3 local_m =
        frame.to_local_m({place.latitude_rad, place.longitude_rad, origin.height_m});
    extent.west_m = std::max(extent.west_m, -local_m.x);
    extent.east_m = std::max(extent.east_m, local_m.x);
    extent.south_m = std::max(extent.south_m, -local_m.y);
    extent.north_m = std::max(extent.north_m, local_m.y);
  }
  for (double* side_m : {&extent.west_m, &extent.east_m, &extent.south_m, &extent.north_m})
    *side_m = std::ceil((*side_m + margin_m) / kStep_m) * kStep_m;
  return extent;
}

std::optional<TerrainExtent> covered_extent(
    const core::Geodetic& origin, const TerrainExtent& least, const TerrainExtent& most,
    const std::function<bool(const core::Geodetic&)>& covers) {
  const terrain::LocalFrame frame(origin);
  TerrainExtent extent{std::max(least.west_m, most.west_m), std::max(least.east_m, most.east_m),
                       std::max(least.south_m, most.south_m),
                       std::max(least.north_m, most.north_m)};
  const std::array<double*, 4> sides_m = {&extent.west_m, &extent.east_m, &extent.south_m,
                                          &extent.north_m};
  const std::array<double, 4> least_m = {least.west_m, least.east_m, least.south_m, least.north_m};
  for (int step = 0; step < kMostSteps; ++step) {
    const std::array<int, 4> outside = outside_of(frame, extent, covers);
    // The side that sticks out most is drawn in first: its corners belong to others too.
    std::optional<std::size_t> worst;
    bool covered = true;
    for (std::size_t i = 0; i < outside.size(); ++i) {
      covered = covered && outside[i] == 0;
      if (outside[i] == 0 || *sides_m[i] <= least_m[i]) continue;
      if (!worst || outside[i] > outside[*worst]) worst = i;
    }
    if (covered) return extent;
    if (!worst) return std::nullopt;
    *sides_m[*worst] = std::max(least_m[*worst], *sides_m[*worst] - kStep_m);
  }
  return std::nullopt;
}

}  // namespace fanbeam::scenes
