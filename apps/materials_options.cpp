#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/common.h"
#include "apps/materials_command.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

// What surfaces are looked at with.
std::vector<CLI::Option*> add_view(CLI::App& command, MaterialsView& options) {
  return {command.add_option("--frequency", options.frequency_GHz, "GHz")
              ->check(number_from(1.0, 300.0))
              ->capture_default_str(),
          command.add_option("--polarisation", options.polarisation, "HH or VV")
              ->check(CLI::IsMember({"HH", "VV"}))
              ->capture_default_str()};
}

std::vector<CLI::Option*> add_rows(CLI::App& command, MaterialsView& options) {
  return {
      command.add_option("--library", options.library, "Library file (default: the shipped one)")
          ->type_name(kFileValue),
      command.add_option("--state", options.state, "State of the surfaces")
          ->check(CLI::IsMember({"dry", "wet", "dry-snow", "wet-snow"}))
          ->capture_default_str()};
}

void add_plot(CLI::App& command, MaterialsView& options, MaterialsPlotOptions& plot) {
  command.add_option("-o,--output", plot.output, "A file ending in .svg or .png")
      ->type_name(kFileValue)
      ->required();
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
          command.add_option("--angles", fit.angles, "Grazing angles of a model's fit")
              ->check(CLI::IsMember({"standard", "steep", "to-normal"}))
              ->capture_default_str()};
}

void add_fit(CLI::App& command, MaterialsOptions& options) {
  MaterialsFitOptions& fit = options.fit;
  CLI::Option* model =
      command
          .add_option("--model", fit.model,
                      "With the options that the keys of a library row are called after")
          ->check(CLI::IsMember(
              {"constant-gamma", "kulemin", "git-land", "nrl-sea", "oh1992", "rough-metal"}));
  for (CLI::Option* key : add_model_keys(command, fit)) key->needs(model);
  for (CLI::Option* view : add_view(command, options.view)) view->needs(model);
  CLI::Option* csv = command.add_option(
      "--csv", fit.csv, "Measurements: a CSV file with the columns grazing_deg and sigma0_dB");
  csv->type_name(kFileValue);
  CLI::Option* library = command.add_option(
      "--library", options.view.library,
      "Print a library's text with all fits made again (default file: the shipped one)");
  library->expected(0, 1)->type_name(kFileValue);
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

}  // namespace

CLI::App& add_materials_command(CLI::App& program, MaterialsOptions& options) {
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
  objects.add_option("--library", view.library, "Object library (default: the shipped one)")
      ->type_name(kFileValue);
  objects.callback([&options] { options.task = Task::objects; });
  // Options of the list stand behind the subcommand where they mean something to it.
  for (CLI::App* subcommand : {&plot, &fit, &objects})
    for (CLI::Option* option : of_list) subcommand->excludes(option);
  list.require_subcommand(0, 1);
  return list;
}

}  // namespace fanbeam::apps
