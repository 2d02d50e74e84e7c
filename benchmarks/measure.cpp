#include "benchmarks/measure.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/default_settings.h"
#include "core/median.h"
#include "core/parallel.h"
#include "renderer/accuracy/sampling_ladder.h"

namespace fanbeam::benchmarks {
namespace {

using measure::LadderWork;
using renderer::CasterKind;

constexpr double kFewNaiveRays = 12;  // more take a good part of a second: one frame is enough
constexpr int kSubColumns[] = {1, 2, 4, 8, 16};

// What an operating point is chosen from, coarsest first: rays in steps of a quarter of an octave,
// slices one by one, and few of them as live sampling has them.
std::vector<double> candidates(CasterKind caster) {
  constexpr int kCoarsest = -12;
  constexpr int kFinest = 32;
  constexpr int kMostSlices = 128;
  std::vector<double> result;
  if (caster == CasterKind::rays) {
    for (int step = kCoarsest; step <= kFinest; ++step)
      result.push_back(std::round(std::exp2(step / 4.0) * 1000.0) / 1000.0);
    // No coarser than the program takes.
    std::erase_if(result, [](double rays) { return rays < renderer::kFewestRaysPerCell; });
    return result;
  }
  constexpr int kFew = 3;
  for (const double slices : renderer::sampling_ladder(caster))
    if (slices < kFew) result.push_back(slices);
  for (int slices = kFew; slices <= kMostSlices; ++slices)
    if (samples_in(renderer::profile_sampling_for(slices)) == slices) result.push_back(slices);
  return result;
}

class ViewBench {
 public:
  ViewBench(const View& view, const Effort& effort) : view_(view), effort_(effort) {
    tell("reference");
    renderer::Frame frame;
    figures_.reference_s = clock_of(view, effort.reference(1)).frame_ms(&frame) / 1000.0;
    figures_.reference_rays = frame.rays;
    reference_power_ = power_of(std::move(frame));
    reference_.emplace(view.sensor(), reference_power_);
    figures_.at_default = default_error(view, *reference_);
  }

  void measure_reference_error();
  void measure_caster(CasterKind caster);
  void measure_surfaces();
  void measure_agreement();
  void measure_bare();
  void measure_naive();
  void measure_splits();

  ViewFigures figures() && {
    figures_.view = view_;
    return std::move(figures_);
  }

 private:
  void tell(const char* what) const {
    fmt::print(stderr, "{} at {:.0f} m: {}\n", view_.scene->name, view_.distance_m, what);
  }
  // What is measured: all effects, or surfaces alone against their own reference.
  struct Picture {
    renderer::Effects effects;
    const GreyReference& reference;
  };
  Picture whole() const { return {view_.scene->effects(), *reference_}; }
  LadderWork work(const Picture& picture, const renderer::Sampling& sampling,
                  double fineness) const {
    const bool rays = sampling.caster == CasterKind::rays;
    return {rays ? Way::rays : Way::slices, fineness, clock(picture, sampling), sampling};
  }
  std::vector<LadderStep> measure(const Picture& picture, const std::vector<LadderWork>& works,
                                  int repetitions) const {
    return measure::measure_steps(view_.frame, picture.reference, works, repetitions);
  }
  LadderStep finest_within(const Picture& picture, CasterKind caster, double budget_ms) const;
  FrameClock clock(const Picture& picture, const renderer::Sampling& sampling) const {
    return {view_.world(), view_.pose, sampling, picture.effects};
  }
  ThreadFigures measure_threads(const renderer::Sampling& sampling) const;

