#include "signal/receiver/mitigation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/errors.h"
#include "core/median.h"
#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"

namespace fanbeam::signal {
namespace {

constexpr int kMargin = 2;
constexpr int kTurns = 20;
// Of one real channel noise is a square of a normal value: 52.8 times its median in one sample of 2^20, where that of a
// complex one is 20 times.
constexpr double kRealOverComplex = 2.64;

using Crossed = std::vector<bool>;

// Of the chirp of these channels.
Crossed crossed_samples(const FloatCube& cube, const std::vector<int>& channels, int chirp,
                        double threshold) {
  const int samples = cube.shape.samples;
  std::vector<double> powers(static_cast<std::size_t>(samples));
  for (const int channel : channels)
    for (int n = 0; n < samples; ++n)
      powers[static_cast<std::size_t>(n)] +=
          static_cast<double>(std::norm(cube.at(channel, chirp, n)));
  const double middle = core::median(powers);
  Crossed crossed(powers.size(), false);
  if (!(middle > 0.0)) return crossed;
  for (int n = 0; n < samples; ++n) {
    if (powers[static_cast<std::size_t>(n)] < threshold * middle) continue;
    for (int k = std::max(0, n - kMargin); k <= std::min(samples - 1, n + kMargin); ++k)
      crossed[static_cast<std::size_t>(k)] = true;
  }
  return crossed;
}

// The lines of the rest, ever weaker ones, put into the gaps.
void fill(const Crossed& crossed, std::complex<float>* values) {
  const std::size_t count = crossed.size();
  std::vector<std::complex<double>> guess(count), known(count);
  for (std::size_t n = 0; n < count; ++n)
    guess[n] = known[n] = crossed[n] ? std::complex<double>() : std::complex<double>(values[n]);
  double from = 0.0, to = 0.0;
  for (int turn = 0; turn < kTurns; ++turn) {
    std::vector<std::complex<double>> lines = spectrum(guess);
    if (turn == 0) {
      for (const auto& line : lines) {
        from = std::max(from, std::abs(line));
        to += std::abs(line) / static_cast<double>(count);
      }
      if (!(from > 0.0)) break;
    }
    const double least = from * std::pow(to / from, (turn + 1.0) / kTurns);
    for (auto& line : lines)
      if (std::abs(line) < least) line = 0.0;
    const std::vector<std::complex<double>> made = inverse_spectrum(std::move(lines));
    for (std::size_t n = 0; n < count; ++n) guess[n] = crossed[n] ? made[n] : known[n];
  }
  for (std::size_t n = 0; n < count; ++n)
    if (crossed[n]) values[n] = static_cast<std::complex<float>>(guess[n]);
}

}  // namespace

std::string_view name(Mitigation mitigation) {
  switch (mitigation) {
    case Mitigation::none:
      return "none";
    case Mitigation::zero:
      return "zero";
    case Mitigation::interpolate:
      return "interpolate";
  }
  throw core::InternalError("unknown mitigation");
}

std::optional<Mitigation> mitigation_of(std::string_view text) {
  for (const Mitigation each : {Mitigation::none, Mitigation::zero, Mitigation::interpolate})
    if (name(each) == text) return each;
  return std::nullopt;
}

std::size_t mitigate(Mitigation mitigation, double threshold, const Waveform& waveform,
                     const Array& array, FloatCube& cube) {
  if (!(threshold > 1.0)) refuse("threshold", threshold, "above 1");
  if (cube.shape.channels != array.channels())
    refuse("cube.channels", cube.shape.channels, "the channels of the array");
  if (mitigation == Mitigation::none) return 0;
  // Channels of one transmitter's slot, or all, are received in the same moment.
  std::vector<std::vector<int>> groups(static_cast<std::size_t>(array.slots()));
  for (int channel = 0; channel < array.channels(); ++channel)
    groups[groups.size() == 1 ? 0 : static_cast<std::size_t>(array.transmitter_of(channel))]
        .push_back(channel);
  const auto chirps = static_cast<std::size_t>(cube.shape.chirps);
  std::vector<std::size_t> mended(groups.size() * chirps);
  core::parallel_for(mended.size(), [&](std::size_t row) {
    const std::vector<int>& channels = groups[row / chirps];
    const int chirp = static_cast<int>(row % chirps);
    const bool is_one_real = channels.size() == 1 && !waveform.complex_baseband;
    const Crossed crossed = crossed_samples(cube, channels, chirp,
                                            is_one_real ? kRealOverComplex * threshold : threshold);
    const auto count = static_cast<std::size_t>(std::count(crossed.begin(), crossed.end(), true));
    if (count == 0 || 2 * count > crossed.size()) return;
    for (const int channel : channels) {
      std::complex<float>* const values = cube.values.data() + cube.index(channel, chirp, 0);
      if (mitigation == Mitigation::interpolate) {
        fill(crossed, values);
        continue;
      }
      for (std::size_t n = 0; n < crossed.size(); ++n)
        if (crossed[n]) values[n] = 0.0F;
    }
    mended[row] = count * channels.size();
  });
  return std::accumulate(mended.begin(), mended.end(), std::size_t{0});
}

}  // namespace fanbeam::signal
