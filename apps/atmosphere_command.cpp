// fanbeam atmosphere: what the air, fog, rain and snow take from a path, and what they echo.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/scene_choice.h"
#include "apps/weather_options.h"
#include "atmosphere/loss_table.h"
#include "atmosphere/loss_text.h"
#include "core/constants.h"
#include "core/files.h"
#include "measure/frequency_choice.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/sensor_file.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

struct AtmosphereOptions {
  std::string scene;                  // weather and sensor of a scene; else the options below
  std::string data;                   // as in the other commands
  std::vector<double> frequency_GHz;  // the sensor's when empty
  std::vector<double> compare_GHz;    // two: what the choice of frequency means
  WeatherOptions weather;             // over the scene's
  double height_m = 100.0, to_height_m = 0.0, range_m = 4000.0, step_m = 500.0;
  bool csv = false, json = false;
  std::string output;  // folder for plot and files
};

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
  add_word(command, "--fog-type", weather.fog_type,
           {"kunkel", "eldridge-altshuler", "zhao-radiation", "zhao-advection", "tomasi-dry-cold",
            "tomasi-wet-warm"},
           "Water from visibility");
  add_word(command, "--fog-law", weather.fog_law, {"itu-p840", "altshuler", "centimetre"},
           "Loss from water");
  add_word(command, "--rain-law", weather.rain_law, {"itu-p838", "georgia-tech-95", "mie"},
           "Loss from rain rate");
  add_word(command, "--rain-echo-law", weather.rain_echo_law,
           {"mie", "mie-fit", "georgia-tech-1975"}, "Echo from rain rate");
  add_word(command, "--drop-sizes", weather.drop_sizes,
           {"marshall-palmer", "joss-drizzle", "joss-thunderstorm"}, "Of the laws mie");
  CLI::Option* polarisation =
      add_word(command, "--polarisation", weather.polarisation, {"HH", "VV"},
               "For the rain law itu-p838 (default: the scene's, else HH)");
  add_number(command, "--tilt", weather.tilt_deg, {-180.0, 180.0},
             "The same in between: tilt from horizontal, degrees, -180 to 180; 45 stands for "
             "circular too")
      ->excludes(polarisation);
  add_number(command, "--path-elevation", weather.path_elevation_deg, {-90.0, 90.0},
             "For the rain law itu-p838: elevation of the path, degrees, -90 to 90 (default "
             "0, as scenes are rendered; heights and range do not change it)");
}

void add_air(CLI::App& command, WeatherOptions& weather) {
  command.add_option("--temperature", weather.temperature_C, "At the origin, C, -60 to 50");
  CLI::Option* humidity =
      command.add_option("--humidity", weather.humidity, "Relative, at the origin, 0 to 1");
  CLI::Option* pressure =
      command.add_option("--pressure", weather.pressure_hPa,
                         "Of air and vapour together, at the origin, hPa, 300 to 1100");
  add_number(command, "--vapour-density", weather.vapour_density_g_per_m3, {0.0, 300.0},
             "Water vapour at the origin, g/m3, 0 to saturation; in fog air is saturated")
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
    return add_number(command, name, value, {least, most}, what)->capture_default_str();
  };
  return {
      add("--height", options.height_m, "Of the antenna above the origin, m", -2000, 12000),
      add("--to-height", options.to_height_m, "Where paths end above the origin, m", -2000, 12000),
      add("--range", options.range_m, "Farthest range, m", 1, 1e6),
      add("--step", options.step_m, "Step of range, m", 1, 1e6)};
}

