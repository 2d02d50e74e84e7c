#include <CLI/CLI.hpp>

#include "apps/atmosphere_command.h"
#include "apps/compare_command.h"
#include "apps/materials_command.h"
#include "apps/objects_table.h"
#include "apps/render_command.h"
#include "apps/validate_command.h"

namespace {

using namespace fanbeam::apps;

void add_common(CLI::App& command, CommonOptions& common) {
  command.add_flag("-q,--quiet", common.quiet, "Print errors only");
  command.add_option("--log-level", common.log_level, "Least message level shown")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
      ->capture_default_str();
}

void add_render(CLI::App& app, RenderOptions& options, CommonOptions& common) {
  CLI::App* command =
      app.add_subcommand("render", "Render a scene's approach to B-scope and C-scope pictures");
  command
      ->add_option("SCENE", options.scene,
                   "A folder with scene.toml, that file, or the name of a shipped scene")
      ->capture_default_str();
  command->add_option("-o,--output", options.output,
                      "Folder to write to (default out/<scene name>)");
  command->add_option("--frames", options.frames,
                      "A:B[:STEP], counted like a Python slice, or one frame");
  command
      ->add_option("--products", options.products,
                   "Any of bscope, cscope, pair (both side by side), ppi (plan view, track up), "
                   "ppi_north, power (EXR, watts), detections (mask and CSV), "
                   "obstacles (CSV, heights from shadows), preview (video)")
      ->capture_default_str();
  command->add_option("--sensor", options.sensor, "Sensor file instead of the scene's");
  command->add_option("--threads", options.threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(0, 1024));
  CLI::Option* rays = command
                          ->add_option("--rays-per-cell", options.rays_per_cell,
                                       "Rays per range cell and column: more is sharper and slower "
                                       "(default: the scene's, else 4)")
                          ->check(CLI::Range(0.1, 100000.0));
  command
      ->add_flag(
          "--reference", options.reference,
          "Converged sampling: 256 azimuths per column x 8 rays per cell, about 10 s a frame")
      ->excludes(rays);
  command->add_option(
      "--effects", options.effects,
      "all, none, or a list such as +rain,-gas (default: what the scene calls for)");
  command
      ->add_option("--realisation", options.realisation,
                   "mean: expected power; sample: one realisation with speckle and noise "
                   "(default: the scene's)")
      ->check(CLI::IsMember({"mean", "sample"}));
  command->add_option("--seed", options.seed, "Seed of everything random")->capture_default_str();
  command->add_flag("--resume", options.resume,
                    "Keep frames that an earlier run with the same input has finished");
  command->add_option("--preview-format", options.preview_format, "Form of the preview")
      ->check(CLI::IsMember({"mp4", "gif", "apng"}))
      ->capture_default_str();
  command->add_option("--data", options.data,
                      "Folder with terrain and flight data (before FANBEAM_DATA)");
  add_common(*command, common);
}

// A fit's source; how it is looked at is up to the caller.
CLI::App& add_materials_fit(CLI::App& parent, MaterialsOptions& options, MaterialsFitOptions& fit) {
  CLI::App* fit_command =
      parent.add_subcommand("fit", "Fit a, b, c to a model, a table, or a whole library again");
  CLI::Option* model = fit_command->add_option(
      "--model", fit.model,
      "constant-gamma, kulemin, git-land, nrl-sea, oh1992 or rough-metal, with the options that "
      "the keys of a library row are called after");
  fit_command->add_option("--terrain", fit.terrain, "Such as urban, grass, flatland");
  fit_command->add_option("--medium", fit.medium, "Such as concrete or water, of oh1992");
  fit_command->add_option("--permittivity", fit.permittivity, "Real part and loss, of oh1992")
      ->expected(2);
  fit_command->add_option("--sea-state", fit.sea_state, "0 to 6, of nrl-sea");
  fit_command->add_option("--rms-height-mm", fit.rms_height_mm, "Of oh1992 and rough-metal");
  fit_command->add_option("--rms-slope", fit.rms_slope, "Of rough-metal");
  fit_command->add_option("--temperature-C", fit.temperature_C, "Of the medium of oh1992");
  fit_command->add_option("--angles", fit.angles, "Grazing angles of a model's fit")
      ->check(CLI::IsMember({"standard", "steep", "to-normal"}))
      ->capture_default_str();
  CLI::Option* csv = fit_command->add_option(
      "--csv", fit.csv, "Measurements: a CSV file with the columns grazing_deg and sigma0_dB");
  CLI::Option* library = fit_command->add_option(
      "--library", options.library,
      "Print a library's text with all fits made again (default file: the shipped one)");
  library->expected(0, 1);
  model->excludes(csv)->excludes(library);
  csv->excludes(library);
  fit_command->add_flag("--json", options.json, "As JSON");
  fit_command->callback([&fit, library, model, csv] {
    fit.whole_library = library->count() > 0;
    if (!fit.whole_library && model->count() == 0 && csv->count() == 0)
      throw CLI::RequiredError("--model, --csv or --library");
  });
  return *fit_command;
}

// Returns the command; its own subcommands are plot, fit and objects.
CLI::App* add_materials(CLI::App& app, MaterialsOptions& options, MaterialsPlotOptions& plot,
                        MaterialsFitOptions& fit, CommonOptions& common) {
  const auto add_view = [&](CLI::App& command) {
    command.add_option("--frequency", options.frequency_GHz, "GHz")
        ->check(CLI::Range(1.0, 300.0))
        ->capture_default_str();
    command.add_option("--polarisation", options.polarisation, "HH or VV")
        ->check(CLI::IsMember({"HH", "VV"}))
        ->capture_default_str();
    add_common(command, common);
  };
  const auto add_rows = [&](CLI::App& command) {
    command.add_option("--library", options.library, "Library file (default: the shipped one)");
    command.add_option("--state", options.state, "State of the surfaces")
        ->check(CLI::IsMember({"dry", "wet", "dry-snow", "wet-snow"}))
        ->capture_default_str();
  };
  CLI::App* command = app.add_subcommand(
      "materials", "List what the material library holds; plot it; fit the Phong-like form");
  add_rows(*command);
  add_view(*command);
  command->add_flag("--json", options.json, "As JSON");

  CLI::App* plot_command = command->add_subcommand("plot", "sigma0 over grazing angle (gnuplot)");
  plot_command->add_option("-o,--output", plot.output, "A file ending in .svg or .png")->required();
  plot_command->add_option("NAMES", plot.names, "Materials (default: all)");
  add_rows(*plot_command);
  add_view(*plot_command);

  add_view(add_materials_fit(*command, options, fit));
  CLI::App* objects_command =
      command->add_subcommand("objects", "Radar cross-sections of typical objects");
  objects_command->add_option("--library", options.library,
                              "Object library (default: the shipped one)");
  add_common(*objects_command, common);
  return command;
}

void add_atmosphere(CLI::App& app, AtmosphereOptions& options, CommonOptions& common) {
  CLI::App* command = app.add_subcommand(
      "atmosphere", "Loss in air, fog, rain and snow over range, and the echo of what falls");
  command->add_option("SCENE", options.scene, "A scene whose weather and sensor are used");
  command->add_option("--data", options.data,
                      "Folder with terrain and flight data (before FANBEAM_DATA)");
  command
      ->add_option("--frequency", options.frequency_GHz,
                   "GHz, one or more: 35,94 (default: the sensor's)")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 1000.0));
  command
      ->add_option("--compare", options.compare_GHz,
                   "Two frequencies in GHz: their losses and echoes in fog and rain as plots")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(1.0, 1000.0));
  command->add_option("--rain", options.rain_mm_per_h, "Rain rate, mm/h");
  command->add_option("--rain-law", options.rain_law, "itu-p838, georgia-tech-95 or mie");
  command->add_option("--drop-sizes", options.drop_sizes,
                      "marshall-palmer, joss-drizzle or joss-thunderstorm");
  command->add_option("--snow", options.snow_mm_per_h, "Dry snow, mm/h of water");
  CLI::Option* visibility =
      command->add_option("--fog-visibility", options.visibility_m, "Visibility in fog, m");
  command->add_option("--fog-water", options.liquid_water_g_per_m3, "Water in fog, g/m3")
      ->excludes(visibility);
  command->add_option("--fog-top", options.fog_top_m, "Top of the fog above the origin, m");
  command->add_option("--temperature", options.temperature_C, "At the origin, C");
  command->add_option("--humidity", options.humidity, "At the origin, 0 to 1");
  command->add_option("--pressure", options.pressure_hPa, "At the origin, hPa");
  command->add_flag("--vertical", options.vertical, "Vertical polarisation (for the rain law)");
  command->add_option("--height", options.height_m, "Of the antenna above the origin, m")
      ->check(CLI::Range(-2000.0, 12000.0))
      ->capture_default_str();
  command->add_option("--to-height", options.to_height_m, "Where paths end above the origin, m")
      ->check(CLI::Range(-2000.0, 12000.0))
      ->capture_default_str();
  command->add_option("--range", options.range_m, "Farthest range, m")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command->add_option("--step", options.step_m, "Step of range, m")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  CLI::Option* csv = command->add_flag("--csv", options.csv, "Print CSV");
  command->add_flag("--json", options.json, "Print JSON")->excludes(csv);
  command->add_option("-o,--output", options.output, "Folder for plots, CSV and JSON");
  add_common(*command, common);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "fanbeam renders what an airborne imaging millimetre-wave radar sees on an approach.",
      "fanbeam");
  app.set_version_flag("--version", "fanbeam " + version_text() + " (" + commit_text() + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 comparison failed, 2 usage, 3 invalid input, 4 input/output, 5 bug");

  CommonOptions common;
  RenderOptions render_options;
  add_render(app, render_options, common);

  std::string scene = "braunschweig-26";
  std::string data;
  std::string sensor;
  CLI::App* validate_command =
      app.add_subcommand("validate", "Check a scene and report every problem at once");
  validate_command
      ->add_option("SCENE", scene,
                   "A folder with scene.toml, that file, or the name of a shipped scene")
      ->capture_default_str();
  validate_command->add_option("--data", data,
                               "Folder with terrain and flight data (before FANBEAM_DATA)");
  validate_command->add_option("--sensor", sensor, "Sensor file instead of the scene's");
  add_common(*validate_command, common);

  CompareOptions compare_options;
  CLI::App* compare_command =
      app.add_subcommand("compare", "Compare two images or two folders of images");
  compare_command->add_option("A", compare_options.a, "Image or folder")->required();
  compare_command->add_option("B", compare_options.b, "Image or folder")->required();
  compare_command
      ->add_option("--rms", compare_options.rms,
                   "Largest RMS difference allowed: grey levels for PNG, dB for power layers")
      ->capture_default_str();
  compare_command
      ->add_option("--largest", compare_options.largest,
                   "Largest single difference allowed, same units (0: any)")
      ->capture_default_str();
  compare_command
      ->add_option("--percent", compare_options.percent_different,
                   "Largest share of differing cells allowed, per cent")
      ->capture_default_str();
  compare_command->add_flag("--exact", compare_options.exact, "Every value equal");
  add_common(*compare_command, common);

  MaterialsOptions materials_options;
  MaterialsPlotOptions materials_plot;
  MaterialsFitOptions materials_fit;
  CLI::App* materials_command =
      add_materials(app, materials_options, materials_plot, materials_fit, common);

  AtmosphereOptions atmosphere_options;
  add_atmosphere(app, atmosphere_options, common);

  for (CLI::App* command : app.get_subcommands({}))
    command->set_version_flag("--version", "fanbeam " + version_text());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  return run_guarded([&] {
    set_up_log(common);
    if (app.got_subcommand("render")) return render(render_options, common);
    if (materials_command->got_subcommand("plot"))
      return plot_materials(materials_options, materials_plot);
    if (materials_command->got_subcommand("fit"))
      return fit_materials(materials_options, materials_fit);
    if (materials_command->got_subcommand("objects"))
      return list_objects(materials_options.library);
    if (app.got_subcommand("materials")) return list_materials(materials_options);
    if (app.got_subcommand("atmosphere")) return atmosphere(atmosphere_options, common);
    if (app.got_subcommand("validate")) return validate(scene, data, sensor, common);
    return compare(compare_options, common);
  });
}
