#include "signal/receiver/mixer.h"

#include <algorithm>
#include <cmath>
#include <complex>
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

// Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", 1974.
std::vector<double> low_pass(double pass_Hz, double stop_Hz, double rate_Hz) {
  const double width = 2.0 * core::kPi * (stop_Hz - pass_Hz) / rate_Hz;
  const int half = static_cast<int>(std::ceil(0.5 * (kStop_dB - 8.0) / (2.285 * width)));
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

double turned(double turns) { return std::cos(2.0 * core::kPi * (turns - std::floor(turns))); }

}  // namespace

MixerTrace mixer_trace(const Waveform& waveform, const ScatterPath& echo) {
  check(waveform);
  check(waveform, {echo});
  if (waveform.kind == WaveformKind::pulsed || waveform.kind == WaveformKind::sinusoidal ||
      !(waveform.bandwidth_Hz > 0.0))
    core::throw_input_error(core::ErrorClass::unsupported, "waveform.kind",
                            std::string(name(waveform.kind)), "a waveform of ramps or steps");
  const Segment segment = stage_segments(waveform, 0).front();
  // Real samples show beats up to half their rate, complex ones, which the trace is the real part of, all of it.
  const int twice = waveform.complex_baseband ? 2 : 1;
  const int samples = twice * samples_per_segment(waveform, 0);
  const double rate_Hz = twice * waveform.sample_rate_Hz[0];
  // The low pass falls from half the trace's rate to twice the sweep.
  if (!(waveform.bandwidth_Hz >= 0.5 * rate_Hz))
    core::throw_input_error(
        core::ErrorClass::range, "waveform.bandwidth_Hz", waveform.bandwidth_Hz,
        core::number_text(0.5 * rate_Hz) +
            " or more, the highest beat of its samples: or sum and beat overlap");
  // A whole number of samples of the product for one of the beat.
  const auto times = static_cast<int>(std::ceil(kSweepsOfRate * waveform.bandwidth_Hz / rate_Hz));
  const double fine_Hz = rate_Hz * times;
  const double count = static_cast<double>(samples) * times;
  if (!(count <= kMostSamples))
    core::throw_input_error(core::ErrorClass::limit, "--mixer", count,
                            "at most 3e7 samples of the product: a shorter ramp, a smaller sweep");
  MixerTrace trace;
  trace.carrier_Hz = 1.5 * waveform.bandwidth_Hz;
  trace.step_s = 1.0 / fine_Hz;
  trace.sample_s = 1.0 / rate_Hz;
  const double shown_Hz =
      segment.start_frequency_Hz - waveform.centre_frequency_Hz + trace.carrier_Hz;
  // Half a sweep of warning before the sum at twice the lowest frequency.
  const std::vector<double> taps = low_pass(0.5 * rate_Hz, 2.0 * waveform.bandwidth_Hz, fine_Hz);
  const int reach = static_cast<int>(taps.size()) / 2;
  const PathGeometry geometry(echo, {}, {});
  std::vector<std::complex<double>> product;
  // The filter needs what comes before and after the segment: the ramp goes on.
  for (int n = -reach; n < static_cast<int>(count) + reach; ++n) {
    const double in_s = n * trace.step_s;
    const double delay_s = geometry.at(segment.start_s + in_s).length_m / core::kSpeedOfLight_mps;
    const double sent = shown_Hz * in_s + 0.5 * segment.slope_Hz_per_s * in_s * in_s;
    const double beat = beat_turns(waveform, segment, in_s, delay_s);
    const double s = turned(sent), r = turned(sent - beat);
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
