// A campaign: many runs of one or more scenes, each a short flight under conditions drawn for it.
//
//   [campaign]
//   name = "fog-approaches"
//   scenes = ["braunschweig-26"]       folders beside this file, else names of shipped scenes; optional
//                                      where there are airports; each once, and none named as an airport
//   runs = 200                         of a grid: how often it is gone through, 1 unless given
//   plan = "sobol"                     "grid", "sobol" or "random"
//   seed = 1
//   frames = { count = 5, from = 0.3, to = 0.95 }       spread over that part of the flight
//   products = ["bscope", "labels"]
//   isa = "v3"                         every machine makes the same bytes
//   realisation = "mean"               or "sample"; optional, else as each scene says
//   samples_per_cell = 4               optional, as --rays-per-cell
//   sensor = "hivision"                optional, a file beside this one, else a name
//   runs_as = "folders"                or "archives": one tar a run
//
//   [parameters]                       all optional; values and distributions: distribution.h
//   surface = "wet"
//   weather.visibility_m = { log_uniform = [150, 2000] }
//   flight.lateral_m = { normal = [0, 10], within = [-40, 40] }
//
//   [[airport]]                        a scene for each, beside `scenes`: an approach to that runway
//   ident = "EDNY"                     in `file`: apt.dat, or a table of runways
//   runway = "24"
//   file = "runways.csv"               beside this file or in a data folder, as the two below
//   elevation = "N47E009.hgt"
//   buildings = "city.geojson"         optional
//   name = "edny-24"                   of the scene, optional
//   start_distance_m = 5000            before the threshold, and
//   glide_path_deg = 3                 optional
//
//   [[traffic]]                        a point scatterer, from the threshold that the flight lands on
//   name = "car"                       of no target of the scenes
//   rcs_m2 = { log_uniform = [1, 30] }
//   along_m = { uniform = [100, 900] }
//   across_m = 0
//   present = 0.5                      in this share of the runs, 1 unless given; of a grid 0 or 1
//
// kParameters lists all parameters but scene, surface and those of traffic. Every drawn value is a pure function of file and run number.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/machine.h"
#include "datasets/distribution.h"

namespace fanbeam::datasets {

struct ParameterKind {
  const char* table;  // below [parameters]
  const char* key;
  core::NumberRange range;
  const char* what;
};
inline constexpr std::array<ParameterKind, 19> kParameters = {{
    {"weather", "visibility_m", {10.0, 100000.0}, "fog below its top"},
    {"weather", "liquid_water_g_per_m3", {0.0, 20.0}, "the same by its water"},
    {"weather", "fog_top_m", {-2000.0, 12000.0}, "above the scene's origin"},
    {"weather", "rain_rate_mm_per_h", {0.0, 300.0}, "rain everywhere"},
    {"weather", "snow_rate_mm_per_h", {0.0, 50.0}, "water equivalent"},
    {"weather", "temperature_C", {-60.0, 50.0}, "of the air at the origin"},
    {"weather", "pressure_hPa", {300.0, 1100.0}, "of the air at the origin"},
    {"weather", "humidity", {0.0, 1.0}, "relative"},
    {"sensor", "tilt_deg", {-60.0, 60.0}, "boresight elevation"},
    {"sensor", "noise_figure_dB", {0.0, 60.0}, "of the receiver"},
    {"flight", "lateral_m", {-2000.0, 2000.0}, "right of the scene's flight"},
    {"flight", "vertical_m", {-500.0, 5000.0}, "above it"},
    {"flight", "heading_deg", {-90.0, 90.0}, "yaw about the aircraft's own axes"},
    {"flight", "pitch_deg", {-45.0, 45.0}, "pitch about them, after the yaw"},
    {"flight", "roll_deg", {-60.0, 60.0}, "roll about them, last"},
    {"flight", "speed_factor", {0.1, 10.0}, "times its speed"},
    {"flight", "time_s", {-1e6, 1e6}, "added to its time: moves the scene's targets"},
    {"flight", "turbulence_m", {0.0, 200.0}, "RMS of the path aside and in height"},
    {"flight", "turbulence_deg", {0.0, 30.0}, "RMS of yaw, pitch and roll, as above"},
}};

// One that varies, or is set.
struct Parameter {
  std::string name;  // "weather.visibility_m", "traffic.car.along_m", "scene", "surface"
  Distribution distribution;
};

struct FrameSpread {
  int count = 1;
  double from = 0.0, to = 1.0;  // shares of the flight
};

struct CampaignAirport {
  std::string name, ident, runway, file, elevation, buildings;
  double start_distance_m = 5000.0, glide_path_deg = 3.0;
  core::Place place;
};

struct Campaign {
  enum class Plan { grid, sobol, random };

  std::filesystem::path file;
  std::string text_hash;  // SHA-256 of the file
  std::string name;
  std::vector<std::string> scenes;  // as the file names them, then those of `airports`
  std::vector<CampaignAirport> airports;
  Plan plan = Plan::random;
  int runs = 1;  // all of them
  std::uint64_t seed = 0;
  FrameSpread frames;
  std::vector<std::string> products;
  core::InstructionLevel isa = core::InstructionLevel::v3;
  std::optional<bool> sample;  // one realisation; else as each scene says
  double samples_per_cell = 0.0;
  std::string sensor;
  bool archives = false;  // run_files.h
  std::vector<Parameter> parameters;
  std::vector<std::string> traffic;  // names

  const Parameter* find(std::string_view name) const;
  // That its file lies in.
  std::filesystem::path folder() const;
};

inline constexpr int kMostRuns = 100'000'000;

// What a campaign is read for: earlier versions took weights and shares of runs in a grid, where they mean
// nothing, and what they made can still be looked at.
enum class ReadFor { making, looking };

// Every problem of the file is in `problems`, with line and column; with errors there the campaign must
// not be used. With the folder of what is shipped (session/shipped.h), scenes and a sensor that are neither
// beside the file nor there are problems too (E-REF).
Campaign read_campaign(const std::filesystem::path& file, core::ProblemList& problems,
                       ReadFor purpose = ReadFor::making,
                       const std::filesystem::path& shipped = {});

}  // namespace fanbeam::datasets
