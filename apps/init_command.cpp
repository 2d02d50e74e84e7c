#include "apps/init_command.h"

#include <fmt/core.h>

#include <iostream>
#include <vector>

#include "apps/text_table.h"
#include "core/text.h"
#include "scenes/airport/apt_dat_reader.h"
#include "scenes/airport/runway_csv_reader.h"
#include "scenes/airport/runway_ends.h"
#include "session/new_scene.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

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

}  // namespace fanbeam::apps
