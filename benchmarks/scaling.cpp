#include "benchmarks/scaling.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "benchmarks/view_clock.h"
#include "core/median.h"

namespace fanbeam::benchmarks {
namespace {

constexpr double kSide_m = 12000.0;

// A square around the middle of `ground`, as large as it allows up to kSide_m.
terrain::HeightField resampled(const terrain::HeightField& ground, int cells) {
  const double side_m =
      std::min({kSide_m, ground.east_m() - ground.west_m, ground.north_m() - ground.south_m});
  terrain::HeightField field;
  field.west_m = (ground.west_m + ground.east_m() - side_m) / 2.0;
  field.south_m = (ground.south_m + ground.north_m() - side_m) / 2.0;
  field.spacing_m = side_m / cells;
  field.columns = field.rows = cells + 1;
  for (int row = 0; row < field.rows; ++row) {
    const double y_m =
        std::clamp(field.south_m + row * field.spacing_m, ground.south_m, ground.north_m());
    for (int column = 0; column < field.columns; ++column) {
      const double x_m =
          std::clamp(field.west_m + column * field.spacing_m, ground.west_m, ground.east_m());
      field.height_m.push_back(ground.height_at(x_m, y_m).value());
    }
  }
  const auto nearest = [&](double from_start_m, int posts) {
    return std::clamp(static_cast<int>(from_start_m / ground.spacing_m), 0, posts - 2);
  };
  for (int row = 0; row < cells; ++row) {
    const double y_m = field.south_m + (row + 0.5) * field.spacing_m;
    for (int column = 0; column < cells; ++column) {
      const double x_m = field.west_m + (column + 0.5) * field.spacing_m;
      field.cell_material.push_back(
          ground.cell_material[ground.cell(nearest(x_m - ground.west_m, ground.columns),
                                           nearest(y_m - ground.south_m, ground.rows))]);
    }
  }
  return field;
}

struct Candidate {
  Candidate(const View& view, terrain::HeightField ground)
      : spacing_m(ground.spacing_m),
        world{.geometry = std::make_shared<renderer::Geometry>(
                  renderer::Geometry{std::make_unique<terrain::RayScene>(
                      std::move(ground), view.world().surfaces().surface_map()->patches(),
                      std::vector<terrain::PlacedMesh>{})}),
              .nrcs = view.world().nrcs,
              .attenuation = view.world().attenuation,
              .sensor = view.sensor()},
        rays(surfaces_clock(world, view, renderer::sampling_for(renderer::kDefaultRaysPerCell))),
        slices(surfaces_clock(world, view,
                              renderer::profile_sampling_for(renderer::kDefaultSlicesPerColumn))) {}

  double spacing_m;
  renderer::World world;
  FrameClock rays, slices;
  std::vector<double> rays_ms{}, slices_ms{};
};

}  // namespace

std::vector<ScalingStep> measure_scaling(const View& view, const Effort& effort) {
  fmt::print(stderr, "{}: its ground at several spacings\n", view.scene->name);
  // Held by pointer: the clocks refer to the world beside them.
  std::vector<std::unique_ptr<Candidate>> candidates;
  for (const int cells : effort.scaling_cells)
    candidates.push_back(
        std::make_unique<Candidate>(view, resampled(*view.world().surfaces().terrain(), cells)));
  for (int turn = 0; turn < effort.scaling_turns; ++turn) {
    for (const auto& candidate : candidates) {
      candidate->rays_ms.push_back(candidate->rays.second_frame_ms());
      candidate->slices_ms.push_back(candidate->slices.second_frame_ms());
    }
  }
  std::vector<ScalingStep> steps;
  for (const auto& candidate : candidates)
    steps.push_back({candidate->spacing_m, candidate->world.surfaces().triangle_count(),
                     core::median(candidate->rays_ms), core::median(candidate->slices_ms)});
  return steps;
}

}  // namespace fanbeam::benchmarks
