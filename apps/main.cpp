#include <CLI/CLI.hpp>

#include "apps/compare_command.h"
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
                   "ppi_north, power (EXR, watts), detections (mask and CSV), preview (video)")
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
    if (app.got_subcommand("validate")) return validate(scene, data, sensor, common);
    return compare(compare_options, common);
  });
}
