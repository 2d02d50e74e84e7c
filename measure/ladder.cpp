#include "measure/ladder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/turns.h"
#include "measure/clock.h"

namespace fanbeam::measure {
namespace {

LadderWork work_of(const CostBench& bench, const renderer::FramePose& pose,
                   const renderer::ElevationSpan& span, Way way, double fineness) {
  const renderer::World& world = bench.scene.world;
  if (way == Way::rays || way == Way::slices) {
    const renderer::Sampling sampling = sampling_of(way, fineness);
    return {way, fineness, {world, pose, sampling, bench.effects()}, sampling};
  }
  return {way, fineness, {world, pose, naive_kind(way), fineness, span, bench.effects()}};
}

void measure_frame(const CostBench& bench, int frame, const renderer::GreyReference& reference,
                   std::vector<LadderStep>& ladder) {
  const renderer::World& world = bench.scene.world;
  const renderer::FramePose pose = bench.scene.frame_pose(frame);
  const sensors::AntennaFrame antenna = renderer::antenna_of(world.sensor, pose);
  const renderer::ElevationSpan span = renderer::elevation_span(world, antenna);
  std::vector<LadderWork> works;
  for (const Way way : bench.ways())
    for (const double fineness : bench.effort.ladder(way))
      works.push_back(work_of(bench, pose, span, way, fineness));
  const std::vector<LadderStep> steps =
      measure_steps(frame, reference, works, bench.effort.repetitions);
  ladder.insert(ladder.end(), steps.begin(), steps.end());
}

// Calls `with` with functions that pick each figure of a FrameError.
template <class With>
void for_each_figure(const With& with) {
  using renderer::FrameError;
  using renderer::GreyError;
  using renderer::PictureError;
  for (const auto scope : {&FrameError::bscope, &FrameError::cscope})
    for (const auto noise : {&PictureError::with_noise, &PictureError::noise_free})
      for (const auto figure : {&GreyError::rms, &GreyError::lit_rms, &GreyError::lit_p99})
        with([=](FrameError& error) -> double& { return ((error.*scope).*noise).*figure; });
}

struct Point {
  double x, y;
};

// Of a line through points of rising x, both axes logarithmic.
std::optional<double> interpolated(const std::vector<Point>& points, double x) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    if (x < a.x || x > b.x) continue;
    if (!(a.x > 0.0 && a.y > 0.0 && b.x > a.x && b.y > 0.0)) return b.y;
    const double share = std::log(x / a.x) / std::log(b.x / a.x);
    return a.y * std::pow(b.y / a.y, share);
  }
  return std::nullopt;
}

}  // namespace

renderer::Effects CostBench::effects() const {
  renderer::Effects effects = renderer::without_draws(renderer::effects_of(scene.plan, 0));
  // The error adds the noise itself; a C-scope of another mode is worked out from the B-scope.
  const auto mode = scene.world.sensor.display.cscope_mode;
  if (mode != sensors::Display::CScopeMode::true_elevation)
    effects.on.erase(core::EffectId::thermal_noise);
  return effects;
}

std::vector<renderer::GreyReference> render_references(const CostBench& bench,
                                                       std::vector<ReferenceFigures>& figures) {
  const renderer::World& world = bench.scene.world;
  const double reference_s = bench.pace.reference_s(bench.effort);
  std::vector<renderer::GreyReference> references;
  for (const int frame : bench.frames) {
    bench.begin(fmt::format("frame {}, converged reference", frame), reference_s);
    const renderer::FramePose pose = bench.scene.frame_pose(frame);
    const Clock::time_point begin = Clock::now();
    renderer::Frame first =
        FrameClock(world, pose, bench.effort.reference(1), bench.effects()).render();
    const renderer::Sampling sampling = bench.effort.reference(1);
    ReferenceFigures reference{
        frame,
        milliseconds_since(begin) * 1e-3,
        first.rays,
        sampling.sub_columns * sampling.jittered_passes * sampling.rays_per_cell,
        {}};
    references.emplace_back(world.sensor, power_of(std::move(first)));
    bench.begin(fmt::format("frame {}, second reference", frame), reference_s);
    reference.own_error = FrameClock(world, pose, bench.effort.reference(2), bench.effects())
                              .error(references.back());
    figures.push_back(reference);
  }
  return references;
}

std::vector<LadderStep> measure_steps(int frame, const renderer::GreyReference& reference,
                                      const std::vector<LadderWork>& works, int repetitions) {
  std::vector<LadderStep> steps;
  std::vector<std::function<void()>> timed;
  for (const LadderWork& work : works) {
    renderer::Frame shown = work.clock.render();
    LadderStep step{frame, work.way,   work.fineness, work.sampling,
                    {},    shown.rays, shown.slices,  {}};
    step.error = reference.error_of(power_of(std::move(shown)));
    steps.push_back(step);
    timed.emplace_back([&work] { work.clock.render(); });
  }
  const std::vector<core::MedianTime> times = core::time_in_turns(timed, repetitions);
  for (std::size_t i = 0; i < times.size(); ++i) steps[i].time = times[i];
  return steps;
}

std::vector<LadderStep> measure_ladder(const CostBench& bench,
                                       const std::vector<renderer::GreyReference>& references) {
  std::vector<LadderStep> ladder;
  for (std::size_t i = 0; i < bench.frames.size(); ++i) {
    bench.begin(fmt::format("frame {}, sampling ladders", bench.frames[i]),
                bench.pace.ladder_s(bench.effort));
    measure_frame(bench, bench.frames[i], references[i], ladder);
  }
  return ladder;
}

std::vector<LadderStep> over_frames(const std::vector<LadderStep>& ladder) {
  std::vector<LadderStep> result;
  for (const LadderStep& step : ladder) {
    if (step.frame != ladder.front().frame) continue;
    std::vector<const LadderStep*> same;
    for (const LadderStep& other : ladder)
      if (other.way == step.way && other.fineness == step.fineness) same.push_back(&other);
    const auto count = static_cast<double>(same.size());
    LadderStep mean = step;
    mean.time.ms = 0.0;
    for (const LadderStep* other : same) mean.time.ms += other->time.ms / count;
    for_each_figure([&](const auto& figure_of) {
      double squares = 0.0;
      for (const LadderStep* other : same) {
        renderer::FrameError error = other->error;
        squares += figure_of(error) * figure_of(error);
      }
      figure_of(mean.error) = std::sqrt(squares / count);
    });
    result.push_back(mean);
  }
  return result;
}

std::optional<double> ms_at_error(const std::vector<LadderStep>& ladder, Way way, double rms,
                                  PickError error) {
  std::vector<Point> points;
  for (const LadderStep& step : ladder)
    if (step.way == way) points.push_back({error(step.error), step.time.ms});
  std::reverse(points.begin(), points.end());  // the error falls along a ladder
  return interpolated(points, rms);
}

std::optional<double> error_at_ms(const std::vector<LadderStep>& ladder, Way way, double ms,
                                  PickError error) {
  std::vector<Point> points;
  for (const LadderStep& step : ladder)
    if (step.way == way) points.push_back({step.time.ms, error(step.error)});
  return interpolated(points, ms);
}

}  // namespace fanbeam::measure
