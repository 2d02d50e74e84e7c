#include "materials/library/material.h"

#include <cmath>

#include "materials/checks.h"

namespace fanbeam::materials {

const char* name_of(Confidence confidence) {
  switch (confidence) {
    case Confidence::seen:
      return "seen";
    case Confidence::fitted:
      return "fitted";
    case Confidence::recalled:
      return "recalled";
    case Confidence::assumed:
      return "assumed";
  }
  throw core::InternalError("confidence out of its enumeration");
}

PhongNrcs Material::nrcs_at(double frequency_Hz) const {
  require_range("frequency_Hz", frequency_Hz, 1e9, 300e9);
  const double factor = std::pow(frequency_Hz / reference_frequency_Hz, frequency_exponent);
  return {nrcs.a() * factor, nrcs.b() * factor, nrcs.c()};
}

}  // namespace fanbeam::materials
