#include "measure/numerics.h"

#include <fmt/core.h>

#include "core/turns.h"
#include "measure/frame_clock.h"
#include "measure/range_check.h"

namespace fanbeam::measure {
namespace {

// As many slices per column, split otherwise.
constexpr int kSlicesSplit = 8;
constexpr int kSubColumns[] = {1, 2, 4, 8};

struct Candidate {
  std::string comparison, name;
  const renderer::World* world;
  renderer::Sampling sampling;
};

std::vector<Candidate> candidates(const CostBench& bench, const scenes::Scene& fragile) {
  const renderer::World& world = bench.scene.world;
  const renderer::Sampling rays = renderer::sampling_for(renderer::kDefaultRaysPerCell);
  std::vector<Candidate> result = {{"robust_flag", "on", &world, rays},
                                   {"robust_flag", "off", &fragile.world, rays}};
  for (const int sub_columns : kSubColumns) {
    renderer::Sampling sampling = rays;
    sampling.sub_columns = sub_columns;
    sampling.rays_per_cell = renderer::kDefaultRaysPerCell / sub_columns;
    result.push_back({"sub_columns_rays", std::to_string(sub_columns), &world, sampling});
  }
  if (!bench.slices) return result;
  for (const int sub_columns : kSubColumns) {
    renderer::Sampling sampling = renderer::profile_sampling_for(renderer::kDefaultSlicesPerColumn);
    sampling.sub_columns = sub_columns;
    sampling.slices_per_sub_column = kSlicesSplit / sub_columns;
    result.push_back({"sub_columns_slices", std::to_string(sub_columns), &world, sampling});
  }
  return result;
}

double frame_s(const CostBench& bench) {
  return (bench.effort.repetitions + 6.0) *
         (8.0 * bench.pace.frame_ms + 4.0 * bench.pace.slices_ms) / 1000.0;
}

}  // namespace

double numerics_s(const CostBench& bench) {
  return bench.pace.build_s + static_cast<double>(bench.frames.size()) * frame_s(bench);
}

NumericFigures measure_numerics(const CostBench& bench,
                                const std::vector<renderer::GreyReference>& references) {
  bench.begin("scene without the robust flag", bench.pace.build_s);
  scenes::BuildOptions build = bench.build;
  build.robust = false;
  std::shared_ptr<const scenes::Scene> fragile = bench.rebuild(build);
  NumericFigures figures;
  for (std::size_t k = 0; k < bench.frames.size(); ++k) {
    const int frame = bench.frames[k];
    bench.begin(fmt::format("frame {}, robust flag, range and sub-columns", frame), frame_s(bench));
    const renderer::FramePose pose = bench.scene.frame_pose(frame);
    const std::vector<Candidate> list = candidates(bench, *fragile);
    std::vector<FrameClock> works;
    std::vector<std::function<void()>> timed;
    for (const Candidate& candidate : list)
      works.emplace_back(*candidate.world, pose, candidate.sampling, bench.effects());
    for (const FrameClock& work : works) timed.emplace_back([&work] { work.render(); });
    const std::vector<core::MedianTime> times =
        core::time_in_turns(timed, bench.effort.repetitions);
    for (std::size_t i = 0; i < list.size(); ++i)
      figures.variants.push_back(
          {frame, list[i].comparison, list[i].name, times[i], works[i].error(references[k])});
    const RangeCheck check(bench.scene.world, pose,
                           renderer::sampling_for(renderer::kDefaultRaysPerCell));
    figures.ranges.push_back(check.ranges(bench.effort.repetitions));
    figures.ranges.back().frame = frame;
    figures.robust.push_back(check.against(fragile->world.surfaces()));
    figures.robust.back().frame = frame;
  }
  return figures;
}

}  // namespace fanbeam::measure
