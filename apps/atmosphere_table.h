// Loss and volume echo over range for one weather and several frequencies: the figures behind
// `fanbeam atmosphere`.
#pragma once

#include <string>
#include <vector>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/weather.h"

namespace fanbeam::apps {

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
  atmosphere::SpecificAttenuation one_way_dB{};  // of the whole path, by cause
  double eta_m2_per_m3 = 0.0;                    // where the path ends
  // The NRCS that flat ground would need to return what a beam full of this eta returns in the same
  // range cell: eta R beam height (small grazing angles). Both lose the same on the way.
  double equivalent_sigma0_dB = 0.0;

  double total_one_way_dB() const { return one_way_dB.total_dB_per_km(); }
};

struct AtmosphereTable {
  double frequency_Hz = 0.0;
  std::vector<AtmosphereRow> rows;
};

// What a model is called, where it comes from, and what it gives.
struct AtmosphereModel {
  std::string cause, model, source;
};

// Throws InputError with every problem of the weather at this frequency.
AtmosphereTable atmosphere_table(const atmosphere::Weather& weather, double frequency_Hz,
                                 const AtmospherePath& path);

// The models that this weather uses; causes that are not there are left out.
std::vector<AtmosphereModel> atmosphere_models(const atmosphere::Weather& weather);

}  // namespace fanbeam::apps
