#include <CLI/CLI.hpp>

#include "apps/atmosphere_command.h"
#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

using Options = std::vector<CLI::Option*>;

// Fog, rain and snow: how much of them and up to where. A comparison has its own.
Options add_amounts(CLI::App& command, WeatherOptions& weather) {
  CLI::Option* visibility = command.add_option("--fog-visibility", weather.visibility_m,
                                               "Visibility in fog, m, 10 to 100000");
  CLI::Option* water =
      command
          .add_option("--fog-water", weather.liquid_water_g_per_m3, "Water in fog, g/m3, 0 to 20")
          ->excludes(visibility);
  CLI::Option* fog_top = command.add_option("--fog-top", weather.fog_top_m,
                                            "Top of the fog above the origin, m, -2000 to 12000");
  CLI::Option* rain =
      command.add_option("--rain", weather.rain_mm_per_h, "Rain rate, mm/h, 0 to 300");
  CLI::Option* rain_top = command.add_option("--rain-top", weather.rain_top_m,
                                             "Top of the rain above the origin, m, -2000 to 12000");
  CLI::Option* melting = command
                             .add_flag("--melting-layer", weather.melting_layer,
                                       "Rain ends below the 0 C level of the air, in wet snow")
                             ->excludes(rain_top);
  CLI::Option* melting_height =
      command
          .add_option(
              "--melting-height", weather.melting_height_m,
              "A melting layer with its 0 C level there, m above the origin, -2000 to 11640")
          ->excludes(rain_top);
  CLI::Option* snow = command.add_option("--snow", weather.snow_mm_per_h,
                                         "Dry snow, mm/h of water, 0 to 50; up to 40 GHz");
  CLI::Option* snow_top = command.add_option("--snow-top", weather.snow_top_m,
                                             "Top of the snow above the origin, m, -2000 to 12000");
  return {visibility, water, fog_top, rain, rain_top, melting, melting_height, snow, snow_top};
}

void add_laws(CLI::App& command, WeatherOptions& weather) {
  command.add_option("--fog-type", weather.fog_type, "Water from visibility")
      ->check(CLI::IsMember({"kunkel", "eldridge-altshuler", "zhao-radiation", "zhao-advection",
                             "tomasi-dry-cold", "tomasi-wet-warm"}));
  command.add_option("--fog-law", weather.fog_law, "Loss from water")
      ->check(CLI::IsMember({"itu-p840", "altshuler", "centimetre"}));
  command.add_option("--rain-law", weather.rain_law, "Loss from rain rate")
      ->check(CLI::IsMember({"itu-p838", "georgia-tech-95", "mie"}));
  command.add_option("--rain-echo-law", weather.rain_echo_law, "Echo from rain rate")
      ->check(CLI::IsMember({"mie", "mie-fit", "georgia-tech-1975"}));
  command.add_option("--drop-sizes", weather.drop_sizes, "Of the laws mie")
      ->check(CLI::IsMember({"marshall-palmer", "joss-drizzle", "joss-thunderstorm"}));
  CLI::Option* polarisation =
      command
          .add_option("--polarisation", weather.polarisation,
                      "For the rain law itu-p838 (default: the scene's, else HH)")
          ->check(CLI::IsMember({"HH", "VV"}));
  command
      .add_option("--tilt", weather.tilt_deg,
                  "The same in between: tilt from horizontal, degrees, -180 to 180; 45 stands for "
                  "circular too")
      ->check(number_from(-180.0, 180.0))
      ->excludes(polarisation);
  command
      .add_option("--path-elevation", weather.path_elevation_deg,
                  "For the rain law itu-p838: elevation of the path, degrees, -90 to 90 (default "
                  "0, as scenes are rendered; heights and range do not change it)")
      ->check(number_from(-90.0, 90.0));
}

void add_air(CLI::App& command, WeatherOptions& weather) {
  command.add_option("--temperature", weather.temperature_C, "At the origin, C, -60 to 50");
  CLI::Option* humidity =
      command.add_option("--humidity", weather.humidity, "Relative, at the origin, 0 to 1");
  CLI::Option* pressure =
      command.add_option("--pressure", weather.pressure_hPa,
                         "Of air and vapour together, at the origin, hPa, 300 to 1100");
  command
      .add_option("--vapour-density", weather.vapour_density_g_per_m3,
                  "Water vapour at the origin, g/m3, 0 to saturation; in fog air is saturated")
      ->check(number_from(0.0, 300.0))
      ->excludes(humidity);
  command
      .add_option(
          "--dry-pressure", weather.dry_pressure_hPa,
          "Of the air without its vapour, as P.676 takes it, at the origin, hPa; 300 to 1100 with "
          "it")
      ->excludes(pressure);
}

Options add_path(CLI::App& command, AtmosphereOptions& options) {
  const auto add = [&](const char* name, double& value, const char* what, double least,
                       double most) {
    return command.add_option(name, value, what)
        ->check(number_from(least, most))
        ->capture_default_str();
  };
  return {
      add("--height", options.height_m, "Of the antenna above the origin, m", -2000, 12000),
      add("--to-height", options.to_height_m, "Where paths end above the origin, m", -2000, 12000),
      add("--range", options.range_m, "Farthest range, m", 1, 1e6),
      add("--step", options.step_m, "Step of range, m", 1, 1e6)};
}

}  // namespace

CLI::App& add_atmosphere_command(CLI::App& program, AtmosphereOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "atmosphere", "Loss in air, fog, rain and snow over range, and the echo of what falls");
  CLI::Option* scene =
      command.add_option("SCENE", options.scene, "A scene whose weather and sensor are used")
          ->type_name(kSceneValue);
  command
      .add_option("--data", options.data,
                  "Folder with terrain and flight data, looked at before the one that FANBEAM_DATA "
                  "names")
      ->type_name(kFolderValue)
      ->needs(scene);
  CLI::Option* frequency = command
                               .add_option("--frequency", options.frequency_GHz,
                                           "GHz, one or more: 35,94 (default: the sensor's)")
                               ->delimiter(',')
                               ->check(number_from(1.0, 1000.0));
  CLI::Option* compare =
      command
          .add_option("--compare", options.compare_GHz,
                      "Two frequencies in GHz: a table of their losses and echoes in several fogs "
                      "and rains, and plots of them with -o")
          ->delimiter(',')
          ->expected(2)
          ->check(number_from(1.0, 1000.0));
  CLI::Option* csv = command.add_flag("--csv", options.csv, "Print CSV");
  CLI::Option* json = command.add_flag("--json", options.json, "Print JSON")->excludes(csv);
  Options without_effect = {frequency, csv, json};
  for (const Options& more : {add_amounts(command, options.weather), add_path(command, options)})
    without_effect.insert(without_effect.end(), more.begin(), more.end());
  for (CLI::Option* option : without_effect) compare->excludes(option);
  add_laws(command, options.weather);
  add_air(command, options.weather);
  command
      .add_option("-o,--output", options.output,
                  "Folder for plots, and for CSV and JSON unless --compare (default: none written)")
      ->type_name(kFolderValue);
  return command;
}

}  // namespace fanbeam::apps
