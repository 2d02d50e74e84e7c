#include "measure/effort.h"

namespace fanbeam::measure {

const std::vector<double>& Effort::ladder(Way way) const {
  switch (way) {
    case Way::rays:
      return rays;
    case Way::slices:
      return slices;
    case Way::naive_dithered:
      return dithered_rays;
    case Way::naive_plain:
      break;
  }
  return plain_rays;
}

renderer::Sampling Effort::reference(std::uint64_t seed) const {
  return renderer::reference_sampling(seed, reference_passes);
}

Effort full_effort() {
  Effort effort;
  effort.rays = {0.5, 1, 2, 4, 8, 16, 32};
  effort.slices = {0.5, 1, 2, 4, 8, 12, 16, 24, 32, 64};
  effort.plain_rays = {2, 12, 36};
  effort.dithered_rays = {2, 6, 12, 24, 60};
  effort.looks = {1, 5, 20};
  return effort;
}

Effort quick_effort() {
  Effort effort;
  effort.quick = true;
  effort.repetitions = 3;
  effort.reference_passes = 2;
  effort.rays = {0.5, 4, 16};
  effort.slices = {1, 8, 32};
  effort.plain_rays = {2, 12};
  effort.dithered_rays = {2, 12, 36};
  effort.looks = {1, 4};
  return effort;
}

renderer::Sampling sampling_of(Way way, double fineness) {
  const bool slices = way == Way::slices;
  return renderer::sampling_for(slices ? renderer::CasterKind::profile : renderer::CasterKind::rays,
                                fineness);
}

renderer::NaiveKind naive_kind(Way way) {
  return way == Way::naive_plain ? renderer::NaiveKind::plain : renderer::NaiveKind::dithered;
}

double Pace::step_ms(Way way, double fineness) const {
  // What a frame costs before its first ray or slice.
  constexpr double kFixed = 0.25;
  switch (way) {
    case Way::rays:
      return frame_ms * (kFixed + (1.0 - kFixed) * fineness / renderer::kDefaultRaysPerCell);
    case Way::slices:
      return slices_ms * fineness / renderer::kDefaultSlicesPerColumn;
    case Way::naive_dithered:
    case Way::naive_plain:
      break;
  }
  return naive_ms * fineness;
}

double Pace::reference_s(const Effort& effort) const {
  // Measured: a reference takes as long as some 220 frames at default sampling.
  return 0.22 * frame_ms * effort.reference_passes / 16.0;
}

double Pace::ladder_s(const Effort& effort) const {
  constexpr double kWarmUps = 6.0;  // of time_in_turns, and the picture that is judged
  double sum_ms = 0.0;
  for (const Way way : kWays)
    for (const double fineness : effort.ladder(way)) sum_ms += step_ms(way, fineness);
  return (effort.repetitions + kWarmUps) * sum_ms / 1000.0;
}

}  // namespace fanbeam::measure
