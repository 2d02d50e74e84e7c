// What a material description is asked for, and the answer of a table that may not know it.
#pragma once

#include <optional>
#include <string>

#include "core/polarisation.h"

namespace fanbeam::materials {

struct RadarQuery {
  double frequency_Hz = 35e9;
  core::Polarisation polarisation = core::Polarisation::horizontal;
  double temperature_K = 288.15;     // of the surface
  bool allow_extrapolation = false;  // models may be used outside what they know
};

template <class Value>
struct Lookup {
  std::optional<Value> value;
  std::string why_not;  // for people, when there is no value
};

// Tables are used up to this far from their own wavelengths.
inline constexpr double kWavelengthTolerance = 0.1;

}  // namespace fanbeam::materials
