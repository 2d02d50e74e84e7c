// Loss and volume echo over range for one weather and several frequencies: the figures behind
// `fanbeam atmosphere`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/weather.h"

namespace fanbeam::atmosphere {

// From an antenna at one height to points of another: the ground as a radar looks down on it.
struct AtmospherePath {
  double from_height_m = 100.0;
  double to_height_m = 0.0;
  double range_m = 4000.0;  // the farthest
  double step_m = 500.0;
  double beam_height_rad = 0.0;  // two-way width of the elevation beam
};

struct AtmosphereRow {
  double range_m = 0.0;
  // One way, of the whole path, by cause. Oxygen includes the dry continuum of nitrogen.
  double oxygen_dB = 0.0, vapour_dB = 0.0, fog_dB = 0.0, rain_dB = 0.0, snow_dB = 0.0;
  double eta_m2_per_m3 = 0.0;  // where the path ends
  // The NRCS that flat ground would need to return what a beam full of this eta returns in the same
  // range cell: eta R beam height (small grazing angles). Both lose the same on the way.
  double equivalent_sigma0_dB = 0.0;

  double gas_dB() const { return oxygen_dB + vapour_dB; }
  double one_way_dB() const { return gas_dB() + fog_dB + rain_dB + snow_dB; }
  double two_way_dB() const { return 2.0 * one_way_dB(); }
};

struct AtmosphereTable {
  double frequency_Hz = 0.0;
  std::optional<RainCoefficients> rain{};  // in rain of the law itu-p838
  std::vector<AtmosphereRow> rows;
};

// What a model is called, where it comes from, and what it gives.
struct AtmosphereModel {
  std::string cause, model, source;
};

// Throws InputError with every problem of the weather at this frequency.
AtmosphereTable atmosphere_table(const Weather& weather, double frequency_Hz,
                                 const AtmospherePath& path);

// The models that this weather uses; causes that are not there are left out.
std::vector<AtmosphereModel> atmosphere_models(const Weather& weather);

}  // namespace fanbeam::atmosphere
