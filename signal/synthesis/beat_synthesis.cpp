#include "signal/synthesis/beat_synthesis.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"
#include "signal/synthesis/direct_private.h"
#include "signal/synthesis/path_run_private.h"
#include "signal/synthesis/range_grid_private.h"
#include "signal/synthesis/reference.h"

namespace fanbeam::signal {
namespace {

constexpr int kMostOrders = 4;
constexpr int kBlock = 32;           // chirps side by side on a grid: fits the second-level cache
constexpr int kLeastJobs = 8;        // channels are cut until there are so many pieces of work
constexpr int kFewPaths = 16;        // for which the transforms alone would cost more
constexpr std::size_t kChunk = 256;  // paths that are classified as one piece of work
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
  int orders = 1;     // grids
  bool bent = false;  // the bend to first order on a single grid
  std::vector<std::size_t> spread;
  std::vector<ScatterPath> direct;
  std::vector<PathRun> runs;  // of path i in channel c, at [c * paths + i]
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

// Fills the path's runs in all channels. Returns the terms that its bend takes, 0 where the path
// cannot be spread.
int terms_of(const Frame& frame, const std::vector<ScatterPath>& paths, std::size_t index,
             double error, Plan& plan) {
  int terms = 1;
  for (int channel = 0; channel < frame.shape.channels; ++channel) {
    const PathRun run = path_run(frame, channel, paths[index]);
    terms = std::max(terms, orders_for(bend_rad(run.per_sample2, frame.shape.samples), error));
    if (!(run.error_rad <= error) || terms > kMostOrders ||
        !(std::abs(run.per_sample_chirp) * plan.cells < 1.0))
      return 0;
    plan.runs[static_cast<std::size_t>(channel) * paths.size() + index] = run;
  }
  return terms;
}

Plan plan_of(const Frame& frame, const std::vector<ScatterPath>& paths, double error) {
  Plan plan{SpreadingKernel(kernel_width(error)), 0, 1, false, {}, {}, {}, {}};
  const int samples = frame.shape.samples;
  plan.cells = 2 * fast_length(std::max(samples, plan.kernel.width()));
  if (!frame.uniform || static_cast<int>(paths.size()) <= kFewPaths) {
    plan.direct = paths;
    return plan;
  }
  plan.runs.resize(static_cast<std::size_t>(frame.shape.channels) * paths.size());
  std::vector<int> terms(paths.size());
  core::parallel_for((paths.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(paths.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i)
      terms[i] = terms_of(frame, paths, i, 0.1 * error, plan);
  });
  for (std::size_t i = 0; i < paths.size(); ++i) {
    plan.orders = std::max(plan.orders, terms[i]);
    if (terms[i] > 0)
      plan.spread.push_back(i);
    else
      plan.direct.push_back(paths[i]);
  }
  if (plan.orders == 2) {
    plan.orders = 1;
    plan.bent = true;
  }
  plan.scales = sample_scales(plan, samples);
  return plan;
}

std::vector<GridPath> grid_paths(const Frame& frame, const std::vector<ScatterPath>& all,
                                 const Plan& plan, int channel, int chirp) {
  std::vector<GridPath> paths;
  paths.reserve(plan.spread.size());
  for (const std::size_t i : plan.spread) {
    PathRun run = plan.runs[static_cast<std::size_t>(channel) * all.size() + i];
    const double alpha_rad = bend_rad(run.per_sample2, frame.shape.samples);
    run.middle.constant += alpha_rad / (4.0 * core::kPi);
    paths.push_back({PhaseRun(run.middle, chirp, all[i].amplitude_sqrtW),
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

// A stretch of one channel's chirps.
struct Part {
  int channel, begin, end;
};

template <typename Real>
void spread_part(const Frame& frame, const std::vector<ScatterPath>& all, const Plan& plan,
                 const Part& part, Cube<Real>& cube) {
  const int block = std::min(kBlock, (part.end - part.begin + kLanes - 1) / kLanes * kLanes);
  const double cells_per_turn = plan.cells / (core::kPi * frame.shape.samples);
  RangeGrid<Real> grid(plan.kernel, {plan.cells, block, plan.orders,
                                     plan.bent ? -cells_per_turn * cells_per_turn : 0.0});
  RowMaker<Real> rows(plan, frame.shape.samples);
  std::vector<GridPath> paths = grid_paths(frame, all, plan, part.channel, part.begin);
  for (int chirp = part.begin; chirp < part.end; chirp += block) {
    grid.clear();
    for (GridPath& path : paths) grid.spread(path, block);
    grid.close();
    for (int first = 0; first < block && chirp + first < part.end; first += kLanes)
      rows.add(grid, first, std::min(kLanes, part.end - chirp - first),
               &cube.at(part.channel, chirp + first, 0));
  }
}

template <typename Real>
Cube<Real> spread_all(const Frame& frame, const std::vector<ScatterPath>& all, const Plan& plan) {
  Cube<Real> cube(frame.shape);
  if (plan.spread.empty()) return cube;
  const int channels = frame.shape.channels;
  const int parts = std::max(1, (kLeastJobs + channels - 1) / channels);
  const int chirps = frame.shape.chirps;
  const int part = ((chirps + parts - 1) / parts + kLanes - 1) / kLanes * kLanes;
  core::parallel_for(static_cast<std::size_t>(channels * parts), [&](std::size_t job) {
    const int begin = static_cast<int>(job) % parts * part;
    const int end = std::min(chirps, begin + part);
    if (begin < end)
      spread_part(frame, all, plan, {static_cast<int>(job) / parts, begin, end}, cube);
  });
  return cube;
}

template <typename Out, typename In>
Cube<Out> converted(Cube<In> cube) {
  if constexpr (std::is_same_v<Out, In>) {
    return cube;
  } else {
    Cube<Out> out(cube.shape);
    std::transform(cube.values.begin(), cube.values.end(), out.values.begin(),
                   [](const std::complex<In>& value) {
                     return std::complex<Out>(static_cast<Out>(value.real()),
                                              static_cast<Out>(value.imag()));
                   });
    return out;
  }
}

template <typename Real>
Cube<Real> synthesise(const Waveform& waveform, int stage, const Array& array,
                      const std::vector<ScatterPath>& paths, double error) {
  if (!(error >= 1e-10 && error <= 1e-2)) refuse("relative_error", error, "1e-10 to 1e-2");
  const Frame frame = make_frame(waveform, stage, array);
  check(waveform, paths);
  if (waveform.kind == WaveformKind::sinusoidal || waveform.kind == WaveformKind::pulsed)
    return converted<Real>(reference_beat(waveform, stage, array, paths));
  const Plan plan = plan_of(frame, paths, error);
  Cube<Real> cube = error >= kFloatLimit ? converted<Real>(spread_all<float>(frame, paths, plan))
                                         : converted<Real>(spread_all<double>(frame, paths, plan));
  add_direct(frame, plan.direct, cube);
  if (!waveform.complex_baseband) keep_real(cube);
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
