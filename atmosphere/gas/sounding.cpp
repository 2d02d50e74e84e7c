#include "atmosphere/gas/sounding.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/gas/geopotential.h"

namespace fanbeam::atmosphere {
namespace {

// Integral of dh' / T over a layer whose temperature goes linearly from one value to another.
double layer_km_per_K(double thickness_km, double from_K, double to_K) {
  const double change = (to_K - from_K) / from_K;
  return thickness_km / from_K * (change == 0.0 ? 1.0 : std::log1p(change) / change);
}

// The height that counts for the temperature beyond the levels.
double lapse_km(double h_km, double end_km) {
  return std::min(h_km, std::max(kTropopause_km, end_km)) - end_km;
}

double mix(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

Sounding::Sounding(const std::vector<AirLevel>& levels, double origin_height_m,
                   std::optional<double> origin_pressure_hPa) {
  for (const AirLevel& level : levels) {
    Level next{geopotential_km(origin_height_m + level.height_m),
               level.temperature_C + kZeroCelsius_K, level.humidity, 0.0};
    if (!levels_.empty()) {
      const Level& last = levels_.back();
      next.ln_column = last.ln_column - kHydrostatic_K_per_km *
                                            layer_km_per_K(next.h_km - last.h_km,
                                                           last.temperature_K, next.temperature_K);
    }
    levels_.push_back(next);
    if (level.pressure_hPa)
      anchors_.push_back({next.h_km, std::log(*level.pressure_hPa) - next.ln_column});
  }
  if (!anchors_.empty()) return;
  const double h_km = geopotential_km(origin_height_m);
  const double pressure_hPa =
      origin_pressure_hPa.value_or(StandardAtmosphere().at(origin_height_m).pressure_hPa);
  anchors_.push_back({h_km, std::log(pressure_hPa) - ln_column(h_km)});
}

double Sounding::temperature_K(double h_km) const {
  if (h_km <= levels_.front().h_km)
    return levels_.front().temperature_K - kLapse_K_per_km * lapse_km(h_km, levels_.front().h_km);
  if (h_km >= levels_.back().h_km)
    return levels_.back().temperature_K - kLapse_K_per_km * lapse_km(h_km, levels_.back().h_km);
  const auto above = std::upper_bound(levels_.begin(), levels_.end(), h_km,
                                      [](double h, const Level& level) { return h < level.h_km; });
  const Level& low = *(above - 1);
  return mix(low.temperature_K, above->temperature_K, (h_km - low.h_km) / (above->h_km - low.h_km));
}

double Sounding::ln_column(double h_km) const {
  const auto above = std::upper_bound(levels_.begin(), levels_.end(), h_km,
                                      [](double h, const Level& level) { return h < level.h_km; });
  const Level& start = above == levels_.begin() ? *above : *(above - 1);
  // Beyond the levels the lapse ends at the tropopause, isothermal from there on.
  const double bend_km =
      above == levels_.end() ? std::min(h_km, std::max(kTropopause_km, start.h_km)) : h_km;
  const double bend_K = temperature_K(bend_km);
  return start.ln_column - kHydrostatic_K_per_km *
                               (layer_km_per_K(bend_km - start.h_km, start.temperature_K, bend_K) +
                                (h_km - bend_km) / bend_K);
}

double Sounding::ln_pressure(double h_km) const {
  const auto above = std::upper_bound(anchors_.begin(), anchors_.end(), h_km,
                                      [](double h, const Anchor& a) { return h < a.h_km; });
  double excess = 0.0;
  if (above == anchors_.begin()) {
    excess = above->ln_excess;
  } else if (above == anchors_.end()) {
    excess = anchors_.back().ln_excess;
  } else {
    const Anchor& low = *(above - 1);
    excess = mix(low.ln_excess, above->ln_excess, (h_km - low.h_km) / (above->h_km - low.h_km));
  }
  return ln_column(h_km) + excess;
}

double Sounding::vapour_beyond_g_per_m3(const Level& end, double h_km) const {
  const double at_end = end.humidity * saturation_vapour_density_g_per_m3(
                                           end.temperature_K, std::exp(ln_pressure(end.h_km)));
  return at_end * std::exp(-1e3 * (h_km - end.h_km) / kVapourScaleHeight_m);
}

AirState Sounding::at(double height_m) const {
  const double h_km = geopotential_km(height_m);
  AirState air;
  air.temperature_K = temperature_K(h_km);
  air.pressure_hPa = std::exp(ln_pressure(h_km));
  const double saturated = saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa);
  if (h_km < levels_.front().h_km) {
    air.vapour_density_g_per_m3 =
        std::min(saturated, vapour_beyond_g_per_m3(levels_.front(), h_km));
  } else if (h_km >= levels_.back().h_km) {
    air.vapour_density_g_per_m3 = std::min(saturated, vapour_beyond_g_per_m3(levels_.back(), h_km));
  } else {
    const auto above =
        std::upper_bound(levels_.begin(), levels_.end(), h_km,
                         [](double h, const Level& level) { return h < level.h_km; });
    const Level& low = *(above - 1);
    air.vapour_density_g_per_m3 = saturated * mix(low.humidity, above->humidity,
                                                  (h_km - low.h_km) / (above->h_km - low.h_km));
  }
  return air;
}

}  // namespace fanbeam::atmosphere