  const View& view_;
  const Effort& effort_;
  FramePower reference_power_;
  std::optional<GreyReference> reference_;
  ViewFigures figures_;
  renderer::Sampling surface_rays_;  // at 16 Hz
};

void ViewBench::measure_reference_error() {
  tell("second reference");
  const FramePower second = clock_of(view_, effort_.reference(2)).power();
  figures_.reference_error = reference_->error_of(second);
  figures_.reference_agreement = {view_.scene->name,
                                  view_.distance_m,
                                  "reference, another seed",
                                  agreement_of(view_.sensor(), second, reference_power_),
                                  {}};
}

// Bisection over the quickest of a few frames, then full measurements downwards until one holds.
LadderStep ViewBench::finest_within(const Picture& picture, CasterKind caster,
                                    double budget_ms) const {
  const std::vector<double> steps = candidates(caster);
  std::size_t low = 0;
  std::size_t high = steps.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    const FrameClock timed = clock(picture, renderer::sampling_for(caster, steps[middle]));
    double quickest_ms = timed.frame_ms();
    for (int i = 0; i < 4; ++i) quickest_ms = std::min(quickest_ms, timed.frame_ms());
    (quickest_ms <= budget_ms ? low : high) = middle;
  }
  for (;; --low) {
    std::vector<LadderWork> works;
    works.push_back(work(picture, renderer::sampling_for(caster, steps[low]), steps[low]));
    const LadderStep figures = measure(picture, works, effort_.operating_point).front();
    if (figures.time.ms <= budget_ms || low == 0) return figures;
  }
}

ThreadFigures ViewBench::measure_threads(const renderer::Sampling& sampling) const {
  const FrameClock clock = clock_of(view_, sampling);
  std::vector<double> all_ms;
  std::vector<double> one_ms;
  for (int i = 0; i < effort_.turns; ++i) {
    all_ms.push_back(clock.second_frame_ms());
    const core::ThreadLimit one_thread(1);
    one_ms.push_back(clock.second_frame_ms());
  }
  return {core::median(all_ms), core::median(one_ms)};
}

void ViewBench::measure_caster(CasterKind caster) {
  const bool rays = caster == CasterKind::rays;
  CasterFigures& figures = rays ? figures_.rays : figures_.slices;
  tell(rays ? "rays" : "slices");
  std::vector<LadderWork> works;
  for (const double fineness : rays ? effort_.rays : effort_.slices)
    works.push_back(work(whole(), renderer::sampling_for(caster, fineness), fineness));
  figures.ladder = measure(whole(), works, effort_.repetitions);
  tell(rays ? "rays at 16, 45 and 90 Hz" : "slices at 16, 45 and 90 Hz");
  figures.at_16Hz = finest_within(whole(), caster, kBudget16Hz_ms);
  figures.at_45Hz = finest_within(whole(), caster, kBudget45Hz_ms);
  figures.at_90Hz = finest_within(whole(), caster, kBudget90Hz_ms);
  figures.threads = measure_threads(figures.at_16Hz.sampling);
}

void ViewBench::measure_surfaces() {
  tell("surfaces alone");
  const renderer::Effects effects = view_.scene->noise_alone();
  const GreyReference reference(
      view_.sensor(), FrameClock(view_.world(), view_.pose, effort_.reference(1), effects).power());
  const Picture picture{effects, reference};
  figures_.surfaces.at_16Hz = finest_within(picture, CasterKind::profile, kBudget16Hz_ms);
  figures_.surfaces.at_90Hz = finest_within(picture, CasterKind::profile, kBudget90Hz_ms);
  surface_rays_ = finest_within(picture, CasterKind::rays, kBudget16Hz_ms).sampling;
}

void ViewBench::measure_agreement() {
  figures_.slices_agreement = benchmarks::measure_agreement(view_, effort_, &reference_power_);
}

void ViewBench::measure_bare() {
  tell("bare pass");
  figures_.bare = measure_bare_pass(view_, surface_rays_, effort_.turns);
}

void ViewBench::measure_naive() {
  tell("naive yardsticks");
  const renderer::ElevationSpan span = renderer::elevation_span(view_.world(), view_.antenna);
  for (const Way way : {Way::naive_plain, Way::naive_dithered}) {
    for (const double rays : effort_.ladder(way)) {
      std::vector<LadderWork> works;
      works.push_back({way,
                       rays,
                       {view_.world(), view_.pose, measure::naive_kind(way), rays, span,
                        view_.scene->effects()}});
      figures_.naive.push_back(
          measure(whole(), works, rays > kFewNaiveRays ? 1 : effort_.repetitions).front());
      if (figures_.naive.back().error.bscope.noise_free.rms < kEqualErrors_grey[1]) break;
    }
  }
}

void ViewBench::measure_splits() {
  tell("splits");
  std::vector<LadderWork> works;
  for (const int sub_columns : kSubColumns) {
    renderer::Sampling sampling = renderer::sampling_for(renderer::kDefaultRaysPerCell);
    sampling.sub_columns = sub_columns;
    sampling.rays_per_cell = renderer::kDefaultRaysPerCell / sub_columns;
    works.push_back(work(whole(), sampling, renderer::kDefaultRaysPerCell));
  }
  figures_.splits = measure(whole(), works, effort_.repetitions);
}

}  // namespace

ViewFigures measure_view(const View& view, const Effort& effort, const Extras& extras) {
  ViewBench bench(view, effort);
  if (extras.second_reference) bench.measure_reference_error();
  bench.measure_agreement();
  for (const CasterKind caster : {CasterKind::rays, CasterKind::profile})
    bench.measure_caster(caster);
  bench.measure_surfaces();
  bench.measure_bare();
  bench.measure_naive();
  if (extras.splits) bench.measure_splits();
  return std::move(bench).figures();
}

}  // namespace fanbeam::benchmarks
