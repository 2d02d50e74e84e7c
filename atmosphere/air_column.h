// The air over a scene's origin: the reference atmosphere with the weather's surface values, or the
// weather's own levels.
#pragma once

#include <optional>
#include <variant>

#include "atmosphere/gas/sounding.h"
#include "atmosphere/gas/standard_atmosphere.h"

namespace fanbeam::atmosphere {

struct Weather;

class AirColumn {
 public:
  // Throws InputError for surface values out of range; levels must be valid (problems_in).
  explicit AirColumn(const Weather& weather);

  // Height above the origin.
  AirState at(double height_m) const;
  double temperature_C(double height_m) const { return at(height_m).temperature_K - 273.15; }

  // Height above the origin at which the temperature falls through 0 C for the last time on the way
  // up, between the limits of PathAttenuation, to 0.1 m; nothing when there is no such height.
  std::optional<double> zero_celsius_m() const;

 private:
  double origin_height_m_ = 0.0;
  std::variant<StandardAtmosphere, Sounding> air_;
};

}  // namespace fanbeam::atmosphere