CLI::App& declare_atmosphere(CLI::App& program, AtmosphereOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "atmosphere", "Loss in air, fog, rain and snow over range, and the echo of what falls");
  CLI::Option* scene =
      command.add_option("SCENE", options.scene, "A scene whose weather and sensor are used")
          ->type_name(kSceneValue);
  add_folder(command, "--data", options.data,
             "Folder with terrain and flight data, looked at before the one that FANBEAM_DATA "
             "names")
      ->needs(scene);
  CLI::Option* frequency = add_number(command, "--frequency", options.frequency_GHz, {1.0, 1000.0},
                                      "GHz, one or more: 35,94 (default: the sensor's)")
                               ->delimiter(',');
  CLI::Option* compare =
      add_number(command, "--compare", options.compare_GHz, {1.0, 1000.0},
                 "Two frequencies in GHz: a table of their losses and echoes in several fogs "
                 "and rains, and plots of them with -o")
          ->delimiter(',')
          ->expected(2);
  CLI::Option* csv = command.add_flag("--csv", options.csv, "Print CSV");
  CLI::Option* json = command.add_flag("--json", options.json, "Print JSON")->excludes(csv);
  Options without_effect = {frequency, csv, json};
  for (const Options& more : {add_amounts(command, options.weather), add_path(command, options)})
    without_effect.insert(without_effect.end(), more.begin(), more.end());
  for (CLI::Option* option : without_effect) compare->excludes(option);
  add_laws(command, options.weather);
  add_air(command, options.weather);
  add_folder(command, "-o,--output", options.output,
             "Folder for plots, and for CSV and JSON unless --compare (default: none written)");
  return command;
}

// The weather and the sensor that are asked about, before the options have changed it.
struct Question {
  atmosphere::Weather weather;
  sensors::Sensor sensor;
  std::vector<scenes::RainCellDescription> rain_cells;
};

Question question_of(const AtmosphereOptions& options) {
  Question question;
  core::ProblemList problems;
  if (options.scene.empty()) {
    question.sensor =
        sensors::read_sensor((shipped_folder() / "sensors/hivision.toml").string(), problems);
  } else {
    const scenes::SceneDescription scene =
        read_chosen_scene({options.scene, {}, options.data}, problems);
    question = {scene.weather, scene.sensor, scene.rain_cells};
  }
  problems.throw_if_errors();
  return question;
}

// The problem in the words of the command line, where an option gave the value.
core::Problem in_words_of_options(core::Problem problem, const AtmosphereOptions& options) {
  const bool compares = !options.compare_GHz.empty();
  std::string option = option_behind(options.weather, problem.field);
  if (problem.field == "frequency" && (compares || !options.frequency_GHz.empty()))
    option = compares ? "--compare" : "--frequency";
  if (!option.empty()) problem.field = option;
  return problem;
}

// dB of an echo that may be none.
std::string dB_text(double value_dB) {
  return std::isfinite(value_dB) ? fmt::format("{:.1f}", value_dB) : "-";
}

void print_table(const atmosphere::AtmosphereTable& table) {
  constexpr const char* kHeadings =
      "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>11} {:>10}\n";
  fmt::print("\n{} GHz\n", table.frequency_Hz / 1e9);
  fmt::print(kHeadings, "range", "oxygen", "vapour", "fog", "rain", "snow", "one way", "two-way",
             "eta", "as sigma0");
  fmt::print(kHeadings, "m", "dB", "dB", "dB", "dB", "dB", "dB", "dB", "m2/m3", "dB");
  for (const atmosphere::AtmosphereRow& row : table.rows)
    fmt::print(
        "{:>8.0f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.3f} {:>9.3f} {:>11.3g} "
        "{:>10}\n",
        row.range_m, row.oxygen_dB, row.vapour_dB, row.fog_dB, row.rain_dB, row.snow_dB,
        row.one_way_dB(), row.two_way_dB(), row.eta_m2_per_m3, dB_text(row.equivalent_sigma0_dB));
  if (table.rain)
    fmt::print("  rain: k = {:.5g}, alpha = {:.4f}\n", table.rain->k, table.rain->alpha);
}

void print_notes(const atmosphere::AtmospherePath& path,
                 const std::vector<atmosphere::AtmosphereModel>& models) {
  fmt::print(
      "Path from {} m to {} m above the origin; eta where it ends, and the sigma0 of ground "
      "that would\nreturn as much as a beam of {:.2f} deg (two-way) full of it.\n",
      path.from_height_m, path.to_height_m, path.beam_height_rad * 180.0 / core::kPi);
  for (const atmosphere::AtmosphereModel& model : models)
    fmt::print("  {:<10} {:<42} {}\n", model.cause, model.model, model.source);
}

void print_tables(const Question& question,
                  const std::vector<atmosphere::AtmosphereTable>& tables) {
  for (const atmosphere::AtmosphereTable& table : tables) {
    print_table(table);
    for (const scenes::RainCellDescription& described : question.rain_cells) {
      const double rate_mm_per_h = described.cell.rain_rate_mm_per_h;
      fmt::print("  {} of {} mm/h: {:.3f} dB/km one way and eta {:.3g} m2/m3 more inside\n",
                 described.at.field.substr(0, described.at.field.rfind('.')), rate_mm_per_h,
                 rain_dB_per_km(question.weather, rate_mm_per_h, table.frequency_Hz),
                 rain_eta_m2_per_m3(question.weather.rain_echo_law, rate_mm_per_h,
                                    table.frequency_Hz, rain_drops(question.weather)));
    }
  }
}

