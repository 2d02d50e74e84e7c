// fanbeam init: a scene of an airport from public data, and what was guessed on the way.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/text_table.h"
#include "core/text.h"
#include "scenes/airport/apt_dat_reader.h"
#include "scenes/airport/runway_csv_reader.h"
#include "scenes/airport/runway_ends.h"
#include "session/new_scene.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

struct InitOptions {
  std::string folder, airport, runway;
  // Exactly one of the three says where the runway is; `threshold` needs `far_end`.
  std::string apt_dat, runways, threshold;
  std::string far_end;          // LAT,LON[,HEIGHT_M]
  double runway_width_m = 0.0;  // 0 for an assumed one
  std::string elevation, track, buildings;
  std::string data;  // files in it are named instead of copied
  double start_distance_m = 5000.0, glide_path_deg = 3.0, threshold_crossing_height_m = 15.0;
  bool overwrite = false;
};

constexpr const char* kPlaceValue = "PLACE";

void add_runway_data(CLI::App& command, InitOptions& options) {
  CLI::App& source = *command.add_option_group("Where the runway is, one of");
  add_file(source, "--apt-dat", options.apt_dat, "X-Plane's apt.dat");
  add_file(source, "--runways", options.runways,
           "OurAirports' runways.csv, or a table with a row per runway end");
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
  add_number(command, "--runway-width", options.runway_width_m, {5.0, 200.0},
             "Metres, beside --threshold (default: 45)")
      ->needs(threshold);
}

CLI::App& declare_init(CLI::App& program, InitOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "init", "Write a commented scene of an airport from runway data and an elevation file");
  add_folder(command, "FOLDER", options.folder, "Where the scene goes: a new folder")->required();
  command.add_option("--airport", options.airport, "ICAO code, such as EDNY")->required();
  command.add_option("--runway", options.runway, "The end to land on, such as 24")->required();
  add_runway_data(command, options);
  add_file(command, "--dem", options.elevation,
           "Elevations: GeoTIFF, DTED, SRTM .hgt or ESRI ASCII grid with its .prj")
      ->required();
  CLI::Option* track =
      add_file(command, "--track", options.track,
               "A recorded flight, CSV with a header line (default: an instrument approach)");
  add_file(command, "--buildings", options.buildings, "Building footprints, GeoJSON");
  add_number(command, "--start-distance", options.start_distance_m, {500.0, 20000.0},
             "Metres before the threshold where the flight begins")
      ->capture_default_str();
  add_number(command, "--glide-path", options.glide_path_deg, {1.0, 10.0},
             "Degrees, of an instrument approach")
      ->capture_default_str()
      ->excludes(track);
  add_number(command, "--threshold-crossing-height", options.threshold_crossing_height_m,
             {5.0, 50.0}, "Metres above the threshold")
      ->capture_default_str();
  add_folder(command, "--data", options.data,
             "Data folder: files in it are named by the scene instead of copied into it, and "
             "rendering needs the same --data or FANBEAM_DATA");
  command.add_flag("--overwrite", options.overwrite, "Replace a scene that is there already");
  command.footer(
      "What the data do not say is guessed from them, and told: columns and units of the flight, "
      "what heights count from, the buildings' height property. Nothing is written on an error. "
      "docs/first-scene.md is a tour.");
  return command;
}

std::optional<scenes::Airport> find_airport(const InitOptions& options,
                                            core::ProblemList& problems) {
  if (!options.apt_dat.empty())
    return scenes::read_apt_dat(options.apt_dat, options.airport, problems);
  if (!options.runways.empty())
    return scenes::read_runway_csv(options.runways, options.airport, problems);
  return scenes::airport_from_ends(
      {options.airport, options.runway, options.threshold, options.far_end, options.runway_width_m},
      problems);
}

std::string source_of(const InitOptions& options) {
  const std::string& file = options.apt_dat.empty() ? options.runways : options.apt_dat;
  return file.empty() ? "the command line" : fs::path(file).filename().string();
}

void print_notes(const scenes::Notes& notes) {
  bool any = false;
  for (const scenes::Note& note : notes) {
    fmt::print("{}",
               beside(fmt::format("{} {:<17} ", note.guess ? '?' : ' ', note.label), note.text));
    any = any || note.guess;
  }
  if (any) fmt::print("? guessed or odd: look at it, and change it in scene.toml\n");
}

void print_next_steps(const InitOptions& options, const scenes::Scene& scene) {
  const std::string folder = core::shell_word(options.folder);
  const std::string data = options.data.empty() ? "" : " --data " + core::shell_word(options.data);
  fmt::print("\nvalid: {} frames, {:.1f} s of flight, {} triangles\n", scene.frame_count(),
             scene.trajectory->end_s() - scene.trajectory->begin_s(),
             scene.world.surfaces().triangle_count());
  fmt::print("next:  fanbeam render {}{} --frames 0\n       fanbeam doctor {}{}\n", folder, data,
             folder, data);
}

scenes::NewSceneRequest request_from(const InitOptions& options, core::ProblemList& problems) {
  scenes::NewSceneRequest request;
  request.name = scenes::landing_name(options.airport, options.runway);
  request.airport = find_airport(options, problems);
  request.airport_source = source_of(options);
  request.runway = options.runway;
  request.elevation = options.elevation;
  request.track = options.track;
  request.buildings = options.buildings;
  request.data_folder = options.data;
  request.start_distance_m = options.start_distance_m;
  request.glide_path_deg = options.glide_path_deg;
  request.threshold_crossing_height_m = options.threshold_crossing_height_m;
  return request;
}

int make(const InitOptions& options, const CommonOptions& common) {
  fs::path folder = fs::absolute(options.folder).lexically_normal();
  if (folder.filename().empty()) folder = folder.parent_path();
  core::ProblemList problems;
  const scenes::NewSceneRequest request = request_from(options, problems);
  const std::optional<scenes::NewScene> made = scenes::make_new_scene(request, problems);
  const std::vector<std::string> names =
      made ? session::new_scene_files(*made) : std::vector<std::string>{"scene.toml"};
  // After what the data are judged by, which stops at errors.
  session::check_new_files(folder, names, options.overwrite, problems);
  check_data_folder(options.data, problems);
  if (made && !common.quiet) print_notes(made->notes);
  problems.throw_if_errors();

  session::Setup setup{shipped_folder()};
  if (!options.data.empty()) setup.data_folders.emplace_back(options.data);
  const auto scene = session::put_new_scene(*made, folder, setup, problems);
  if (common.quiet) return kExitDone;
  print_problems(problems.all());
  std::string list;
  for (const std::string& file : names) list += (list.empty() ? "" : ", ") + file;
  fmt::print("\n{}", beside("wrote  ", options.folder + ": " + list));
  print_next_steps(options, *scene);
  return kExitDone;
}

// Makes the scene beside its folder, reads and builds it as render would, and only then gives it its
// name; a scene that is there already is kept unless `overwrite`. Prints what was found and guessed.
// Whatever is wrong is printed, all at once, and nothing is written.
int init_scene(const InitOptions& options, const CommonOptions& common) {
  try {
    return make(options, common);
  } catch (const core::InputError& error) {
    std::cout.flush();
    print_problems(error.problems());
    std::cerr << "nothing was written\n";
    return exit_code_of(error.problems());
  }
}

}  // namespace

void add_init(CommandLine& line) { line.add(declare_init, init_scene); }

}  // namespace fanbeam::apps
