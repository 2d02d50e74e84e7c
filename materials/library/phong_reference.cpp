#include "materials/library/phong_reference.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "core/decibel.h"
#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

std::vector<double> every_five_deg(std::vector<double> angles, double low_deg, double high_deg) {
  for (double angle_deg = low_deg; angle_deg <= high_deg; angle_deg += 5.0)
    angles.push_back(angle_deg);
  return angles;
}

std::string digits(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return core::number_text(std::strtod(text, nullptr));
}

}  // namespace

const std::vector<double>& fit_angles_deg(FitAngles angles) {
  static const std::array<std::vector<double>, 3> kAngles_deg = {
      standard_fit_angles_deg(), every_five_deg({}, 20.0, 80.0),
      every_five_deg(standard_fit_angles_deg(), 65.0, 90.0)};
  return kAngles_deg[static_cast<std::size_t>(angles)];
}

PhongDerivation derive(const PhongSurface& row, const PhongReference& reference) {
  const Polarisation polarisation = row.polarisation.value_or(Polarisation::horizontal);
  const double factor = core::power_from_dB(reference.offset_dB);
  const auto model_at = [&](double frequency_Hz) {
    return [&reference, polarisation, factor, frequency_Hz](double grazing_rad) {
      return factor * sigma0(reference.model, polarisation, frequency_Hz, grazing_rad);
    };
  };
  const auto at_reference = model_at(row.reference_frequency_Hz);
  const std::vector<double>& angles_deg = fit_angles_deg(reference.angles);
  PhongDerivation result{fit_phong(sample_model(at_reference, angles_deg)), row.frequency_exponent};
  if (reference.exponent_to_Hz > 0.0) {
    const auto elsewhere = model_at(reference.exponent_to_Hz);
    double sum = 0.0;
    for (const double angle_deg : angles_deg) {
      const double grazing_rad = core::radians(angle_deg);
      sum += std::log(elsewhere(grazing_rad) / at_reference(grazing_rad));
    }
    result.frequency_exponent = sum / static_cast<double>(angles_deg.size()) /
                                std::log(reference.exponent_to_Hz / row.reference_frequency_Hz);
  }
  return result;
}

std::string five_digits(double value) { return digits("%.5g", value); }
std::string four_digits(double value) { return digits("%.4g", value); }

}  // namespace fanbeam::materials
