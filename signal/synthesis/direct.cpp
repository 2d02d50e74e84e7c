#include "core/dispatch.h"
#include "core/parallel.h"
#include "signal/synthesis/direct_private.h"
#include "signal/synthesis/path_run_private.h"

namespace fanbeam::signal {
namespace {

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
  const auto chirps = static_cast<std::size_t>(frame.shape.chirps);
  core::parallel_for(chirps * static_cast<std::size_t>(frame.shape.channels), [&](std::size_t at) {
    const int channel = static_cast<int>(at / chirps);
    const int chirp = static_cast<int>(at % chirps);
    const Segment& segment = frame.segment(channel, chirp);
    Row row(frame.shape.samples);
    for (const ScatterPath& path : paths) {
      const PhaseRun run(chirp_turns(frame, segment, geometry_of(frame, channel, path)), 0.0,
                         path.amplitude_sqrtW);
      add_run(run, row.groups, row.re.data(), row.im.data());
    }
    for (int n = 0; n < frame.shape.samples; ++n) {
      const auto i = static_cast<std::size_t>(n);
      cube.at(channel, chirp, n) +=
          std::complex<Real>(static_cast<Real>(row.re[i]), static_cast<Real>(row.im[i]));
    }
  });
}

template void add_direct(const Frame&, const std::vector<ScatterPath>&, FloatCube&);
template void add_direct(const Frame&, const std::vector<ScatterPath>&, DoubleCube&);

}  // namespace fanbeam::signal
