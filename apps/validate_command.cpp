// fanbeam validate: every problem of a scene at once.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/scene_choice.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

CLI::App& declare_validate(CLI::App& program, SceneChoice& options) {
  CLI::App& command =
      *program.add_subcommand("validate", "Check a scene and report every problem at once");
  add_scene_choice(command, options);
  return command;
}

int validate(const SceneChoice& options, const CommonOptions& common) {
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  const auto scene = session::Session(description, {.pictures = false}, problems).scene();
  print_problems(problems.all());
  if (common.quiet) return kExitDone;
  const sensors::Sensor& radar = description.sensor;
  fmt::print("{}: valid\n", description.name);
  fmt::print("  title       {}\n", description.title);
  if (scene->trajectory)
    fmt::print("  frames      {} at {:.3g} Hz, {:.1f} s of flight\n", scene->frame_count(),
               radar.scan.frame_rate_Hz, scene->trajectory->end_s() - scene->trajectory->begin_s());
  else
    fmt::print(
        "  frames      none: no [trajectory]; planned for flights {:.0f} to {:.0f} m above "
        "the origin\n",
        scene->volume.lowest_m, scene->volume.highest_m);
  fmt::print("  surfaces    {} triangles\n", scene->world.surfaces().triangle_count());
  if (scene->raised_buildings > 0)
    fmt::print("  buildings   {} of {} raised parts hang over open air and are left to rays\n",
               scene->floating_buildings, scene->raised_buildings);
  fmt::print("  scatterers  {} points\n", scene->world.targets.size());
  fmt::print("  sensor      {}, {} x {} cells, {:.4g} GHz\n", radar.name, radar.scan.columns,
             radar.range.cells, radar.waveform.frequency_Hz / 1e9);
  if (!radar.waveform.doppler_compensated)
    fmt::print(
        "  pictures    of fanbeam fmcw --products bscope alone: own-ship Doppler shifts ranges\n");
  fmt::print("  caster      {}: {}\n", renderer::name_of(scene->caster.chosen),
             scene->caster.reason);
  fmt::print("  built in    {:.1f} s\n", scene->build_s);
  return kExitDone;
}

}  // namespace

void add_validate(CommandLine& line) { line.add(declare_validate, validate); }

}  // namespace fanbeam::apps
