#include "atmosphere/loss_table.h"

#include <fmt/core.h>

#include <cmath>

#include "atmosphere/volume_echo.h"
#include "core/units.h"

namespace fanbeam::atmosphere {
namespace {

// The loss of one cause alone: the air stays what it is.
PathAttenuation alone(Weather weather, bool Weather::*cause, double frequency_Hz,
                      GasPart gas_part = GasPart::whole) {
  weather.simulate_gas = weather.simulate_fog = weather.simulate_rain = weather.simulate_snow =
      false;
  weather.*cause = true;
  weather.gas_part = gas_part;
  return {weather, frequency_Hz};
}

std::string rain_source(RainLaw law) {
  switch (law) {
    case RainLaw::itu_p838:
      return "Recommendation ITU-R P.838-3";
    case RainLaw::georgia_tech_95:
      return "Georgia Tech 1975, the 95 GHz member (recalled)";
    case RainLaw::mie:
      return "Mie scattering of water spheres (Bohren and Huffman 1983)";
  }
  return "";
}

std::string echo_source(RainEchoLaw law) {
  switch (law) {
    case RainEchoLaw::mie:
      return "Mie scattering of water spheres (Bohren and Huffman 1983)";
    case RainEchoLaw::mie_fit:
      return "fit to Mie scattering, Marshall-Palmer drops at 10 C";
    case RainEchoLaw::georgia_tech_1975:
      return "Georgia Tech 1975, measured (recalled)";
  }
  return "";
}

std::string fog_source(FogLaw law) {
  switch (law) {
    case FogLaw::itu_p840:
      return "Recommendation ITU-R P.840-8";
    case FogLaw::altshuler:
      return "Altshuler 1984, IEEE Trans. AP 32, 757";
    case FogLaw::centimetre:
      return "Rayleigh absorption, 2 to 10 cm";
  }
  return "";
}

}  // namespace

AtmosphereTable atmosphere_table(const Weather& weather, double frequency_Hz,
                                 const AtmospherePath& path) {
  problems_in(weather, frequency_Hz).throw_if_errors();
  const PathAttenuation oxygen =
      alone(weather, &Weather::simulate_gas, frequency_Hz, GasPart::oxygen);
  const PathAttenuation vapour =
      alone(weather, &Weather::simulate_gas, frequency_Hz, GasPart::vapour);
  const PathAttenuation fog = alone(weather, &Weather::simulate_fog, frequency_Hz);
  const PathAttenuation rain = alone(weather, &Weather::simulate_rain, frequency_Hz);
  const PathAttenuation snow = alone(weather, &Weather::simulate_snow, frequency_Hz);
  const VolumeEcho echo(weather, frequency_Hz);
  AtmosphereTable table;
  table.frequency_Hz = frequency_Hz;
  if (has_rain(weather) && weather.rain_law == RainLaw::itu_p838)
    table.rain = rain_coefficients(frequency_Hz, weather.rain_path_elevation_rad,
                                   weather.polarisation_tilt_rad);
  const int steps = static_cast<int>(std::ceil(path.range_m / path.step_m - 1e-9));
  for (int i = 1; i <= steps; ++i) {
    AtmosphereRow row;
    row.range_m = std::min(path.range_m, path.step_m * i);
    // No point of that height is nearer than the difference in height.
    if (row.range_m < std::abs(path.from_height_m - path.to_height_m)) continue;
    const auto loss_dB = [&](const PathAttenuation& cause) {
      return cause.one_way_dB(path.from_height_m, path.to_height_m, row.range_m);
    };
    row.oxygen_dB = loss_dB(oxygen);
    row.vapour_dB = loss_dB(vapour);
    row.fog_dB = loss_dB(fog);
    row.rain_dB = loss_dB(rain);
    row.snow_dB = loss_dB(snow);
    row.eta_m2_per_m3 = echo.layered_eta_m2_per_m3(path.to_height_m);
    row.equivalent_sigma0_dB =
        10.0 * std::log10(row.eta_m2_per_m3 * row.range_m * path.beam_height_rad);
    table.rows.push_back(row);
  }
  return table;
}

std::vector<AtmosphereModel> atmosphere_models(const Weather& weather) {
  std::vector<AtmosphereModel> models = {
      {"gas", weather.levels.empty() ? "itu-p676, standard air" : "itu-p676, air of levels",
       "Recommendation ITU-R P.676-13 Annex 1, air of P.835-6"}};
  for (const FogLayer& layer : fog_in(weather)) {
    std::string name(name_of(layer.law));
    if (layer.visibility_m)
      name += ", water from visibility " + std::string(name_of(layer.water_model));
    models.push_back({"fog", name, fog_source(layer.law)});
  }
  if (has_rain(weather)) {
    const std::string drops = ", drops " + std::string(name_of(weather.drop_sizes));
    const auto with_drops = [&](std::string_view name, bool mie) {
      return std::string(name) + (mie ? drops : "");
    };
    std::string law = with_drops(name_of(weather.rain_law), weather.rain_law == RainLaw::mie);
    if (weather.rain_law == RainLaw::itu_p838)
      law += fmt::format(", tilt {:.6g} deg, elevation {:.6g} deg",
                         core::degrees(weather.polarisation_tilt_rad),
                         core::degrees(weather.rain_path_elevation_rad));
    models.push_back({"rain", law, rain_source(weather.rain_law)});
    models.push_back(
        {"rain echo",
         with_drops(name_of(weather.rain_echo_law), weather.rain_echo_law == RainEchoLaw::mie),
         echo_source(weather.rain_echo_law)});
  }
  if (weather.melting_layer || weather.melting_height_m)
    models.push_back({"melting", "multiple of the rain below", "Recommendation ITU-R P.530-17"});
  if (has_snow(weather)) {
    models.push_back({"snow", "dry snow", "Gunn and East 1954"});
    models.push_back({"snow echo", "Z = 1780 R^2.21, ice", "Sekhon and Srivastava 1970"});
  }
  return models;
}

}  // namespace fanbeam::atmosphere
