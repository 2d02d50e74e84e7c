// `fanbeam materials`: what the library holds, plots of it, and fits of the Phong-like form.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/objects_table.h"
#include "apps/option_kinds.h"
#include "core/files.h"
#include "core/units.h"
#include "materials/library/library_text.h"
#include "materials/library/material_library.h"
#include "materials/library/material_rows.h"
#include "materials/library/model_reader.h"
#include "materials/nrcs/measurement_csv.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using materials::MaterialRow;

// Which rows, and how they are looked at.
struct MaterialsView {
  std::string library;  // a file; empty for the shipped one
  double frequency_GHz = 35.0;
  std::string polarisation = "HH";
  std::string state = "dry";
  bool json = false;
};

struct MaterialsPlotOptions {
  std::string output;
  std::vector<std::string> names;  // all rows when empty
};

// The source of a fit: a model as library rows write it, a table of measurements, or a library.
struct MaterialsFitOptions {
  std::string model, terrain, medium, csv;
  std::vector<double> permittivity;  // real, loss
  std::optional<double> sea_state, rms_height_mm, rms_slope, temperature_C;
  std::string angles = "standard";
  bool whole_library = false;  // prints the library's text with all fits made again
};

struct MaterialsOptions {
  enum class Task { list, plot, fit, objects };  // its subcommands; none: list
  Task task = Task::list;
  MaterialsView view;
  MaterialsPlotOptions plot;
  MaterialsFitOptions fit;
};

// What surfaces are looked at with.
std::vector<CLI::Option*> add_view(CLI::App& command, MaterialsView& options) {
  return {add_number(command, "--frequency", options.frequency_GHz, {1.0, 300.0}, "GHz")
              ->capture_default_str(),
          add_word(command, "--polarisation", options.polarisation, {"HH", "VV"}, "HH or VV")
              ->capture_default_str()};
}

std::vector<CLI::Option*> add_rows(CLI::App& command, MaterialsView& options) {
  return {
      add_file(command, "--library", options.library, "Library file (default: the shipped one)"),
      add_word(command, "--state", options.state, {"dry", "wet", "dry-snow", "wet-snow"},
               "State of the surfaces")
          ->capture_default_str()};
}

void add_plot(CLI::App& command, MaterialsView& options, MaterialsPlotOptions& plot) {
  add_file(command, "-o,--output", plot.output, "A file ending in .svg or .png")->required();
  command.add_option("NAMES", plot.names, "Materials (default: all)")->type_name(kMaterialValue);
  add_rows(command, options);
  add_view(command, options);
}

// The parameters of a model; which of them a model has is up to its reader.
std::vector<CLI::Option*> add_model_keys(CLI::App& command, MaterialsFitOptions& fit) {
  return {command.add_option("--terrain", fit.terrain, "Such as urban, grass, flatland"),
          command.add_option("--medium", fit.medium, "Such as concrete or water, of oh1992"),
          command
              .add_option("--permittivity", fit.permittivity,
                          "Real part and loss, of oh1992, 0 to 1000")
              ->expected(2),
          command.add_option("--sea-state", fit.sea_state, "0 to 6, of nrl-sea"),
          command.add_option("--rms-height-mm", fit.rms_height_mm,
                             "Of oh1992 and rough-metal, mm, 0 to 1000"),
          command.add_option("--rms-slope", fit.rms_slope, "Of rough-metal, 0.01 to 1"),
          command.add_option("--temperature-C", fit.temperature_C,
                             "Of the medium of oh1992, C, -50 to 60"),
          add_word(command, "--angles", fit.angles, {"standard", "steep", "to-normal"},
                   "Grazing angles of a model's fit")
              ->capture_default_str()};
}

