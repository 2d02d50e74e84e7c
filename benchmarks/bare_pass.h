// What the ray-casting library alone needs for the rays of a frame of surfaces alone.
//
// The packets of a frame, refinement rays included, are recorded, filled before the clock starts
// and cast by as many threads; nothing is done with the hits. Packets are tried as recorded (16
// wide) and cut into two kinds of 8 wide ones; the quickest counts.
#pragma once

#include <cstdint>
#include <string>

#include "benchmarks/bench_scene.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::benchmarks {

struct BarePass {
  std::uint64_t rays = 0;
  double bare_ms = 0.0;   // of the quickest shape
  double frame_ms = 0.0;  // pose to display images, measured in turns with the bare pass
  std::string shape;      // of the quickest

  double ratio() const { return frame_ms / bare_ms; }
  // Of processor time on so many threads, for each ray, that the library does not need.
  double beside_ns(int threads) const {
    return 1e6 * (frame_ms - bare_ms) * threads / static_cast<double>(rays);
  }
};

// Of a sampling of the ray caster; bare pass and frame take `turns` turns. Throws
// core::InternalError when the recorded rays are not as many as a frame's.
BarePass measure_bare_pass(const View& view, const renderer::Sampling& sampling, int turns);

}  // namespace fanbeam::benchmarks
