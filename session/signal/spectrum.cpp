#include "session/signal/spectrum.h"

#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <numeric>

#include "signal/fourier/fft.h"
#include "signal/fourier/window.h"
#include "signal/transform/range_doppler.h"

namespace fanbeam::session {

double dBm(double power_W) { return 10.0 * std::log10(power_W) + 30.0; }

BeatSpectrum beat_spectrum(const FmcwRadar& radar, const signal::FloatCube& beat) {
  const signal::RangeDopplerSettings& transform = radar.detection.transform;
  const int samples = beat.shape.samples, chirps = beat.shape.chirps;
  const auto weights = signal::window_weights(transform.range_window, samples);
  const auto doppler_weights = signal::window_weights(transform.doppler_window, chirps);
  const double scale =
      std::sqrt(radar.power_scale) / std::accumulate(weights.begin(), weights.end(), 0.0);
  const signal::Fft<double> fft({samples, 1, 1, samples}, signal::FftDirection::forward);
  BeatSpectrum result;
  result.range_step_m = radar.axes.range_step_m;
  // That of a cell of the cube, which the Doppler transform has lowered.
  result.noise_W = radar.noise_cell_W / signal::noise_gain(doppler_weights);
  result.mean_W.assign(static_cast<std::size_t>(transform.kept_range_cells), 0.0);
  std::vector<std::complex<double>> values(static_cast<std::size_t>(samples));
  for (int chirp = 0; chirp < chirps; ++chirp) {
    for (int n = 0; n < samples; ++n)
      values[static_cast<std::size_t>(n)] = std::complex<double>(beat.at(0, chirp, n)) *
                                            (weights[static_cast<std::size_t>(n)] * scale);
    fft.run(values.data());
    for (std::size_t cell = 0; cell < result.mean_W.size(); ++cell)
      result.mean_W[cell] += std::norm(values[cell]) / chirps;
    if (chirp > 0) continue;
    for (std::size_t cell = 0; cell < result.mean_W.size(); ++cell)
      result.one_chirp_W.push_back(std::norm(values[cell]));
  }
  return result;
}

std::string spectrum_csv(const BeatSpectrum& spectrum) {
  std::string text = "range_m,one_chirp_W,mean_W,noise_W\n";
  for (std::size_t cell = 0; cell < spectrum.mean_W.size(); ++cell)
    text += fmt::format("{:.4f},{:.5e},{:.5e},{:.5e}\n",
                        static_cast<double>(cell) * spectrum.range_step_m,
                        spectrum.one_chirp_W[cell], spectrum.mean_W[cell], spectrum.noise_W);
  return text;
}

Plot spectrum_plot(const BeatSpectrum& spectrum, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x = {"range, m", false, 0.0, {}};
  plot.y = {"received power, dBm", false, {}, {}};
  PlotSeries one{"one chirp", {}, {}, PlotSeries::Style::line, 5};
  PlotSeries mean{"mean over the chirps", {}, {}, PlotSeries::Style::line, 0};
  for (std::size_t cell = 0; cell < spectrum.mean_W.size(); ++cell) {
    for (PlotSeries* series : {&one, &mean})
      series->x.push_back(static_cast<double>(cell) * spectrum.range_step_m);
    one.y.push_back(dBm(spectrum.one_chirp_W[cell]));
    mean.y.push_back(dBm(spectrum.mean_W[cell]));
  }
  const double last_m = one.x.empty() ? 0.0 : one.x.back();
  PlotSeries noise{"mean noise of a cell",
                   {0.0, last_m},
                   {dBm(spectrum.noise_W), dBm(spectrum.noise_W)},
                   PlotSeries::Style::dashed_line,
                   1};
  plot.x.high = last_m;
  plot.y.low = 10.0 * std::floor((dBm(spectrum.noise_W) - 15.0) / 10.0);
  plot.series = {one, mean, noise};
  plot.key_below = true;
  return plot;
}

}  // namespace fanbeam::session