void add_fit(CLI::App& command, MaterialsOptions& options) {
  MaterialsFitOptions& fit = options.fit;
  CLI::Option* model =
      add_word(command, "--model", fit.model,
               {"constant-gamma", "kulemin", "git-land", "nrl-sea", "oh1992", "rough-metal"},
               "With the options that the keys of a library row are called after");
  for (CLI::Option* key : add_model_keys(command, fit)) key->needs(model);
  for (CLI::Option* view : add_view(command, options.view)) view->needs(model);
  CLI::Option* csv =
      add_file(command, "--csv", fit.csv,
               "Measurements: a CSV file with the columns grazing_deg and sigma0_dB");
  CLI::Option* library =
      add_file(command, "--library", options.view.library,
               "Print a library's text with all fits made again (default file: the shipped one)")
          ->expected(0, 1);
  model->excludes(csv)->excludes(library);
  csv->excludes(library);
  command.add_flag("--json", options.view.json, "As JSON")->excludes(library);
  command.callback([&options, &fit, library, model, csv] {
    options.task = MaterialsOptions::Task::fit;
    fit.whole_library = library->count() > 0;
    if (!fit.whole_library && model->count() == 0 && csv->count() == 0)
      throw CLI::RequiredError("--model, --csv or --library");
  });
}

CLI::App& declare_materials(CLI::App& program, MaterialsOptions& options) {
  using Task = MaterialsOptions::Task;
  MaterialsView& view = options.view;
  CLI::App& list = *program.add_subcommand(
      "materials", "List what the material library holds; plot it; fit the Phong-like form");
  std::vector<CLI::Option*> of_list = add_rows(list, view);
  for (CLI::Option* option : add_view(list, view)) of_list.push_back(option);
  of_list.push_back(list.add_flag("--json", view.json, "As JSON"));

  CLI::App& plot = *list.add_subcommand("plot", "sigma0 over grazing angle (gnuplot)");
  add_plot(plot, view, options.plot);
  plot.callback([&options] { options.task = Task::plot; });
  CLI::App& fit =
      *list.add_subcommand("fit", "Fit a, b, c to a model, a table, or a whole library again");
  add_fit(fit, options);
  CLI::App& objects = *list.add_subcommand("objects", "Radar cross-sections of typical objects");
  add_file(objects, "--library", view.library, "Object library (default: the shipped one)");
  objects.callback([&options] { options.task = Task::objects; });
  // Options of the list stand behind the subcommand where they mean something to it.
  for (CLI::App* subcommand : {&plot, &fit, &objects})
    for (CLI::Option* option : of_list) subcommand->excludes(option);
  list.require_subcommand(0, 1);
  return list;
}

constexpr std::uint64_t kLargestFile_bytes = 4U << 20U;

fs::path library_file(const MaterialsView& options) {
  return options.library.empty() ? shipped_folder() / "materials" / "library.toml"
                                 : fs::path(options.library);
}

core::Polarisation polarisation_of(const MaterialsView& options) {
  return options.polarisation == "VV" ? core::Polarisation::vertical
                                      : core::Polarisation::horizontal;
}

materials::MaterialLibrary read_library(const MaterialsView& options) {
  core::ProblemList problems;
  auto library = materials::MaterialLibrary::from_file(library_file(options), problems);
  problems.throw_if_errors();
  return library;
}

std::vector<MaterialRow> rows_of(const materials::MaterialLibrary& library,
                                 const MaterialsView& options) {
  return materials::rows_under(library, options.frequency_GHz * 1e9, polarisation_of(options),
                               materials::surface_state_of(options.state, "--state"));
}

std::string level_text(double level_dB) {
  return std::isfinite(level_dB) ? fmt::format("{:7.1f}", level_dB) : "   dark";
}

void print_row(const MaterialRow& row) {
  const materials::ModelValidity known = validity_of(row.shown.model);
  std::string figures = fmt::format("{:>32}", name_of(row.shown.model));
  if (const auto* phong = std::get_if<materials::PhongSurface>(&row.shown.model))
    figures = fmt::format("{:>10.4g} {:>10.4g} {:>10.4g}", phong->nrcs.a(), phong->nrcs.b(),
                          phong->nrcs.c());
  std::string levels;
  for (const double angle_deg : materials::kListAngles_deg)
    levels += level_text(row.level_dB(angle_deg));
  const std::string range =
      fmt::format("{:g}-{:g}", known.frequency_Hz.low / 1e9, known.frequency_Hz.high / 1e9);
  fmt::print("{:<19}{} {}{} {:>9} {:<4} {:<9} {}{}\n", row.dry.name, figures, levels,
             row.known ? " " : "*", range, polarisation_text(known), name_of(row.shown.confidence),
             row.shown.name == row.dry.name ? "" : "as " + row.shown.name + ": ", row.shown.source);
}

