#include <CLI/CLI.hpp>

#include "apps/atmosphere_command.h"
#include "apps/command_line.h"
#include "apps/compare_command.h"
#include "apps/cost_command.h"
#include "apps/doctor_command.h"
#include "apps/fmcw_command.h"
#include "apps/materials_command.h"
#include "apps/objects_table.h"
#include "apps/plan_command.h"
#include "apps/render_command.h"
#include "apps/track_command.h"
#include "apps/validate_command.h"
#include "apps/waveform_command.h"

using namespace fanbeam::apps;

namespace {

struct ValidateOptions {
  std::string scene = "braunschweig-26";
  std::string data, sensor;
};

void add_validate_command(CLI::App& app, ValidateOptions& options, CommonOptions& common) {
  CLI::App& command =
      *app.add_subcommand("validate", "Check a scene and report every problem at once");
  command
      .add_option("SCENE", options.scene,
                  "A folder with scene.toml, that file, or the name of a shipped scene")
      ->capture_default_str();
  command.add_option("--data", options.data,
                     "Folder with terrain and flight data (before FANBEAM_DATA)");
  command.add_option("--sensor", options.sensor, "Sensor file instead of the scene's");
  add_common_options(command, common);
}

void add_compare_command(CLI::App& app, CompareOptions& options, CommonOptions& common) {
  CLI::App& command = *app.add_subcommand("compare", "Compare two images or two folders of images");
  command.add_option("A", options.a, "Image or folder")->required();
  command.add_option("B", options.b, "Image or folder")->required();
  command
      .add_option("--rms", options.rms,
                  "Largest RMS difference allowed: grey levels for PNG, dB for power layers")
      ->capture_default_str();
  command
      .add_option("--largest", options.largest,
                  "Largest single difference allowed, same units (0: any)")
      ->capture_default_str();
  command
      .add_option("--percent", options.percent_different,
                  "Largest share of differing cells allowed, per cent")
      ->capture_default_str();
  command.add_flag("--exact", options.exact, "Every value equal");
  add_common_options(command, common);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "fanbeam renders what an airborne imaging millimetre-wave radar sees on an approach.",
      "fanbeam");
  app.set_version_flag("--version", "fanbeam " + version_text() + " (" + commit_text() + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 comparison failed, 2 usage, 3 invalid input, 4 input/output, 5 bug\n"
      "doctor: 1 something is wrong; render and fmcw stopped by Ctrl-C or kill: 130 or 143, as "
      "the\n"
      "signal");

  CommonOptions common;
  RenderOptions render_options;
  PlanOptions plan_options;
  ValidateOptions validate_options;
  CompareOptions compare_options;
  MaterialsOptions materials_options;
  MaterialsPlotOptions materials_plot;
  MaterialsFitOptions materials_fit;
  AtmosphereOptions atmosphere_options;
  CostOptions cost_options;
  DoctorOptions doctor_options;
  WaveformOptions waveform_options;
  FmcwOptions fmcw_options;
  TrackOptions track_options;
  add_render_command(app, render_options, common);
  add_plan_command(app, plan_options, common);
  add_validate_command(app, validate_options, common);
  add_compare_command(app, compare_options, common);
  add_materials_command(app, materials_options, materials_plot, materials_fit, common);
  add_atmosphere_command(app, atmosphere_options, common);
  add_cost_command(app, cost_options, common);
  add_doctor_command(app, doctor_options, common);
  add_waveform_command(app, waveform_options, common);
  add_fmcw_command(app, fmcw_options, common);
  add_track_command(app, track_options, common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  return run_guarded([&] {
    set_up_log(common);
    if (app.got_subcommand("render")) return render(render_options, common);
    if (app.got_subcommand("plan")) return explain_plan(plan_options, common);
    if (app.got_subcommand("atmosphere")) return atmosphere(atmosphere_options, common);
    if (app.got_subcommand("validate"))
      return validate(validate_options.scene, validate_options.data, validate_options.sensor,
                      common);
    if (app.got_subcommand("cost")) return cost(cost_options, common);
    if (app.got_subcommand("doctor")) return examine_scene(doctor_options, common);
    if (app.got_subcommand("fmcw")) return fmcw(fmcw_options, common);
    if (app.got_subcommand("track")) return track(track_options, common);
    if (app.got_subcommand("waveform")) return waveform(waveform_options, common);
    if (app.got_subcommand("compare")) return compare(compare_options, common);
    const CLI::App& materials = *app.get_subcommand("materials");
    if (materials.got_subcommand("plot")) return plot_materials(materials_options, materials_plot);
    if (materials.got_subcommand("fit")) return fit_materials(materials_options, materials_fit);
    if (materials.got_subcommand("objects")) return list_objects(materials_options.library);
    return list_materials(materials_options);
  });
}
