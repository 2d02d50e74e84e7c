#include "signal/synthesis/beat_synthesis.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "signal/fourier/fft.h"
#include "signal/synthesis/direct_private.h"
#include "signal/synthesis/path_run_private.h"
#include "signal/synthesis/range_grid_private.h"
#include "signal/synthesis/reference.h"

namespace fanbeam::signal {
namespace {

constexpr int kMostOrders = 4;
constexpr int kBlock = 32;     // chirps side by side on a grid: fits the second-level cache
constexpr int kLeastJobs = 8;  // channels are cut until there are so many pieces of work
constexpr int kFewPaths = 16;  // for which the transforms alone would cost more
constexpr double kFloatLimit = 1e-5;

// exp(j 2 pi p k^2) over |k| <= N/2 is exp(j alpha / 2) exp(j alpha q), q = (2 k / N)^2 - 1/2.
double bend_rad(double per_sample2, int samples) {
  return 2.0 * core::kPi * per_sample2 * 0.25 * samples * samples;
}

// Terms that leave less than `error` out: (alpha / 2)^n / n!. More than kMostOrders: no use.
int orders_for(double alpha_rad, double error) {
  double term = 1.0;
  for (int order = 1; order <= kMostOrders; ++order) {
    term *= 0.5 * std::abs(alpha_rad) / order;
    if (term <= error) return order;
  }
  return kMostOrders + 1;
}

struct Plan {
  SpreadingKernel kernel;
  int cells = 0;
  int orders = 1;
  std::vector<ScatterPath> spread, direct;
  std::vector<double> scales;
};

// What undoes the kernel, for sample n and order i: q^i / transform, at [i * samples + n].
std::vector<double> sample_scales(const Plan& plan, int samples) {
  std::vector<double> scales(static_cast<std::size_t>(plan.orders * samples));
  for (int n = 0; n < samples; ++n) {
    const double k = n - samples / 2;
    const double scale = 1.0 / plan.kernel.transform(k / plan.cells);
    const double q = 4.0 * k * k / (static_cast<double>(samples) * samples) - 0.5;
    for (int order = 0; order < plan.orders; ++order)
      scales[static_cast<std::size_t>(order * samples + n)] = scale * std::pow(q, order);
  }
  return scales;
}

Plan plan_of(const Frame& frame, const std::vector<ScatterPath>& paths, double error) {
  Plan plan{SpreadingKernel(kernel_width(error)), 0, 1, {}, {}, {}};
  plan.cells = even_fast_length(std::max(2 * frame.shape.samples, 2 * plan.kernel.width()));
  if (!frame.uniform || static_cast<int>(paths.size()) <= kFewPaths) {
    plan.direct = paths;
    return plan;
  }
  for (const ScatterPath& path : paths) {
    int orders = 1;
    bool runs = true;
    for (int channel = 0; channel < frame.shape.channels && runs; ++channel) {
      const PathRun run = path_run(frame, channel, path);
      orders =
          std::max(orders, orders_for(bend_rad(run.per_sample2, frame.shape.samples), 0.1 * error));
      runs = run.error_rad <= 0.1 * error && orders <= kMostOrders &&
             std::abs(run.per_sample_chirp) * plan.cells < 1.0;
    }
    if (runs) plan.orders = std::max(plan.orders, orders);
    (runs ? plan.spread : plan.direct).push_back(path);
  }
  plan.scales = sample_scales(plan, frame.shape.samples);
  return plan;
}

std::vector<GridPath> grid_paths(const Frame& frame, const Plan& plan, int channel, int chirp) {
  std::vector<GridPath> paths;
  paths.reserve(plan.spread.size());
  for (const ScatterPath& path : plan.spread) {
    PathRun run = path_run(frame, channel, path);
    const double alpha_rad = bend_rad(run.per_sample2, frame.shape.samples);
    run.middle.constant += alpha_rad / (4.0 * core::kPi);
    paths.push_back({PhaseRun(run.middle, chirp, path.amplitude_sqrtW),
                     (run.per_sample + run.per_sample_chirp * chirp) * plan.cells,
                     run.per_sample_chirp * plan.cells, alpha_rad});
  }
  return paths;
}

// values += j^order x scale x row.
template <typename Real>
void add_scaled(int order, const Real* row, const Real* scales, int count, Real* values) {
  const Real sign = order < 2 ? Real(1) : Real(-1);
  if (order % 2 == 0)
    for (int n = 0; n < count; ++n) {
      values[2 * n] += sign * scales[n] * row[2 * n];
      values[2 * n + 1] += sign * scales[n] * row[2 * n + 1];
    }
  else
    for (int n = 0; n < count; ++n) {
      values[2 * n] -= sign * scales[n] * row[2 * n + 1];
      values[2 * n + 1] += sign * scales[n] * row[2 * n];
    }
}

// Takes the spread values of eight chirps back to samples.
template <typename Real>
class RowMaker {
 public:
  RowMaker(const Plan& plan, int samples)
      : orders_(plan.orders),
        cells_(plan.cells),
        samples_(samples),
        fft_({plan.cells, 1, kLanes, plan.cells}, FftDirection::inverse),
        rows_(static_cast<std::size_t>(kLanes * plan.cells)),
        scales_(plan.scales.begin(), plan.scales.end()) {}

