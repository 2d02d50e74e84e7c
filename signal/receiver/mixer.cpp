#include "signal/receiver/mixer.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/fourier/fast_convolution.h"
#include "signal/synthesis/beat_phase.h"

namespace fanbeam::signal {
namespace {

constexpr double kMostSamples = 3e7;
constexpr double kSweepsOfRate = 9.0;  // samples a second of the product over the sweep
constexpr double kStop_dB = 100.0;
// What the low pass reaches to either side, times what it takes to fall.
constexpr double kReach = 0.5 * (kStop_dB - 8.0) / (2.285 * 2.0 * core::kPi);

void check_samples(double count) {
  if (!(count <= kMostSamples))
    core::throw_input_error(core::ErrorClass::limit, "--mixer", count,
                            "at most 3e7 samples of the product: a shorter ramp, a smaller sweep");
}

// Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", 1974.
std::vector<double> low_pass(double pass_Hz, double stop_Hz, double rate_Hz) {
  const double wanted = std::ceil(kReach * rate_Hz / (stop_Hz - pass_Hz));
  check_samples(2.0 * wanted + 1.0);
  const int half = static_cast<int>(wanted);
  const double beta = 0.1102 * (kStop_dB - 8.7), cut = (pass_Hz + stop_Hz) / rate_Hz;
  std::vector<double> taps;
  double sum = 0.0;
  for (int n = -half; n <= half; ++n) {
    const double x = core::kPi * cut * n, place = static_cast<double>(n) / (half + 1);
    const double sinc = n == 0 ? 1.0 : std::sin(x) / x;
    taps.push_back(sinc * std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - place * place)));
    sum += taps.back();
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

// Where the low pass has to have fallen from `pass_Hz`: below the sum, whose lowest frequency this is, by what the sum sweeps
// at twice the slope within its reach; nothing where there is no such place.
std::optional<double> end_of_fall_Hz(double pass_Hz, double sum_Hz, double slope_Hz_per_s) {
  const double room_Hz = sum_Hz - pass_Hz;
  const double square = room_Hz * room_Hz - 8.0 * kReach * std::abs(slope_Hz_per_s);
  if (!(room_Hz > 0.1 * pass_Hz && square >= 0.0)) return std::nullopt;
  return pass_Hz + 0.5 * (room_Hz + std::sqrt(square));
}

double turned(double turns) { return std::cos(2.0 * core::kPi * (turns - std::floor(turns))); }

// Phases over one segment, in turns.
class Ramp {
 public:
  Ramp(const Waveform& waveform, const ScatterPath& echo, double carrier_Hz)
      : waveform_(waveform),
        segment_(stage_segments(waveform, 0).front()),
        geometry_(echo, {}, {}),
        shown_Hz_(segment_.start_frequency_Hz - waveform.centre_frequency_Hz + carrier_Hz) {}

  double sent(double in_s) const {
    return shown_Hz_ * in_s + 0.5 * segment_.slope_Hz_per_s * in_s * in_s;
  }
  double beat(double in_s) const {
    const double length_m = geometry_.at(segment_.start_s + in_s).length_m;
    return beat_turns(waveform_, segment_, in_s, length_m / core::kSpeedOfLight_mps);
  }
  // Twice what is transmitted less the beat: lowest at one of the ends.
  double lowest_sum_Hz(double step_s) const {
    const auto sum_Hz = [&](double in_s) {
      return 2.0 * (shown_Hz_ + segment_.slope_Hz_per_s * in_s) -
             (beat(in_s + step_s) - beat(in_s)) / step_s;
    };
    return std::min(sum_Hz(0.0), sum_Hz(segment_.duration_s));
  }
  double slope_Hz_per_s() const { return segment_.slope_Hz_per_s; }

 private:
  const Waveform& waveform_;
  Segment segment_;
  PathGeometry geometry_;
  double shown_Hz_;
};

// Falls from half the trace's rate to the sum.
std::vector<double> filter_below_sum(const Ramp& ramp, double bandwidth_Hz, double rate_Hz,
                                     double fine_Hz) {
  const double sum_Hz = ramp.lowest_sum_Hz(1.0 / fine_Hz);
  const auto stop = end_of_fall_Hz(0.5 * rate_Hz, sum_Hz, ramp.slope_Hz_per_s());
  if (!stop)
    core::throw_input_error(core::ErrorClass::range, "waveform.bandwidth_Hz", bandwidth_Hz,
                            "more: the sum begins at " + core::number_text(sum_Hz) +
                                " Hz, too near the " + core::number_text(0.5 * rate_Hz) +
                                " Hz up to which samples hold beats");
  return low_pass(0.5 * rate_Hz, *stop, fine_Hz);
}

}  // namespace

MixerTrace mixer_trace(const Waveform& waveform, const ScatterPath& echo) {
  check(waveform);
  check(waveform, {echo});
  if (waveform.kind == WaveformKind::pulsed || waveform.kind == WaveformKind::sinusoidal ||
      !(waveform.bandwidth_Hz > 0.0))
    core::throw_input_error(core::ErrorClass::unsupported, "waveform.kind",
                            std::string(name(waveform.kind)), "a waveform of ramps or steps");
  // Real samples show beats up to half their rate, complex ones, which the trace is the real part of, all of it.
  const int twice = waveform.complex_baseband ? 2 : 1;
  const int samples = twice * samples_per_segment(waveform, 0);
  const double rate_Hz = twice * waveform.sample_rate_Hz[0];
  // Whatever the echo: of the highest beat too the sum lies above the beats.
  if (!(waveform.bandwidth_Hz >= 0.5 * rate_Hz))
    core::throw_input_error(
        core::ErrorClass::range, "waveform.bandwidth_Hz", waveform.bandwidth_Hz,
        core::number_text(0.5 * rate_Hz) +
            " or more, the highest beat of its samples: or sum and beat overlap");
  // A whole number of samples of the product for one of the beat.
  const double times = std::ceil(kSweepsOfRate * waveform.bandwidth_Hz / rate_Hz);
  const double fine_Hz = rate_Hz * times;
  const double count = samples * times;
  check_samples(count);
  MixerTrace trace;
  trace.carrier_Hz = 1.5 * waveform.bandwidth_Hz;
  trace.step_s = 1.0 / fine_Hz;
  trace.sample_s = 1.0 / rate_Hz;
  const Ramp ramp(waveform, echo, trace.carrier_Hz);
  const std::vector<double> taps = filter_below_sum(ramp, waveform.bandwidth_Hz, rate_Hz, fine_Hz);
  const int reach = static_cast<int>(taps.size()) / 2;
  std::vector<std::complex<double>> product;
  // The filter needs what comes before and after the segment: the ramp goes on.
  for (int n = -reach; n < static_cast<int>(count) + reach; ++n) {
    const double in_s = n * trace.step_s, sent = ramp.sent(in_s);
    const double s = turned(sent), r = turned(sent - ramp.beat(in_s));
    product.emplace_back(s * r);
    if (n < 0 || n >= static_cast<int>(count)) continue;
    trace.transmitted.push_back(s);
    trace.received.push_back(r);
    trace.product.push_back(s * r);
  }
  const auto filtered = convolved(product, {taps.begin(), taps.end()});
  for (int n = 0; n < samples; ++n)
    trace.beat.push_back(filtered[static_cast<std::size_t>(n) * static_cast<std::size_t>(times) +
                                  2 * static_cast<std::size_t>(reach)]
                             .real());
  return trace;
}

}  // namespace fanbeam::signal
