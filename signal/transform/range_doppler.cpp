#include "signal/transform/range_doppler.h"

#include <algorithm>
#include <complex>
#include <numeric>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"
#include "signal/transform/tiles_private.h"

namespace fanbeam::signal {
namespace {

int transform_length(const char* field, int asked, int input) {
  if (asked == 0) return input;
  if (asked < input) refuse(field, asked, "0 or at least the length of the input");
  return asked;
}

double sum(const std::vector<double>& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

// Fast time to range, a chirp at a time.
template <typename Real>
class RowTransform {
 public:
  RowTransform(const std::vector<double>& weights, int length, int kept)
      : weights_(doubled_weights<Real>(weights, 1.0 / sum(weights))),
        length_(static_cast<std::size_t>(length)),
        kept_(static_cast<std::size_t>(kept)),
        fft_({.length = length}, FftDirection::forward) {}

  void run(const std::complex<Real>* in, std::complex<Real>* out, std::size_t rows) const {
    std::vector<std::complex<Real>> row(length_);
    std::vector<std::complex<Real>> all(kept_ < length_ ? length_ : 0);
    const std::size_t samples = weights_.size() / 2;
    for (std::size_t r = 0; r < rows; ++r, in += samples, out += kept_) {
      weigh(reinterpret_cast<const Real*>(in), weights_.data(), reinterpret_cast<Real*>(row.data()),
            weights_.size());
      if (all.empty()) {
        fft_.run(row.data(), out);
        continue;
      }
      fft_.run(row.data(), all.data());
      std::copy_n(all.begin(), kept_, out);
    }
  }

 private:
  std::vector<Real> weights_;
  std::size_t length_;
  std::size_t kept_;
  Fft<Real> fft_;
};

}  // namespace

CubeShape range_doppler_shape(const CubeShape& beat, const RangeDopplerSettings& settings) {
  if (std::min({beat.samples, beat.chirps, beat.channels}) < 1)
    refuse("cube.shape", std::min({beat.samples, beat.chirps, beat.channels}),
           "one or more along every axis");
  const int range_length = transform_length("range_length", settings.range_length, beat.samples);
  const int doppler_length =
      transform_length("doppler_length", settings.doppler_length, beat.chirps);
  const int kept = settings.kept_range_cells == 0 ? range_length : settings.kept_range_cells;
  if (kept < 1 || kept > range_length)
    refuse("kept_range_cells", kept, "0 or up to the length of the range transform");
  return {kept, doppler_length, beat.channels};
}

template <typename Real>
void range_doppler(const Cube<Real>& beat, const RangeDopplerSettings& settings,
                   Cube<Real>& result) {
  const CubeShape& shape = beat.shape;
  const CubeShape transformed = range_doppler_shape(shape, settings);
  if (beat.values.size() != shape.count())
    refuse("cube.values", static_cast<double>(beat.values.size()), "as many as the shape says");
  const int range_length = settings.range_length == 0 ? shape.samples : settings.range_length;
  const int kept = transformed.samples;
  const int doppler_length = transformed.chirps;

  const std::vector<double> fast = window_weights(settings.range_window, shape.samples);
  std::vector<double> slow = window_weights(settings.doppler_window, shape.chirps);
  const double slow_sum = sum(slow);
  for (double& weight : slow) weight /= slow_sum;
  const RowTransform<Real> rows(fast, range_length, kept);
  const ColumnTransform<Real> columns(slow, doppler_length, doppler_length / 2,
                                      FftDirection::forward);

  result.shape = transformed;
  result.values.resize(result.shape.count());
  const auto chirps = static_cast<std::size_t>(shape.chirps);
  const auto width = static_cast<std::size_t>(kept);
  core::parallel_for(static_cast<std::size_t>(shape.channels), [&](std::size_t channel) {
    const std::complex<Real>* in =
        beat.values.data() + channel * chirps * static_cast<std::size_t>(shape.samples);
    std::complex<Real>* out =
        result.values.data() + channel * static_cast<std::size_t>(doppler_length) * width;
    rows.run(in, out, chirps);
    columns.run(out, out, width, 0, width);
  });
}

template void range_doppler(const FloatCube&, const RangeDopplerSettings&, FloatCube&);
template void range_doppler(const DoubleCube&, const RangeDopplerSettings&, DoubleCube&);

double noise_gain(const std::vector<double>& weights) {
  const double squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  return squares / (sum(weights) * sum(weights));
}

RangeDopplerAxes range_doppler_axes(double sample_rate_Hz, double slope_Hz_per_s,
                                    double repetition_s, double wavelength_m, int range_length,
                                    int doppler_length) {
  check_positive("sample_rate_Hz", sample_rate_Hz);
  check_positive("slope_Hz_per_s", slope_Hz_per_s);
  check_positive("repetition_s", repetition_s);
  check_positive("wavelength_m", wavelength_m);
  check_positive("range_length", range_length);
  check_positive("doppler_length", doppler_length);
  RangeDopplerAxes axes;
  const double metres_per_Hz = core::kSpeedOfLight_mps / (2.0 * slope_Hz_per_s);
  axes.range_step_m = metres_per_Hz * sample_rate_Hz / range_length;
  axes.doppler_step_Hz = 1.0 / (doppler_length * repetition_s);
  axes.wavelength_m = wavelength_m;
  axes.range_per_Doppler_m_s = metres_per_Hz;
  axes.doppler_cells = doppler_length;
  return axes;
}

}  // namespace fanbeam::signal
