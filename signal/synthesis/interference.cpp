#include "signal/synthesis/interference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/synthesis/frame.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

constexpr double kCorner = 0.45;        // of the sample rate
constexpr double kBeyondCorners = 3.2;  // |H| below 1e-4
constexpr double kMostCrossings = 1e8;

void check(const Interferer& one) {
  check_positive("interferer.start_frequency_Hz", one.start_frequency_Hz);
  check_positive("interferer.duration_s", one.duration_s);
  check_positive("interferer.range_m", one.range_m);
  check_not_negative("interferer.power_W", one.power_W);
  if (!(one.interval_s >= one.duration_s && std::isfinite(one.interval_s)))
    refuse("interferer.interval_s", one.interval_s, "at least the chirp's duration");
  for (const double value :
       {one.slope_Hz_per_s, one.start_s, one.radial_speed_mps, one.azimuth_rad, one.elevation_rad})
    if (!std::isfinite(value))
      core::throw_input_error(core::ErrorClass::nonfinite, "interferer", value, "finite");
}

struct Stretch {
  double from_s, to_s;  // since the own segment began
};

// One segment of the own waveform, one interferer, one receiver.
class Crossing {
 public:
  Crossing(const Segment& segment, const Interferer& other, const glm::dvec3& receiver_m,
           double sample_rate_Hz)
      : segment_(segment), other_(other), corner_Hz_(kCorner * sample_rate_Hz) {
    const glm::dvec3 u = direction(other.azimuth_rad, other.elevation_rad);
    // Far from the array: |x - p| = R + v t - u . p.
    ahead_s_ =
        (u.x * receiver_m.x + u.y * receiver_m.y + u.z * receiver_m.z) / core::kSpeedOfLight_mps;
  }

  double delay_s(double time_s) const {
    return (other_.range_m + other_.radial_speed_mps * time_s) / core::kSpeedOfLight_mps - ahead_s_;
  }

  // The chirps that are heard within the segment: whole numbers from first to last.
  std::pair<double, double> chirps() const {
    const double from_s = segment_.start_s - other_.start_s - delay_s(segment_.start_s);
    const double to_s = from_s + segment_.duration_s;
    return {std::floor((from_s - other_.duration_s) / other_.interval_s),
            std::ceil(to_s / other_.interval_s)};
  }

  // Where chirp k is heard, in the receiver's band.
  Stretch stretch(double k) const {
    const double begin_s = begin_of(k) - segment_.start_s;
    Stretch heard{std::max(0.0, begin_s),
                  std::min(segment_.duration_s, begin_s + other_.duration_s)};
    const double at_0_Hz =
        segment_.start_frequency_Hz - other_.start_frequency_Hz + other_.slope_Hz_per_s * begin_s;
    const double slope = segment_.slope_Hz_per_s - other_.slope_Hz_per_s;
    const double band_Hz = kBeyondCorners * corner_Hz_;
    if (slope == 0.0) {
      if (std::abs(at_0_Hz) > band_Hz) heard.to_s = heard.from_s;
      return heard;
    }
    const double a = (-band_Hz - at_0_Hz) / slope, b = (band_Hz - at_0_Hz) / slope;
    return {std::max(heard.from_s, std::min(a, b)), std::min(heard.to_s, std::max(a, b))};
  }

  // Its beat, `in_s` since the segment began, of amplitude 1 at the middle of the band.
  std::complex<double> beat(double k, double in_s) const {
    const double since_s = segment_.start_s + in_s - other_.start_s - k * other_.interval_s -
                           delay_s(segment_.start_s + in_s);
    const double started_s = other_.start_s + k * other_.interval_s;
    const double turns =
        segment_.start_frequency_Hz * in_s + 0.5 * segment_.slope_Hz_per_s * in_s * in_s -
        other_.start_frequency_Hz * since_s - 0.5 * other_.slope_Hz_per_s * since_s * since_s +
        whole_off(segment_.start_frequency_Hz * segment_.start_s) -
        whole_off(other_.start_frequency_Hz * started_s);
    const double offset_Hz = segment_.start_frequency_Hz + segment_.slope_Hz_per_s * in_s -
                             other_.start_frequency_Hz - other_.slope_Hz_per_s * since_s;
    const double ratio = offset_Hz / corner_Hz_;
    return unit_phasor(turns) / std::sqrt(1.0 + std::pow(ratio * ratio, 8));
  }

