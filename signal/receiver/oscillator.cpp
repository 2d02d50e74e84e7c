#include "signal/receiver/oscillator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/parallel.h"
#include "core/random_normals.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"

namespace fanbeam::signal {
namespace {

// The offsets of the draws lie at the multiples of 1 / kPeriods of a chirp's own.
constexpr int kPeriods = 8;

int offsets_of(int samples) { return kPeriods * samples / 2; }

double offset_step_Hz(double sample_rate_Hz, int samples) {
  return sample_rate_Hz / (static_cast<double>(kPeriods) * samples);
}

double correlated(double offset_Hz, double delay_s) {
  const double sine = std::sin(core::kPi * offset_Hz * delay_s);
  return 4.0 * sine * sine;
}

}  // namespace

PhaseNoiseTable lorentzian(double line_width_Hz) {
  check_positive("line_width_Hz", line_width_Hz);
  const double at_1_Hz = 10.0 * std::log10(line_width_Hz / (2.0 * core::kPi));
  return {{1.0, 1e9}, {at_1_Hz, at_1_Hz - 180.0}};
}

void check(const PhaseNoiseTable& table) {
  check_count("phase noise offsets", static_cast<double>(table.offsets_Hz.size()), 1, 100);
  if (table.levels_dBc_per_Hz.size() != table.offsets_Hz.size())
    refuse("phase noise levels", static_cast<double>(table.levels_dBc_per_Hz.size()),
           "one for every offset");
  double before_Hz = 0.0;
  for (const double offset_Hz : table.offsets_Hz) {
    if (!(offset_Hz > before_Hz && offset_Hz <= 1e12))
      refuse("phase noise offset", offset_Hz, "rising, above 0 to 1e12 Hz");
    before_Hz = offset_Hz;
  }
  for (const double level : table.levels_dBc_per_Hz)
    if (!(level >= -300.0 && level <= 60.0))
      refuse("phase noise level", level, "-300 to 60 dBc/Hz");
}

double phase_density_rad2_per_Hz(const PhaseNoiseTable& table, double offset_Hz) {
  const std::vector<double>& at = table.offsets_Hz;
  const std::vector<double>& level = table.levels_dBc_per_Hz;
  const auto next =
      static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), offset_Hz) - at.begin());
  double dB = next == 0 ? level.front() : level.back();
  if (next > 0 && next < at.size()) {
    const double share = std::log(offset_Hz / at[next - 1]) / std::log(at[next] / at[next - 1]);
    dB = level[next - 1] + share * (level[next] - level[next - 1]);
  }
  return std::pow(10.0, 0.1 * dB);
}

ResidualPhase residual_phase(const PhaseNoiseTable& table, double delay_s, double sample_rate_Hz,
                             int samples) {
  check(table);
  check_not_negative("delay_s", delay_s);
  check_positive("sample_rate_Hz", sample_rate_Hz);
  const double step_Hz = offset_step_Hz(sample_rate_Hz, samples);
  double variance = 0.0, bound = 0.0, largest = 0.0;
  for (int k = 1; k < offsets_of(samples); ++k) {
    const double offset_Hz = k * step_Hz;
    const double density = phase_density_rad2_per_Hz(table, offset_Hz);
    variance += 2.0 * step_Hz * density * correlated(offset_Hz, delay_s);
    const double most = density * std::min(4.0, std::pow(2.0 * core::kPi * offset_Hz * delay_s, 2));
    bound += 2.0 * step_Hz * most;
    largest = std::max(largest, most);
  }
  return {std::sqrt(variance), std::sqrt(bound), largest};
}

void apply_oscillator(const PhaseNoiseTable& table, double delay_s, double sample_rate_Hz,
                      const core::RandomKey& key, const Array& array, FloatCube& cube) {
  check(table);
  check_not_negative("delay_s", delay_s);
  check_positive("sample_rate_Hz", sample_rate_Hz);
  core::RandomKey draws = key;
  draws.stream = core::kStreamPhaseNoise;
  const int samples = cube.shape.samples, offsets = offsets_of(samples);
  const double step_Hz = offset_step_Hz(sample_rate_Hz, samples);
  std::vector<std::complex<double>> scale;  // of each offset
  for (int k = 0; k < offsets; ++k) {
    const double offset_Hz = k * step_Hz;
    const double sigma =
        k == 0 ? 0.0 : std::sqrt(2.0 * step_Hz * phase_density_rad2_per_Hz(table, offset_Hz));
    scale.push_back(sigma * (1.0 - std::polar(1.0, -2.0 * core::kPi * offset_Hz * delay_s)));
  }
  const int slots = array.slots();
  const auto in_turn = static_cast<std::size_t>(slots);
  core::parallel_for(static_cast<std::size_t>(cube.shape.chirps) * in_turn, [&](std::size_t chirp) {
    std::vector<float> normals(2 * static_cast<std::size_t>(offsets));
    core::normal_numbers(draws, 0, static_cast<std::uint64_t>(chirp) << 32U, normals.size(),
                         normals.data());
    std::vector<std::complex<double>> lines(static_cast<std::size_t>(kPeriods * samples));
    for (std::size_t k = 0; k < scale.size(); ++k)
      lines[k] = scale[k] * std::complex<double>(normals[2 * k], normals[2 * k + 1]);
    // Unscaled: the sum over the offsets at every sample.
    Fft<double>(
        {.length = kPeriods * samples, .stride = 1, .batches = 1, .distance = kPeriods * samples},
        FftDirection::inverse)
        .run(lines.data());
    const int m = static_cast<int>(chirp) / slots, slot = static_cast<int>(chirp) % slots;
    for (int n = 0; n < samples; ++n) {
      const auto turn = static_cast<std::complex<float>>(
          std::polar(1.0, lines[static_cast<std::size_t>(n)].real()));
      for (int channel = 0; channel < cube.shape.channels; ++channel)
        if (slots == 1 || array.transmitter_of(channel) == slot) cube.at(channel, m, n) *= turn;
    }
  });
}

std::vector<DelayGroup> delay_groups(const std::vector<double>& delays_s) {
  constexpr std::size_t kMostGroups = 32;
  std::vector<std::size_t> order(delays_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return delays_s[a] < delays_s[b]; });
  std::vector<DelayGroup> groups;
  if (order.empty()) return groups;
  const double least_s = std::max(delays_s[order.front()], 1e-12);
  const double ratio = std::max(1.0, delays_s[order.back()] / least_s);
  // Wide enough for the longest delay to be in the last of them.
  const double width = order.size() <= kMostGroups ? 0.0 : std::log(ratio) / kMostGroups;
  double until_s = -1.0;
  for (const std::size_t i : order) {
    if (groups.empty() || delays_s[i] > until_s) {
      groups.push_back({});
      const double from_s = std::max(delays_s[i], least_s);
      until_s = from_s * std::exp(width);
      groups.back().delay_s = from_s * std::exp(0.5 * width);
    }
    groups.back().members.push_back(i);
  }
  for (DelayGroup& group : groups)
    if (group.members.size() == 1) group.delay_s = delays_s[group.members.front()];
  return groups;
}

}  // namespace fanbeam::signal
