#include <algorithm>

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

FANBEAM_HOT FANBEAM_INLINE_ALL void add_run(const PhaseRun& begin, int groups, double* re,
                                            double* im) {
  MovingRun run(begin);
  for (int group = 0; group < groups; ++group) {
    add_to<double>(re + group * kLanes, run.values.re);
    add_to<double>(im + group * kLanes, run.values.im);
    run.advance();
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