 private:
  static double whole_off(double turns) { return turns - std::floor(turns); }
  double begin_of(double k) const {
    const double left_s = other_.start_s + k * other_.interval_s;
    return left_s + delay_s(left_s);
  }

  const Segment& segment_;
  const Interferer& other_;
  double corner_Hz_, ahead_s_ = 0.0;
};

// Adds to the samples of one chirp of one channel; how many got half the amplitude or more.
std::size_t add(const Crossing& crossing, double amplitude, double sample_rate_Hz, int samples,
                std::complex<float>* to) {
  std::size_t strong = 0;
  const auto [first, last] = crossing.chirps();
  for (double k = first; k <= last; ++k) {
    const Stretch stretch = crossing.stretch(k);
    if (!(stretch.from_s < stretch.to_s)) continue;
    const int begin = std::max(0, static_cast<int>(std::ceil(stretch.from_s * sample_rate_Hz)));
    for (int n = begin; n < samples && n < stretch.to_s * sample_rate_Hz; ++n) {
      const std::complex<double> beat = crossing.beat(k, n / sample_rate_Hz);
      strong += std::norm(beat) >= 0.25 ? 1 : 0;
      to[n] += static_cast<std::complex<float>>(amplitude * beat);
    }
  }
  return strong;
}

}  // namespace

double interference_power_W(double eirp_W, double receive_gain, double wavelength_m,
                            double range_m) {
  check_not_negative("eirp_W", eirp_W);
  check_positive("range_m", range_m);
  const double spread = wavelength_m / (4.0 * core::kPi * range_m);
  return eirp_W * receive_gain * spread * spread;
}

void check_hears_others(const Waveform& waveform) {
  if (waveform.kind == WaveformKind::pulsed || waveform.kind == WaveformKind::sinusoidal)
    core::throw_input_error(core::ErrorClass::unsupported, "waveform.kind",
                            std::string(name(waveform.kind)), "ramps or tones beside interferers");
}

std::size_t add_interference(const Waveform& waveform, int stage, const Array& array,
                             const std::vector<Interferer>& interferers, FloatCube& cube) {
  if (interferers.empty()) return 0;
  check_hears_others(waveform);
  const Frame frame = make_frame(waveform, stage, array);
  if (!(cube.shape == frame.shape)) refuse("cube.samples", cube.shape.samples, "the waveform's");
  for (const Interferer& one : interferers) {
    check(one);
    const double crossings = waveform.duration_s() / one.interval_s * frame.shape.channels;
    if (!(crossings <= kMostCrossings))
      core::throw_input_error(core::ErrorClass::limit, "interferer.interval_s", one.interval_s,
                              "at most 1e8 of its chirps in a frame, channels counted");
  }
  const auto chirps = static_cast<std::size_t>(cube.shape.chirps);
  std::vector<std::size_t> strong(chirps * static_cast<std::size_t>(cube.shape.channels));
  core::parallel_for(strong.size(), [&](std::size_t row) {
    const int channel = static_cast<int>(row / chirps), chirp = static_cast<int>(row % chirps);
    const glm::dvec3& receiver_m =
        array.receivers_m[static_cast<std::size_t>(array.receiver_of(channel))];
    const Segment& segment = frame.segment(channel, chirp);
    for (const Interferer& one : interferers)
      strong[row] += add(Crossing(segment, one, receiver_m, frame.sample_rate_Hz),
                         std::sqrt(one.power_W), frame.sample_rate_Hz, cube.shape.samples,
                         cube.values.data() + cube.index(channel, chirp, 0));
  });
  return std::accumulate(strong.begin(), strong.begin() + static_cast<std::ptrdiff_t>(chirps),
                         std::size_t{0});
}

}  // namespace fanbeam::signal