session::Plot plot_of(const std::vector<atmosphere::AtmosphereTable>& tables) {
  session::Plot plot;
  plot.title = "Two-way loss over range";
  plot.x = {"range [km]", false, 0.0, {}};
  plot.y = {"loss [dB]", false, 0.0, {}};
  for (const atmosphere::AtmosphereTable& table : tables) {
    session::PlotSeries total{fmt::format("{} GHz", table.frequency_Hz / 1e9), {}, {}};
    for (const atmosphere::AtmosphereRow& row : table.rows) {
      total.x.push_back(1e-3 * row.range_m);
      total.y.push_back(row.two_way_dB());
    }
    plot.series.push_back(total);
  }
  return plot;
}

void write_files(const fs::path& folder, const std::vector<atmosphere::AtmosphereTable>& tables,
                 const std::vector<atmosphere::AtmosphereModel>& models) {
  fs::create_directories(folder);
  core::write_file_atomically(folder / "atmosphere.csv", atmosphere::loss_csv(tables));
  core::write_file_atomically(folder / "atmosphere.json", atmosphere::loss_json(tables, models));
  for (const char* name : {"atmosphere.svg", "atmosphere.png"})
    session::write_plot(plot_of(tables), folder / name);
}

// No point of the other height is nearer than the two are apart.
void require_rows(const AtmosphereOptions& options) {
  const double apart_m = std::abs(options.height_m - options.to_height_m);
  if (options.range_m < apart_m)
    core::throw_input_error(
        core::ErrorClass::range, "--range", options.range_m,
        "at least " + core::number_text(apart_m) + " m, what --height and --to-height are apart");
}

void answer(const Question& question, const AtmosphereOptions& options,
            const CommonOptions& common) {
  const bool compares = !options.compare_GHz.empty();
  core::ProblemList idle;
  if (!compares)  // which has fog and rain of its own
    check_amounts(options.weather, question.weather, !question.rain_cells.empty(), idle);
  check_laws(options.weather, question.weather, idle);
  idle.throw_if_errors();
  if (compares) {
    fmt::print("{}", measure::compare_frequencies(question.weather, 1e9 * options.compare_GHz[0],
                                                  1e9 * options.compare_GHz[1], options.output));
    return;
  }
  require_rows(options);
  const atmosphere::AtmospherePath path{options.height_m, options.to_height_m, options.range_m,
                                        options.step_m,
                                        sensors::two_way_width(question.sensor.antenna.elevation)};
  std::vector<double> frequencies_GHz = options.frequency_GHz;
  if (frequencies_GHz.empty())
    frequencies_GHz.push_back(question.sensor.waveform.frequency_Hz * 1e-9);
  std::vector<atmosphere::AtmosphereTable> tables;
  for (const double frequency_GHz : frequencies_GHz)
    tables.push_back(atmosphere::atmosphere_table(question.weather, 1e9 * frequency_GHz, path));
  const std::vector<atmosphere::AtmosphereModel> models = atmosphere_models(question.weather);
  if (options.json) {
    fmt::print("{}", atmosphere::loss_json(tables, models));
  } else if (options.csv) {
    fmt::print("{}", atmosphere::loss_csv(tables));
  } else {
    if (!common.quiet) print_notes(path, models);
    print_tables(question, tables);
  }
  if (!options.output.empty()) write_files(options.output, tables, models);
}

int atmosphere(const AtmosphereOptions& options, const CommonOptions& common) {
  Question question = question_of(options);
  try {
    put_over(options.weather, question.weather);
    answer(question, options, common);
  } catch (const core::InputError& error) {
    std::vector<core::Problem> problems;
    for (const core::Problem& problem : error.problems())
      problems.push_back(in_words_of_options(problem, options));
    throw core::InputError(problems);
  }
  return kExitDone;
}

}  // namespace

void add_atmosphere(CommandLine& line) { line.add(declare_atmosphere, atmosphere); }

}  // namespace fanbeam::apps
