// A layer of fog or cloud with water, law and heights of its own.
#pragma once

#include <optional>

#include "atmosphere/fog/fog.h"
#include "atmosphere/fog/fog_water.h"

namespace fanbeam::atmosphere {

// Heights above the scene's origin, -2000 to 12000, base below top. One of the two amounts is set.
struct FogLayer {
  std::optional<double> visibility_m;           // 10 to 100000
  std::optional<double> liquid_water_g_per_m3;  // 0 to 20
  FogWaterModel water_model = FogWaterModel::kunkel;
  FogLaw law = FogLaw::itu_p840;
  double base_m = -2000.0, top_m = 150.0;
};

}  // namespace fanbeam::atmosphere
