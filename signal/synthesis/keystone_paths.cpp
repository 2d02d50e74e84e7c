#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/fourier/fft.h"
#include "signal/synthesis/keystone_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

constexpr double c_mps = core::kSpeedOfLight_mps;
constexpr std::size_t kPathsAtOnce = 4096;  // paths of one piece of work

// Sum of squares of the two elements of every channel: what the near field depends on.
struct NearField {
  double mean_m2 = 0.0, deviation_m2 = 0.0;
};

NearField near_field(const Frame& frame) {
  double sum = 0.0, squares = 0.0;
  for (const glm::dvec3& t : frame.array.transmitters_m)
    for (const glm::dvec3& r : frame.array.receivers_m) {
      const double q_m2 = t.y * t.y + r.y * r.y;
      sum += q_m2;
      squares += q_m2 * q_m2;
    }
  const double mean_m2 = sum / frame.shape.channels;
  return {mean_m2, std::sqrt(std::max(0.0, squares / frame.shape.channels - mean_m2 * mean_m2))};
}

KeystonePath keystone_path(const Frame& frame, double reference_s, const NearField& near_m2,
                           const ScatterPath& path) {
  const Segment& segment = frame.segments.front();
  const double middle_Hz = sample_frequency_Hz(frame, frame.shape.samples / 2);
  const double range_m = path.range_m + path.radial_speed_mps * reference_s;
  const double delay_s = 2.0 * range_m / c_mps;
  const double sweep_Hz = segment.slope_Hz_per_s * delay_s;
  const double scale = 1.0 - sweep_Hz / middle_Hz;
  const double rate = 2.0 * path.radial_speed_mps / c_mps;
  const double sine = std::cos(path.elevation_rad) * std::sin(path.azimuth_rad);
  const double bulge_per_m2 = middle_Hz / c_mps * (1.0 - sine * sine) / (2.0 * range_m);

  KeystonePath seen;
  seen.rate = rate * scale;
  seen.sine_s_per_m = sine * scale / c_mps;
  seen.delay_turns_per_sample = sweep_Hz / frame.sample_rate_Hz;
  const double turns = (middle_Hz - 0.5 * sweep_Hz) * delay_s + bulge_per_m2 * near_m2.mean_m2;
  seen.value = path.amplitude_sqrtW * unit_phasor(turns);

  const double half_s = 0.5 * frame.interval_s * frame.shape.chirps;
  const double moved = rate * half_s;
  const double bend = 0.5 * segment.slope_Hz_per_s * moved * moved / std::sqrt(5.0);
  const double ramp_Hz = std::abs(segment.slope_Hz_per_s) * segment.duration_s;
  const double drift = std::abs(sweep_Hz) * 0.5 * ramp_Hz / middle_Hz * std::abs(moved) / 3.0;
  const double bulge = bulge_per_m2 * near_m2.deviation_m2;
  seen.error_rad = 2.0 * core::kPi * std::sqrt(bulge * bulge + bend * bend + drift * drift);
  return seen;
}

WaveAxis axis(double least, double most, double step, int width) {
  WaveAxis made;
  made.step = step;
  made.first = least - (0.5 * width + 1.0) * step;
  made.cells = static_cast<int>(std::min(1e9, std::ceil((most - least) / step))) + width + 3;
  return made;
}

}  // namespace

double sample_frequency_Hz(const Frame& frame, int sample) {
  const Segment& segment = frame.segments.front();
  return segment.start_frequency_Hz + segment.slope_Hz_per_s * sample / frame.sample_rate_Hz;
}

double element_m(const Frame& frame, int channel) {
  return frame.array.transmitters_m[static_cast<std::size_t>(frame.array.transmitter_of(channel))]
             .y +
         frame.array.receivers_m[static_cast<std::size_t>(frame.array.receiver_of(channel))].y;
}

std::vector<KeystonePath> keystone_paths(const Frame& frame, double reference_s,
                                         const std::vector<ScatterPath>& paths) {
  const NearField near_m2 = near_field(frame);
  std::vector<KeystonePath> seen(paths.size());
  core::parallel_for((paths.size() + kPathsAtOnce - 1) / kPathsAtOnce, [&](std::size_t chunk) {
    const std::size_t end = std::min(paths.size(), (chunk + 1) * kPathsAtOnce);
    for (std::size_t i = chunk * kPathsAtOnce; i < end; ++i)
      seen[i] = keystone_path(frame, reference_s, near_m2, paths[i]);
  });
  return seen;
}

KeystoneAxes keystone_axes(const Frame& frame, const std::vector<KeystonePath>& paths, int width,
                           double reference_s) {
  KeystonePath least, most;
  if (!paths.empty()) least = most = paths.front();
  for (const KeystonePath& path : paths) {
    least.rate = std::min(least.rate, path.rate);
    most.rate = std::max(most.rate, path.rate);
    least.sine_s_per_m = std::min(least.sine_s_per_m, path.sine_s_per_m);
    most.sine_s_per_m = std::max(most.sine_s_per_m, path.sine_s_per_m);
  }
  double farthest_m = 1e-2 * frame.waveform.wavelength_m();
  for (int channel = 0; channel < frame.shape.channels; ++channel)
    farthest_m = std::max(farthest_m, std::abs(element_m(frame, channel)));
  const double highest_Hz =
      std::max(sample_frequency_Hz(frame, 0), sample_frequency_Hz(frame, frame.shape.samples));
  const double half_s =
      std::max(reference_s - frame.segments.front().start_s,
               frame.segments.back().start_s + frame.segments.back().duration_s - reference_s);
  // Twice as fine as the span of times and elements asks for: at most a quarter of a turn a cell.
  KeystoneAxes axes;
  axes.rate = axis(least.rate, most.rate, 0.25 / (highest_Hz * half_s), width);
  axes.sine_s_per_m =
      axis(least.sine_s_per_m, most.sine_s_per_m, 0.25 / (highest_Hz * farthest_m), width);
  axes.delays = 2 * fast_length(std::max(frame.shape.samples, 8));
  axes.reference_s = reference_s;
  return axes;
}

}  // namespace fanbeam::signal