// The keys of a library row for the model that the options name, to be read like one.
std::string model_keys(const MaterialsFitOptions& fit) {
  const auto quoted = [](const std::string& text) { return Json(text).dump(); };
  std::string keys = "model = " + quoted(fit.model) + "\n";
  if (!fit.terrain.empty()) keys += "terrain = " + quoted(fit.terrain) + "\n";
  if (!fit.medium.empty()) keys += "medium = " + quoted(fit.medium) + "\n";
  if (!fit.permittivity.empty())
    keys += fmt::format("permittivity = [{}, {}]\n", core::number_text(fit.permittivity[0]),
                        core::number_text(fit.permittivity[1]));
  const auto number = [&keys](const char* key, const std::optional<double>& value) {
    if (value) keys += fmt::format("{} = {}\n", key, core::number_text(*value));
  };
  number("sea_state", fit.sea_state);
  number("rms_height_mm", fit.rms_height_mm);
  number("rms_slope", fit.rms_slope);
  number("temperature_C", fit.temperature_C);
  return keys;
}

// "rms_height_mm" came from --rms-height-mm; only a frequency's unit is not part of its option.
[[noreturn]] void throw_in_words_of_options(const core::InputError& error,
                                            const std::string& model) {
  std::vector<core::Problem> problems;
  for (core::Problem problem : error.problems()) {
    problem.place = {};
    problem.field = problem.field == "frequency_GHz" ? "--frequency" : "--" + problem.field;
    std::replace(problem.field.begin(), problem.field.end(), '_', '-');
    if (problem.value == "unknown key") {
      problem.value = "given";
      problem.expected = "an option of the model " + model;
    }
    problems.push_back(problem);
  }
  throw core::InputError(problems);
}

std::vector<materials::NrcsSample> samples_of_model(const MaterialsView& options,
                                                    const MaterialsFitOptions& fit) try {
  core::ProblemList problems;
  core::ConfigTable table = core::ConfigTable::from_text(model_keys(fit), "command line", problems);
  const materials::SurfaceModel model = materials::read_surface_model(table);
  table.report_unknown_keys();
  problems.throw_if_errors();
  std::size_t set = 0;
  while (set + 1 < materials::kFitAnglesNames.size() &&
         fit.angles != materials::kFitAnglesNames[set])
    ++set;
  return materials::sample_model(
      [&](double grazing_rad) {
        return sigma0(model, polarisation_of(options), options.frequency_GHz * 1e9, grazing_rad);
      },
      materials::fit_angles_deg(static_cast<materials::FitAngles>(set)));
} catch (const core::InputError& error) {
  throw_in_words_of_options(error, fit.model);
}

std::vector<materials::NrcsSample> samples_of_file(const std::string& file) {
  core::ProblemList problems;
  auto samples =
      materials::read_measurements(core::read_file(file, kLargestFile_bytes), file, problems);
  problems.throw_if_errors();
  return samples;
}

int print_library_again(const MaterialsView& options) {
  const fs::path file = library_file(options);
  core::ProblemList problems;
  const std::string text = materials::with_fits_made_again(
      core::read_file(file, kLargestFile_bytes), file.string(), problems);
  problems.throw_if_errors();
  fmt::print("{}", text);
  return kExitDone;
}

