#include <algorithm>
#include <cstring>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "signal/synthesis/direct_private.h"
#include "signal/synthesis/path_run_private.h"

namespace fanbeam::signal {
namespace {

constexpr int kChirps = 16;  // that share the geometry of the paths

struct Row {
  explicit Row(int samples)
      : groups((samples + kLanes - 1) / kLanes),
        re(static_cast<std::size_t>(groups * kLanes)),
        im(static_cast<std::size_t>(groups * kLanes)) {}
  int groups;
  std::vector<double> re, im;
};

// Half of the lanes, whose nine variables stay in registers.
constexpr int kHalf = kLanes / 2;
using HalfLanes [[gnu::vector_size(kHalf * sizeof(double))]] = double;

FANBEAM_LANES_INLINE void load_half(const double* from, HalfLanes& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}
FANBEAM_LANES_INLINE void add_half(double* to, const HalfLanes& lanes) {
  HalfLanes sum;
  load_half(to, sum);
  sum += lanes;
  std::memcpy(to, &sum, sizeof(sum));
}

FANBEAM_HOT(void, add_run, (const PhaseRun& run, int groups, double* re, double* im),
            (run, groups, re, im)) {
  for (int half = 0; half < kLanes; half += kHalf) {
    HalfLanes value_re, value_im, step_re, step_im, turn_re, turn_im;
    load_half(run.values.re + half, value_re);
    load_half(run.values.im + half, value_im);
    load_half(run.steps.re + half, step_re);
    load_half(run.steps.im + half, step_im);
    load_half(run.turn.re + half, turn_re);
    load_half(run.turn.im + half, turn_im);
    for (int at = half; at < groups * kLanes; at += kLanes) {
      add_half(re + at, value_re);
      add_half(im + at, value_im);
      // MovingRun::advance.
      HalfLanes next_re = value_re * step_re - value_im * step_im;
      value_im = value_re * step_im + value_im * step_re;
      value_re = next_re;
      next_re = step_re * turn_re - step_im * turn_im;
      step_im = step_re * turn_im + step_im * turn_re;
      step_re = next_re;
    }
  }
}

}  // namespace

template <typename Real>
void add_direct(const Frame& frame, const std::vector<ScatterPath>& paths, Cube<Real>& cube) {
  if (paths.empty()) return;
  const int blocks = (frame.shape.chirps + kChirps - 1) / kChirps;
  core::parallel_for(static_cast<std::size_t>(blocks * frame.shape.channels), [&](std::size_t job) {
    const int channel = static_cast<int>(job) / blocks;
    const int begin = static_cast<int>(job) % blocks * kChirps;
    const int end = std::min(frame.shape.chirps, begin + kChirps);
    std::vector<PathGeometry> geometries;
    geometries.reserve(paths.size());
    for (const ScatterPath& path : paths) geometries.push_back(geometry_of(frame, channel, path));
    for (int chirp = begin; chirp < end; ++chirp) {
      Row row(frame.shape.samples);
      for (std::size_t i = 0; i < paths.size(); ++i) {
        const PhaseRun run(chirp_turns(frame, frame.segment(channel, chirp), geometries[i]), 0.0,
                           paths[i].amplitude_sqrtW);
        add_run(run, row.groups, row.re.data(), row.im.data());
      }
      for (int n = 0; n < frame.shape.samples; ++n) {
        const auto at = static_cast<std::size_t>(n);
        cube.at(channel, chirp, n) +=
            std::complex<Real>(static_cast<Real>(row.re[at]), static_cast<Real>(row.im[at]));
      }
    }
  });
}

template void add_direct(const Frame&, const std::vector<ScatterPath>&, FloatCube&);
template void add_direct(const Frame&, const std::vector<ScatterPath>&, DoubleCube&);

}  // namespace fanbeam::signal