  // Adds to `count` rows of samples from `values` on.
  void add(const RangeGrid<Real>& grid, int first, int count, std::complex<Real>* values) {
    for (int order = 0; order < orders_; ++order) {
      gather(grid, order, first);
      fft_.run(rows_.data());
      // Sample 0 is k = -N/2: the spectrum's upper end comes first.
      const int half = samples_ / 2;
      for (int row = 0; row < count; ++row) {
        const Real* from = reinterpret_cast<const Real*>(rows_.data() + row * cells_);
        const Real* scales = scales_.data() + order * samples_;
        Real* to = reinterpret_cast<Real*>(values + row * samples_);
        add_scaled(order, from + 2 * (cells_ - half), scales, half, to);
        add_scaled(order, from, scales + half, samples_ - half, to + 2 * half);
      }
    }
  }

 private:
  void gather(const RangeGrid<Real>& grid, int order, int first) {
    for (int cell = 0; cell < cells_; ++cell) {
      const Real* re = grid.re(order, cell) + first;
      const Real* im = grid.im(order, cell) + first;
      for (int lane = 0; lane < kLanes; ++lane)
        rows_[static_cast<std::size_t>(lane * cells_ + cell)] = {re[lane], im[lane]};
    }
  }

  int orders_, cells_, samples_;
  Fft<Real> fft_;
  std::vector<std::complex<Real>> rows_;
  std::vector<Real> scales_;
};

template <typename Real>
void spread_part(const Frame& frame, const Plan& plan, int channel, int begin, int end,
                 Cube<Real>& cube) {
  const int block = std::min(kBlock, (end - begin + kLanes - 1) / kLanes * kLanes);
  RangeGrid<Real> grid(plan.kernel, plan.cells, block, plan.orders);
  RowMaker<Real> rows(plan, frame.shape.samples);
  std::vector<GridPath> paths = grid_paths(frame, plan, channel, begin);
  for (int chirp = begin; chirp < end; chirp += block) {
    grid.clear();
    for (GridPath& path : paths) grid.spread(path, block);
    grid.close();
    for (int first = 0; first < block && chirp + first < end; first += kLanes)
      rows.add(grid, first, std::min(kLanes, end - chirp - first),
               &cube.at(channel, chirp + first, 0));
  }
}

template <typename Real>
Cube<Real> spread_all(const Frame& frame, const Plan& plan) {
  Cube<Real> cube(frame.shape);
  if (plan.spread.empty()) return cube;
  const int channels = frame.shape.channels;
  const int parts = std::max(1, (kLeastJobs + channels - 1) / channels);
  const int chirps = frame.shape.chirps;
  const int part = ((chirps + parts - 1) / parts + kLanes - 1) / kLanes * kLanes;
  core::parallel_for(static_cast<std::size_t>(channels * parts), [&](std::size_t job) {
    const int channel = static_cast<int>(job) / parts;
    const int begin = static_cast<int>(job) % parts * part;
    const int end = std::min(chirps, begin + part);
    if (begin < end) spread_part(frame, plan, channel, begin, end, cube);
  });
  return cube;
}

template <typename Out, typename In>
Cube<Out> converted(const Cube<In>& cube) {
  Cube<Out> out(cube.shape);
  std::transform(cube.values.begin(), cube.values.end(), out.values.begin(),
                 [](const std::complex<In>& value) {
                   return std::complex<Out>(static_cast<Out>(value.real()),
                                            static_cast<Out>(value.imag()));
                 });
  return out;
}

template <typename Real>
Cube<Real> synthesise(const Waveform& waveform, int stage, const Array& array,
                      const std::vector<ScatterPath>& paths, double error) {
  if (!(error >= 1e-10 && error <= 1e-2))
    core::throw_input_error(core::ErrorClass::range, "relative_error", error, "1e-10 to 1e-2");
  const Frame frame = make_frame(waveform, stage, array);
  check(waveform, paths);
  if (waveform.kind == WaveformKind::sinusoidal || waveform.kind == WaveformKind::pulsed)
    return converted<Real>(reference_beat(waveform, stage, array, paths));
  const Plan plan = plan_of(frame, paths, error);
  Cube<Real> cube = error >= kFloatLimit ? converted<Real>(spread_all<float>(frame, plan))
                                         : converted<Real>(spread_all<double>(frame, plan));
  add_direct(frame, plan.direct, cube);
  if (!waveform.complex_baseband)
    for (std::complex<Real>& value : cube.values)
      value = static_cast<Real>(std::sqrt(2.0)) * value.real();
  return cube;
}

}  // namespace

FloatCube synthesise_beat(const Waveform& waveform, int stage, const Array& array,
                          const std::vector<ScatterPath>& paths, const SynthesisOptions& options) {
  return synthesise<float>(waveform, stage, array, paths, options.relative_error);
}

DoubleCube synthesise_beat_double(const Waveform& waveform, int stage, const Array& array,
                                  const std::vector<ScatterPath>& paths,
                                  const SynthesisOptions& options) {
  return synthesise<double>(waveform, stage, array, paths, options.relative_error);
}

}  // namespace fanbeam::signal
