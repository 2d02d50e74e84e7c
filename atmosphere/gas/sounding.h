// Air known at several heights: a radiosonde's or a forecast's levels instead of the reference
// atmosphere.
//
// Between levels, over the geopotential height h' of P.835-6 (standard_atmosphere.h): temperature
// and relative humidity are linear in h'. Pressure is hydrostatic in that temperature,
// d ln P = -34.1632 dh' / T (K/km), closed form per layer; where levels give pressures, their
// difference from the hydrostatic column is interpolated linearly in ln P, so they are met exactly.
// Without any pressure, that of the reference atmosphere holds at the origin.
// Below the lowest and above the highest level the temperature falls by 6.5 K/km (up to h' = 11 km)
// and the vapour density by the scale height 2 km, at most saturated.
// Accuracy: levels taken every 250 m from the reference atmosphere give its gas loss back within
// 2e-4. Humidity is relative to water, also below 0 C.
#pragma once

#include <optional>
#include <vector>

#include "atmosphere/gas/standard_atmosphere.h"

namespace fanbeam::atmosphere {

struct AirLevel {
  double height_m = 0.0;               // above the scene's origin, -2000 to 12000
  double temperature_C = 15.0;         // -90 to 50
  double humidity = 0.0;               // relative to saturation over water, 0 to 1
  std::optional<double> pressure_hPa;  // 100 to 1100, total
};

class Sounding {
 public:
  // At least one level, heights rising strictly; values in range (weather.h checks them).
  // `origin_height_m` above mean sea level; `origin_pressure_hPa` holds there, and then no level
  // has a pressure.
  Sounding(const std::vector<AirLevel>& levels, double origin_height_m,
           std::optional<double> origin_pressure_hPa);

  // Height above mean sea level, -3000 to 20000.
  AirState at(double height_m) const;

 private:
  struct Level {
    double h_km;  // geopotential
    double temperature_K;
    double humidity;
    double ln_column;  // ln of the hydrostatic pressure over that at the lowest level
  };
  struct Anchor {
    double h_km;
    double ln_excess;  // what is to be added to ln_column
  };

  double temperature_K(double h_km) const;
  double ln_column(double h_km) const;
  double ln_pressure(double h_km) const;
  double vapour_beyond_g_per_m3(const Level& end, double h_km) const;

  std::vector<Level> levels_;
  std::vector<Anchor> anchors_;
};

}  // namespace fanbeam::atmosphere
