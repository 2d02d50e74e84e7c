#include "materials/nrcs/nrcs_curve.h"

#include <cmath>

#include "core/number_range.h"

namespace fanbeam::materials {

NrcsCurve::NrcsCurve(const PhongNrcs& nrcs) { std::get<PhongSurface>(model_).nrcs = nrcs; }

NrcsCurve::NrcsCurve(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz)
    : model_(model), polarisation_(polarisation), frequency_Hz_(frequency_Hz) {
  core::require_range("frequency_Hz", frequency_Hz, kNrcsFrequencies_Hz);
  // Scaled once here, so that the form is evaluated in the sine as it stands.
  if (PhongSurface* phong = std::get_if<PhongSurface>(&model_)) {
    phong->nrcs = phong->at_frequency(frequency_Hz);
    phong->frequency_exponent = 0.0;
  }
}

double NrcsCurve::sigma0(double sin_grazing) const {
  if (const PhongSurface* phong = std::get_if<PhongSurface>(&model_))
    return phong->nrcs.sigma0(sin_grazing);
  if (!(sin_grazing > 0.0)) return 0.0;
  return continued_sigma0(model_, polarisation_, frequency_Hz_,
                          std::asin(std::fmin(sin_grazing, 1.0)));
}

}  // namespace fanbeam::materials
