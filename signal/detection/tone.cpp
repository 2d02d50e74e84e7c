#include "signal/detection/tone.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/detection/tone_phasors_private.h"
#include "signal/fourier/fft.h"
#include "signal/fourier/peak_fit.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

void check_input(const ToneRecords& records, const std::vector<double>& weights) {
  const std::size_t count = records.empty() ? 0 : records.front().size();
  if (count < 2) refuse("samples", static_cast<double>(count), "2 or more");
  if (!weights.empty() && weights.size() != count)
    refuse("weights", static_cast<double>(weights.size()), "none or one per sample");
  for (const auto& record : records) {
    if (record.size() != count)
      refuse("samples", static_cast<double>(record.size()), "records of one size");
    check_finite("samples", record);
  }
}

// Power at a place and its first two derivatives by the place.
struct Slope {
  double power = 0.0;
  double first = 0.0;
  double second = 0.0;
};

Slope slope_at(const ToneRecords& records, const std::vector<double>& weights, double bin) {
  const std::size_t count = records.front().size();
  const double turn = -2.0 * core::kPi / static_cast<double>(count);
  const double middle = 0.5 * static_cast<double>(count - 1);
  const std::vector<std::complex<double>> phasors = tone_phasors(count, bin, weights);
  Slope slope;
  for (const auto& record : records) {
    std::complex<double> sum = 0.0, moment = 0.0, square = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
      const double t = turn * (static_cast<double>(n) - middle);
      const std::complex<double> value = record[n] * phasors[n];
      sum += value;
      moment += t * value;
      square += t * t * value;
    }
    const std::complex<double> first(-moment.imag(), moment.real());  // j moment
    slope.power += std::norm(sum);
    slope.first += 2.0 * (std::conj(sum) * first).real();
    slope.second += 2.0 * (std::norm(first) - (std::conj(sum) * square).real());
  }
  return slope;
}

}  // namespace

Tone refined_tone(const ToneRecords& records, double near_bin, const std::vector<double>& weights,
                  double tolerance_bins) {
  check_input(records, weights);
  Tone tone;
  tone.bin = near_bin;
  for (int step = 0; step < 30; ++step) {
    const Slope slope = slope_at(records, weights, tone.bin);
    if (slope.power == 0.0) break;
    // Outside the cap of the lobe only the direction can be trusted.
    const double wanted =
        slope.second < 0.0 ? -slope.first / slope.second : std::copysign(0.1, slope.first);
    const double move = std::clamp(wanted, -0.25, 0.25);
    tone.bin += move;
    if (std::abs(move) < tolerance_bins) break;
  }
  const std::size_t count = records.front().size();
  const std::vector<std::complex<double>> phasors = tone_phasors(count, tone.bin, weights);
  const double sum = sum_of_weights(count, weights);
  const std::complex<double> to_first = unit_phasor(-middle_turns(count, tone.bin));
  for (const auto& record : records) {
    std::complex<double> value = 0.0;
    for (std::size_t n = 0; n < count; ++n) value += record[n] * phasors[n];
    tone.amplitudes.push_back(value * to_first / sum);
    tone.power += std::norm(value / sum);
  }
  return tone;
}

std::vector<Tone> tones_at(const ToneRecords& records, const std::vector<double>& bins) {
  check_input(records, {});
  const std::size_t count = records.front().size();
  Eigen::MatrixXcd phasors(static_cast<Eigen::Index>(count),
                           static_cast<Eigen::Index>(bins.size()));
  for (std::size_t k = 0; k < bins.size(); ++k)
    for (std::size_t n = 0; n < count; ++n)
      phasors(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) =
          unit_phasor(bins[k] * static_cast<double>(n) / static_cast<double>(count));
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd> fit(phasors);
  std::vector<Tone> tones;
  for (const double bin : bins) tones.push_back({bin, {}, 0.0});
  for (const auto& record : records) {
    const Eigen::VectorXcd amplitudes = fit.solve(Eigen::Map<const Eigen::VectorXcd>(
        record.data(), static_cast<Eigen::Index>(record.size())));
    for (std::size_t k = 0; k < tones.size(); ++k) {
      tones[k].amplitudes.push_back(amplitudes(static_cast<Eigen::Index>(k)));
      tones[k].power += std::norm(tones[k].amplitudes.back());
    }
  }
  return tones;
}

Tone strongest_tone(const std::vector<std::complex<double>>& samples,
                    const std::vector<double>& weights) {
  check_input({samples}, weights);
  constexpr std::size_t kPadding = 2;
  std::vector<std::complex<double>> padded(kPadding * samples.size());
  for (std::size_t n = 0; n < samples.size(); ++n)
    padded[n] = weights.empty() ? samples[n] : samples[n] * weights[n];
  const auto lines = spectrum(std::move(padded));
  std::size_t peak = 0;
  for (std::size_t k = 1; k < lines.size(); ++k)
    if (std::norm(lines[k]) > std::norm(lines[peak])) peak = k;
  const std::size_t count = lines.size();
  const double offset =
      log_parabola_peak(std::norm(lines[(peak + count - 1) % count]), std::norm(lines[peak]),
                        std::norm(lines[(peak + 1) % count]))
          .offset;
  return refined_tone({samples}, (static_cast<double>(peak) + offset) / kPadding, weights);
}

}  // namespace fanbeam::signal
