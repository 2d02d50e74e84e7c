#include <algorithm>
#include <array>
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

glm::dvec3 virtual_element_m(const Frame& frame, int channel) {
  const auto t = static_cast<std::size_t>(frame.array.transmitter_of(channel));
  const auto r = static_cast<std::size_t>(frame.array.receiver_of(channel));
  return frame.array.transmitters_m[t] + frame.array.receivers_m[r];
}

// What a channel adds to the two-way length in the near field, times twice the range: the squares
// of its two elements less those along the direction u of the path. Linear in six products, so that
// its mean and deviation over a row's channels need no look at them for every path.
class NearField {
 public:
  NearField(const Frame& frame, const ElementRow& row) {
    for (const int channel : row.channels) {
      const Products p = products(frame, channel);
      for (std::size_t i = 0; i < 6; ++i)
        mean_[i] += p[i] / static_cast<double>(row.channels.size());
    }
    for (const int channel : row.channels) {
      const Products p = products(frame, channel);
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          covariance_[i][j] +=
              (p[i] - mean_[i]) * (p[j] - mean_[j]) / static_cast<double>(row.channels.size());
    }
  }

  struct Added {
    double mean_m2 = 0.0, deviation_m2 = 0.0;
  };
  Added along(const glm::dvec3& u) const {
    const Products w = {1.0 - u.x * u.x,  1.0 - u.y * u.y,  1.0 - u.z * u.z,
                        -2.0 * u.x * u.y, -2.0 * u.x * u.z, -2.0 * u.y * u.z};
    double mean_m2 = 0.0, variance_m4 = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      mean_m2 += w[i] * mean_[i];
      for (std::size_t j = 0; j < 6; ++j) variance_m4 += w[i] * covariance_[i][j] * w[j];
    }
    return {mean_m2, std::sqrt(std::max(0.0, variance_m4))};
  }

 private:
  using Products = std::array<double, 6>;  // xx, yy, zz, xy, xz, yz

  static Products products(const Frame& frame, int channel) {
    Products sum{};
    for (const glm::dvec3& p :
         {frame.array.transmitters_m[static_cast<std::size_t>(frame.array.transmitter_of(channel))],
          frame.array.receivers_m[static_cast<std::size_t>(frame.array.receiver_of(channel))]}) {
      const Products of = {p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z};
      for (std::size_t i = 0; i < 6; ++i) sum[i] += of[i];
    }
    return sum;
  }
  Products mean_{};
  std::array<Products, 6> covariance_{};
};

KeystonePath keystone_path(const Frame& frame, const ElementRow& row, double reference_s,
                           const NearField& near, const ScatterPath& path) {
  const Segment& segment = frame.segments.front();
  const double middle_Hz = sample_frequency_Hz(frame, frame.shape.samples / 2);
  const double range_m = path.range_m + path.radial_speed_mps * reference_s;
  const glm::dvec3 u = direction(path.azimuth_rad, path.elevation_rad);
  const double delay_s = (2.0 * range_m - u.x * row.forward_m - u.z * row.up_m) / c_mps;
  const double sweep_Hz = segment.slope_Hz_per_s * delay_s;
  const double scale = 1.0 - sweep_Hz / middle_Hz;
  const double rate = 2.0 * path.radial_speed_mps / c_mps;
  const double bulge_per_m2 = middle_Hz / c_mps / (2.0 * range_m);
  const NearField::Added added = near.along(u);

  KeystonePath seen;
  seen.rate = rate * scale;
  seen.sine_s_per_m = u.y * scale / c_mps;
  seen.delay_turns_per_sample = sweep_Hz / frame.sample_rate_Hz;
  const double turns = (middle_Hz - 0.5 * sweep_Hz) * delay_s + bulge_per_m2 * added.mean_m2;
  seen.value = path.amplitude_sqrtW * unit_phasor(turns);

  const double half_s = 0.5 * frame.interval_s * frame.shape.chirps;
  const double moved = rate * half_s;
  const double bend = 0.5 * segment.slope_Hz_per_s * moved * moved / std::sqrt(5.0);
  const double ramp_Hz = std::abs(segment.slope_Hz_per_s) * segment.duration_s;
  const double drift = std::abs(sweep_Hz) * 0.5 * ramp_Hz / middle_Hz * std::abs(moved) / 3.0;
  const double bulge = bulge_per_m2 * added.deviation_m2;
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

double element_m(const Frame& frame, int channel) { return virtual_element_m(frame, channel).y; }

std::vector<ElementRow> element_rows(const Frame& frame) {
  // Sums of the same places in another order differ by rounding.
  const double alike_m = 1e-6 * frame.waveform.wavelength_m();
  std::vector<ElementRow> rows;
  for (int channel = 0; channel < frame.shape.channels; ++channel) {
    const glm::dvec3 at_m = virtual_element_m(frame, channel);
    auto row = std::find_if(rows.begin(), rows.end(), [&](const ElementRow& known) {
      return std::abs(known.forward_m - at_m.x) <= alike_m &&
             std::abs(known.up_m - at_m.z) <= alike_m;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), {at_m.x, at_m.z, {}});
    row->channels.push_back(channel);
  }
  return rows;
}

std::vector<KeystonePath> keystone_paths(const Frame& frame, const ElementRow& row,
                                         double reference_s,
                                         const std::vector<ScatterPath>& paths) {
  const NearField near(frame, row);
  std::vector<KeystonePath> seen(paths.size());
  core::parallel_for((paths.size() + kPathsAtOnce - 1) / kPathsAtOnce, [&](std::size_t chunk) {
    const std::size_t end = std::min(paths.size(), (chunk + 1) * kPathsAtOnce);
    for (std::size_t i = chunk * kPathsAtOnce; i < end; ++i)
      seen[i] = keystone_path(frame, row, reference_s, near, paths[i]);
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
