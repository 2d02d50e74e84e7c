#include "benchmarks/agreement.h"

#include <fmt/core.h>

#include <cmath>

namespace fanbeam::benchmarks {
namespace {

std::size_t cells_apart(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    count += std::abs(a[i] - b[i]) > kClearlyOff_grey ? 1 : 0;
  return count;
}

// Where only one of the two has an echo there is no ratio: such cells show in the errors.
double mean_ratio_dB(const std::vector<double>& power, const std::vector<double>& reference,
                     const std::vector<double>& reference_grey) {
  double sum_dB = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (!(reference_grey[i] > 0.0 && power[i] > 0.0)) continue;
    sum_dB += 10.0 * std::log10(power[i] / reference[i]);
    ++count;
  }
  return count > 0 ? sum_dB / static_cast<double>(count) : 0.0;
}

struct Picture {
  const std::vector<double>& power;  // W or W m^3
  const std::vector<double>& grey_with_noise;
  const std::vector<double>& grey_noise_free;
};

PictureAgreement compare(const Picture& picture, const Picture& reference,
                         const PictureError& error) {
  return {error, mean_ratio_dB(picture.power, reference.power, reference.grey_noise_free),
          cells_apart(picture.grey_with_noise, reference.grey_with_noise),
          cells_apart(picture.grey_noise_free, reference.grey_noise_free), picture.power.size()};
}

}  // namespace

FrameAgreement agreement_of(const sensors::Sensor& sensor, const FramePower& power,
                            const FramePower& reference) {
  const FrameError error = GreyReference(sensor, reference).error_of(power);
  const FrameGrey noisy = grey_of(sensor, power, true);
  const FrameGrey clean = grey_of(sensor, power, false);
  const FrameGrey noisy_reference = grey_of(sensor, reference, true);
  const FrameGrey clean_reference = grey_of(sensor, reference, false);
  return {
      compare({power.bscope_W, noisy.bscope, clean.bscope},
              {reference.bscope_W, noisy_reference.bscope, clean_reference.bscope}, error.bscope),
      compare({power.cscope_W_m3, noisy.cscope, clean.cscope},
              {reference.cscope_W_m3, noisy_reference.cscope, clean_reference.cscope},
              error.cscope)};
}

AgreementFigures measure_agreement(const View& view, const Effort& effort,
                                   const FramePower* reference) {
  fmt::print(stderr, "{} at {:.0f} m: slices against rays\n", view.scene->name, view.distance_m);
  FramePower rays;
  if (reference == nullptr) rays = clock_of(view, effort.reference(1)).power();
  if (reference == nullptr) reference = &rays;
  const auto converged = renderer::profile_sampling_for(effort.converged_slices);
  const FramePower slices = clock_of(view, converged).power();
  return {view.scene->name, view.distance_m,
          fmt::format("{} slices per column", slices_per_column(converged)),
          agreement_of(view.sensor(), slices, *reference),
          explain_off_cells(view, effort, slices, *reference)};
}

}  // namespace fanbeam::benchmarks
