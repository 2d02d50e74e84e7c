#include "signal/scan/column_scan.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "sensors/antenna/column_place.h"
#include "sensors/receiver/point_response.h"
#include "signal/fourier/fft.h"
#include "signal/scan/column_sweep.h"
#include "signal/synthesis/beat_synthesis.h"

namespace fanbeam::signal {
namespace {

CubeShape shape_of(const sensors::Sensor& sensor) {
  return {samples_per_segment(column_sweep(sensor, 0), 0), sensor.scan.columns, 1};
}

// w[n], and divided by sqrt(N sum w^2).
std::vector<double> scaled_weights(const sensors::Sensor& sensor, int samples) {
  if (sensor.waveform.window == sensors::Waveform::Window::none)
    core::throw_input_error(core::ErrorClass::unsupported, "waveform.window", "\"none\"",
                            "a window: no sweep has ideal range cells");
  const std::vector<double> terms = sensors::window_coefficients(sensor.waveform);
  std::vector<double> weights(static_cast<std::size_t>(samples));
  double squares = 0.0;
  for (int n = 0; n < samples; ++n) {
    const double t = (n - samples / 2) / static_cast<double>(samples);
    double weight = terms[0];
    for (std::size_t m = 1; m < terms.size(); ++m)
      weight += 2.0 * terms[m] * std::cos(2.0 * core::kPi * static_cast<double>(m) * t);
    weights[static_cast<std::size_t>(n)] = weight;
    squares += weight * weight;
  }
  for (double& weight : weights) weight /= std::sqrt(samples * squares);
  return weights;
}

// Samples of one column to the power in its range cells.
class CellReader {
 public:
  CellReader(const sensors::Sensor& sensor, int samples)
      : gate_(sensor.range),
        samples_(samples),
        weights_(scaled_weights(sensor, samples)),
        fft_({samples, 1, 1, samples}, FftDirection::forward) {
    const double first = gate_.minimum_m / gate_.cell_m + 0.5;
    first_bin_ = static_cast<int>(std::floor(first));
    beside_bin_ = first - first_bin_;
  }

  // Writes every `columns`-th value from `cells_W` on. `shift`: what is added to the beat, in bins.
  void read(const std::complex<float>* beat, double shift, int columns, double* cells_W) const {
    std::vector<std::complex<double>> values(static_cast<std::size_t>(samples_));
    for (int n = 0; n < samples_; ++n) {
      const double turns = (shift - beside_bin_) * n / samples_;
      const auto i = static_cast<std::size_t>(n);
      values[i] = std::complex<double>(beat[n]) *
                  std::polar(weights_[i], 2.0 * core::kPi * (turns - std::floor(turns)));
    }
    fft_.run(values.data());
    for (int cell = 0; cell < gate_.cells; ++cell)
      cells_W[static_cast<std::size_t>(cell) * static_cast<std::size_t>(columns)] =
          std::norm(values[static_cast<std::size_t>(first_bin_ + cell)]);
  }

 private:
  sensors::RangeGate gate_;
  int samples_;
  std::vector<double> weights_;
  Fft<double> fft_;
  int first_bin_ = 0;  // the nearest cell's
  double beside_bin_ = 0.0;
};

}  // namespace

FloatCube scan_beat(const sensors::Sensor& sensor, std::span<const core::Echo> echoes,
                    std::span<const double> phase_rad) {
  if (echoes.size() != phase_rad.size()) throw core::InternalError("a phase for every echo");
  std::vector<sensors::ColumnPlace> places;
  places.reserve(echoes.size());
  for (const core::Echo& echo : echoes)
    places.push_back(sensors::column_place(sensor, echo.azimuth_rad, echo.elevation_rad));
  FloatCube beat(shape_of(sensor));
  core::parallel_for(static_cast<std::size_t>(sensor.scan.columns), [&](std::size_t i) {
    const int column = static_cast<int>(i);
    std::vector<ScatterPath> paths;
    for (std::size_t k = 0; k < echoes.size(); ++k) {
      if (!places[k].is_seen_by(column)) continue;
      const core::Echo& echo = echoes[k];
      const double power_W = echo.power_W * sensors::column_gain(sensor, places[k], column);
      if (power_W > 0.0)
        paths.push_back({echo.range_m, echo.radial_speed_mps, echo.azimuth_rad, echo.elevation_rad,
                         std::polar(std::sqrt(power_W), phase_rad[k])});
    }
    if (paths.empty()) return;
    const FloatCube ramp = synthesise_beat(column_sweep(sensor, column), 0, Array{}, paths);
    std::copy(ramp.values.begin(), ramp.values.end(), &beat.at(0, column, 0));
  });
  return beat;
}

std::vector<double> scan_cells_W(const sensors::Sensor& sensor, const FloatCube& beat,
                                 double closing_speed_mps) {
  if (beat.shape != shape_of(sensor) || beat.values.size() != beat.shape.count())
    throw core::InternalError("a beat of another scan");
  const CellReader reader(sensor, beat.shape.samples);
  const int columns = sensor.scan.columns;
  std::vector<double> cells_W(static_cast<std::size_t>(sensor.range.cells) *
                              static_cast<std::size_t>(columns));
  core::parallel_for(static_cast<std::size_t>(columns), [&](std::size_t i) {
    const int column = static_cast<int>(i);
    const Waveform sweep = column_sweep(sensor, column);
    const double shift_Hz =
        2.0 * closing_speed_mps * sweep.centre_frequency_Hz / core::kSpeedOfLight_mps;
    reader.read(&beat.at(0, column, 0), shift_Hz * sweep.segments[0].duration_s, columns,
                &cells_W[i]);
  });
  return cells_W;
}

}  // namespace fanbeam::signal