int list_materials(const MaterialsOptions& all) {
  const MaterialsView& options = all.view;
  const materials::MaterialLibrary library = read_library(options);
  const std::vector<MaterialRow> rows = rows_of(library, options);
  if (options.json) {
    Json json = {{"library", library_file(options).string()},
                 {"frequency_GHz", options.frequency_GHz},
                 {"polarisation", options.polarisation},
                 {"state", options.state},
                 {"materials", Json::array()}};
    for (const MaterialRow& row : rows) json["materials"].push_back(Json::parse(row_json(row)));
    fmt::print("{}\n", json.dump(1));
    return kExitDone;
  }
  fmt::print(
      "sigma0 at {:g} GHz, {}, {} surfaces, at grazing angles of 3, 10 and 30 deg; * is "
      "outside what the row knows\n",
      options.frequency_GHz, options.polarisation, options.state);
  fmt::print("{:<19}{:>10} {:>10} {:>10}  {:>6} {:>6} {:>6} {:>10} {:<4} {:<9} {}\n", "material",
             "a", "b", "c", "3 deg", "10 deg", "30 deg", "GHz", "pol.", "confid.", "source");
  for (const MaterialRow& row : rows) print_row(row);
  return kExitDone;
}

int plot_materials(const MaterialsOptions& all) {
  const MaterialsView& options = all.view;
  const MaterialsPlotOptions& plot = all.plot;
  constexpr int kPlaces = 400;
  const materials::MaterialLibrary library = read_library(options);
  core::ProblemList problems;
  for (const std::string& name : plot.names) library.find(name, {}, "material", problems);
  problems.throw_if_errors();
  session::Plot picture;
  picture.title = fmt::format("Surface reflectivity at {:g} GHz, {}, {}", options.frequency_GHz,
                              options.polarisation, options.state);
  picture.x = {"grazing angle, deg", true, 0.5, 90.0};
  picture.y = {"sigma0, dB", false, {}, {}};
  std::string dark;
  for (const MaterialRow& row : rows_of(library, options)) {
    const bool wanted = plot.names.empty() || std::find(plot.names.begin(), plot.names.end(),
                                                        row.dry.name) != plot.names.end();
    if (!wanted) continue;
    session::PlotSeries series;
    series.title = row.dry.name;
    if (!row.known) series.style = session::PlotSeries::Style::dashed_line;
    for (int i = 0; i <= kPlaces; ++i) {
      series.x.push_back(0.5 * std::pow(180.0, static_cast<double>(i) / kPlaces));
      series.y.push_back(row.level_dB(std::min(series.x.back(), 90.0)));
    }
    // gnuplot takes no curve that is all gap: a surface that returns nothing.
    if (std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); }))
      picture.series.push_back(std::move(series));
    else
      dark += (dark.empty() ? "" : ", ") + row.dry.name;
  }
  if (picture.series.empty())
    core::throw_input_error(core::ErrorClass::range, "material", dark,
                            "one that returns something");
  const int key_px = 120 + 22 * static_cast<int>(picture.series.size());
  picture.height_px = std::max(picture.height_px, key_px);
  session::write_plot(picture, plot.output);
  return kExitDone;
}

int fit_materials(const MaterialsOptions& all) {
  const MaterialsView& options = all.view;
  const MaterialsFitOptions& fit = all.fit;
  if (fit.whole_library) return print_library_again(options);
  const materials::PhongFit result = materials::fit_phong(
      fit.csv.empty() ? samples_of_model(options, fit) : samples_of_file(fit.csv));
  if (options.json) {
    const Json json = {{"a", result.nrcs.a()},
                       {"b", result.nrcs.b()},
                       {"c", result.nrcs.c()},
                       {"rms_dB", result.rms_dB},
                       {"largest_dB", result.max_dB}};
    fmt::print("{}\n", json.dump(1));
    return kExitDone;
  }
  fmt::print("a = {}\nb = {}\nc = {}\n# misses its source by {:.2f} dB RMS, {:.2f} dB at most\n",
             materials::five_digits(result.nrcs.a()), materials::five_digits(result.nrcs.b()),
             materials::five_digits(result.nrcs.c()), result.rms_dB, result.max_dB);
  return kExitDone;
}

int show_objects(const MaterialsOptions& all) { return list_objects(all.view.library); }

int materials(const MaterialsOptions& options, const CommonOptions&) {
  using Work = int (*)(const MaterialsOptions&);
  constexpr Work kWorks[] = {list_materials, plot_materials, fit_materials,
                             show_objects};  // as Task
  return kWorks[static_cast<std::size_t>(options.task)](options);
}

}  // namespace

void add_materials(CommandLine& line) { line.add(declare_materials, materials); }

}  // namespace fanbeam::apps
