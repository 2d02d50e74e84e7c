#include "benchmarks/measure.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/frame_clock.h"
#include "benchmarks/stopwatch.h"
#include "core/parallel.h"

namespace fanbeam::benchmarks {
namespace {

constexpr double kLadder[] = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
constexpr double kNaiveRays[] = {0.1e6, 0.2e6, 0.5e6, 1e6, 2e6, 5e6, 10e6, 20e6};
constexpr double kMostPlainRays = 5e6;  // more do not help it
constexpr int kSubColumns[] = {1, 2, 4, 8, 16};

FramePower power_of(renderer::Frame&& frame) {
  return {std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
}

class ViewBench {
 public:
  explicit ViewBench(const View& view) : view_(view) {
    tell("reference");
    renderer::Frame frame;
    figures_.reference_s =
        FrameClock(view, renderer::reference_sampling(1)).frame_ms(&frame) / 1000.0;
    figures_.reference_rays = frame.rays;
    reference_.emplace(view.sensor(), power_of(std::move(frame)));
  }

  void measure_reference_error();
  void measure_ladder();
  void measure_operating_points();
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
  SamplingFigures measure(const renderer::Sampling& sampling, double rays_per_cell) const;
  SamplingFigures finest_within(double budget_ms) const;

  const View& view_;
  std::optional<GreyReference> reference_;
  ViewFigures figures_;
};

SamplingFigures ViewBench::measure(const renderer::Sampling& sampling, double rays_per_cell) const {
  const FrameClock clock(view_, sampling);
  SamplingFigures figures;
  figures.sampling = sampling;
  figures.rays_per_cell = rays_per_cell;
  renderer::Frame frame;
  figures.frame_ms = median_ms({}, [&] { clock.frame_ms(&frame); });
  figures.rays = frame.rays;
  figures.error = reference_->error_of(power_of(std::move(frame)));
  return figures;
}

void ViewBench::measure_reference_error() {
  tell("second reference");
  renderer::Frame frame;
  FrameClock(view_, renderer::reference_sampling(2)).frame_ms(&frame);
  figures_.reference_error = reference_->error_of(power_of(std::move(frame)));
}

// Candidates are a quarter of an octave apart; bisection over the quickest of a few frames, then
// full measurements downwards until one holds.
SamplingFigures ViewBench::finest_within(double budget_ms) const {
  constexpr int kCoarsest = -12;
  constexpr int kFinest = 32;
  const auto candidate = [](int step) {
    return std::round(std::exp2(step / 4.0) * 1000.0) / 1000.0;
  };
  int low = kCoarsest;
  int high = kFinest + 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const FrameClock clock(view_, renderer::sampling_for(candidate(middle)));
    double quickest_ms = clock.frame_ms();
    for (int i = 0; i < 4; ++i) quickest_ms = std::min(quickest_ms, clock.frame_ms());
    (quickest_ms <= budget_ms ? low : high) = middle;
  }
  for (;; --low) {
    const double rays_per_cell = candidate(low);
    SamplingFigures figures = measure(renderer::sampling_for(rays_per_cell), rays_per_cell);
    if (figures.frame_ms <= budget_ms || low == kCoarsest) return figures;
  }
}

void ViewBench::measure_ladder() {
  tell("ladder");
  for (const double rays_per_cell : kLadder)
    figures_.ladder.push_back(measure(renderer::sampling_for(rays_per_cell), rays_per_cell));
}

void ViewBench::measure_operating_points() {
  tell("16 Hz and 90 Hz");
  figures_.at_16Hz = finest_within(kBudget16Hz_ms);
  figures_.at_90Hz = finest_within(kBudget90Hz_ms);
  const renderer::Sampling sampling = figures_.at_16Hz.sampling;
  figures_.bare = measure_bare_pass(view_, sampling);
  const core::ThreadLimit one_thread(1);
  const FrameClock clock(view_, sampling);
  figures_.one_thread_ms = median_ms({}, [&] { clock.frame_ms(); });
}

void ViewBench::measure_naive() {
  tell("naive yardsticks");
  const ElevationSpan span = elevation_span(view_);
  for (const NaiveKind kind : {NaiveKind::plain, NaiveKind::dithered}) {
    for (const double rays : kNaiveRays) {
      if (kind == NaiveKind::plain && rays > kMostPlainRays) continue;
      const NaiveRenderer renderer(view_, kind, rays, span);
      NaiveFrame frame;
      const Repetitions repetitions =
          rays > 5e6 ? Repetitions{1, 1, 0.0} : Repetitions{3, 11, 300.0};
      NaiveFigures figures;
      figures.kind = kind;
      figures.frame_ms = median_ms(repetitions, [&] { frame = renderer.render(); });
      figures.rays = frame.rays;
      figures.error = reference_->error_of(frame.power);
      figures_.naive.push_back(figures);
      if (figures.error.bscope.noise_free.rms < kEqualErrors[1]) break;
    }
  }
}

void ViewBench::measure_splits() {
  tell("splits");
  for (const int sub_columns : kSubColumns) {
    renderer::Sampling sampling = renderer::sampling_for(renderer::kDefaultRaysPerCell);
    sampling.sub_columns = sub_columns;
    sampling.rays_per_cell = renderer::kDefaultRaysPerCell / sub_columns;
    figures_.splits.push_back(measure(sampling, renderer::kDefaultRaysPerCell));
  }
}

struct Point {
  double rms, ms;
};

std::optional<double> interpolated_ms(const std::vector<Point>& points, double rms) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].rms > rms) continue;
    if (i == 0) return points[0].ms;
    const Point& a = points[i - 1];
    const Point& b = points[i];
    const double share = std::log(a.rms / rms) / std::log(a.rms / b.rms);
    return a.ms * std::pow(b.ms / a.ms, share);
  }
  return std::nullopt;
}

}  // namespace

ViewFigures measure_view(const View& view, const Extras& extras) {
  ViewBench bench(view);
  if (extras.second_reference) bench.measure_reference_error();
  bench.measure_ladder();
  bench.measure_operating_points();
  bench.measure_naive();
  if (extras.splits) bench.measure_splits();
  return std::move(bench).figures();
}

std::optional<double> ms_at_error(const std::vector<SamplingFigures>& ladder, double rms) {
  std::vector<Point> points;
  for (const SamplingFigures& step : ladder)
    points.push_back({step.error.bscope.noise_free.rms, step.frame_ms});
  return interpolated_ms(points, rms);
}

std::optional<double> ms_at_error(const std::vector<NaiveFigures>& ladder, NaiveKind kind,
                                  double rms) {
  std::vector<Point> points;
  for (const NaiveFigures& step : ladder)
    if (step.kind == kind) points.push_back({step.error.bscope.noise_free.rms, step.frame_ms});
  return interpolated_ms(points, rms);
}

}  // namespace fanbeam::benchmarks
