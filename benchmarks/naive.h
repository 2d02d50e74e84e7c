// The renderer people write first, as a yardstick: uniform elevation angles, one ray at a time,
// each hit put into the one cell it falls in. Radar equation, tables, azimuth beam, point targets
// and display are the project's own, so that only the sampling differs. The rays are RayScene's
// checked single ones.
//
//   plain     one azimuth per picture column, its centre
//   dithered  four sub-columns per column, every ray at its own azimuth inside its sub-column
#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/bare_pass.h"
#include "benchmarks/bench_scene.h"
#include "benchmarks/grey_error.h"
#include "renderer/casting/nrcs_table.h"

namespace fanbeam::benchmarks {

enum class NaiveKind { plain, dithered };

struct NaiveFrame {
  FramePower power;
  std::uint64_t rays = 0;
};

class NaiveRenderer {
 public:
  // About `rays` rays per frame, over `span` in elevation. `view` must outlive the renderer.
  NaiveRenderer(const View& view, NaiveKind kind, double rays, const ElevationSpan& span);

  // From the pose to both display images, as FrameClock; the images are thrown away.
  NaiveFrame render() const;

 private:
  const View& view_;
  NaiveKind kind_;
  int sub_columns_ = 1;  // per picture column
  int all_sub_columns_ = 0;
  double step_rad_ = 0.0;  // between elevations
  struct Turn {
    double cosine, sine;
  };
  struct Shared;
  void cast_ray(const Shared& shared, const Turn& azimuth, std::size_t elevation,
                double* range_W_per_rad, double* elevation_W_m3_per_rad) const;

  std::vector<double> elevations_rad_;
  std::vector<Turn> elevation_turns_;
  std::vector<renderer::NrcsTable> nrcs_;  // by material
};

}  // namespace fanbeam::benchmarks
