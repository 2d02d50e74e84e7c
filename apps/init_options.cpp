#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/init_command.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

constexpr const char* kPlaceValue = "PLACE";

void add_runway_data(CLI::App& command, InitOptions& options) {
  CLI::App& source = *command.add_option_group("Where the runway is, one of");
  source.add_option("--apt-dat", options.apt_dat, "X-Plane's apt.dat")->type_name(kFileValue);
  source
      .add_option("--runways", options.runways,
                  "OurAirports' runways.csv, or a table with a row per runway end")
      ->type_name(kFileValue);
  CLI::Option* threshold = source.add_option("--threshold", options.threshold,
                                             "LAT,LON[,HEIGHT_M] of the end that is landed on: "
                                             "degrees, metres above mean sea level");
  threshold->type_name(kPlaceValue);
  source.require_option(1);
  CLI::Option* far_end =
      command.add_option("--far-end", options.far_end, "LAT,LON[,HEIGHT_M] of the other end")
          ->type_name(kPlaceValue)
          ->needs(threshold);
  threshold->needs(far_end);
  command
      .add_option("--runway-width", options.runway_width_m,
                  "Metres, beside --threshold (default: 45)")
      ->check(number_from(5.0, 200.0))
      ->needs(threshold);
}

}  // namespace

CLI::App& add_init_command(CLI::App& program, InitOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "init", "Write a commented scene of an airport from runway data and an elevation file");
  command.add_option("FOLDER", options.folder, "Where the scene goes: a new folder")
      ->type_name(kFolderValue)
      ->required();
  command.add_option("--airport", options.airport, "ICAO code, such as EDNY")->required();
  command.add_option("--runway", options.runway, "The end to land on, such as 24")->required();
  add_runway_data(command, options);
  command
      .add_option("--dem", options.elevation,
                  "Elevations: GeoTIFF, DTED, SRTM .hgt or ESRI ASCII grid with its .prj")
      ->type_name(kFileValue)
      ->required();
  CLI::Option* track = command.add_option(
      "--track", options.track,
      "A recorded flight, CSV with a header line (default: an instrument approach)");
  track->type_name(kFileValue);
  command.add_option("--buildings", options.buildings, "Building footprints, GeoJSON")
      ->type_name(kFileValue);
  command
      .add_option("--start-distance", options.start_distance_m,
                  "Metres before the threshold where the flight begins")
      ->check(number_from(500.0, 20000.0))
      ->capture_default_str();
  command.add_option("--glide-path", options.glide_path_deg, "Degrees, of an instrument approach")
      ->check(number_from(1.0, 10.0))
      ->capture_default_str()
      ->excludes(track);
  command
      .add_option("--threshold-crossing-height", options.threshold_crossing_height_m,
                  "Metres above the threshold")
      ->check(number_from(5.0, 50.0))
      ->capture_default_str();
  command
      .add_option("--data", options.data,
                  "Data folder: files in it are named by the scene instead of copied into it, and "
                  "rendering needs the same --data or FANBEAM_DATA")
      ->type_name(kFolderValue);
  command.add_flag("--overwrite", options.overwrite, "Replace a scene that is there already");
  command.footer(
      "What the data do not say is guessed from them, and told: columns and units of the flight, "
      "what heights count from, the buildings' height property. Nothing is written on an error. "
      "docs/first-scene.md is a tour.");
  return command;
}

}  // namespace fanbeam::apps
