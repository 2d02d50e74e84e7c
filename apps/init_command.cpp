#include "apps/init_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <sstream>
#include <vector>

#include "apps/text_table.h"
#include "core/files.h"
#include "core/text.h"
#include "core/units.h"
#include "scenes/airport/airport.h"
#include "scenes/airport/apt_dat_reader.h"
#include "scenes/airport/runway_csv_reader.h"
#include "scenes/new_scene/new_scene.h"
#include "scenes/new_scene/words.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using core::ErrorClass;

// "47.6660,9.4979,406.6"
std::optional<scenes::AirportRunwayEnd> end_from(const std::string& text, const char* option,
                                                 core::ProblemList& problems) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const core::ParsedNumber number = core::parse_number(part);
    if (number.error != core::NumberError::none) break;
    numbers.push_back(number.value);
  }
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  const auto refuse = [&](const std::string& expected) {
    problems.error(ErrorClass::range, {}, option, "\"" + text + "\"", expected);
    return std::nullopt;
  };
  if (numbers.size() != commas + 1 || numbers.size() < 2 || numbers.size() > 3)
    return refuse("LAT,LON or LAT,LON,HEIGHT_M: degrees and metres with a decimal point");
  if (std::abs(numbers[0]) > 90.0 || std::abs(numbers[1]) > 180.0)
    return refuse(std::abs(numbers[0]) <= 180.0 && std::abs(numbers[1]) <= 90.0
                      ? "the latitude, -90 to 90 deg, before the longitude"
                      : "latitude -90 to 90, longitude -180 to 180 deg");
  if (numbers.size() == 3 && (numbers[2] < -500.0 || numbers[2] > 6000.0))
    return refuse("a height of -500 to 6000 m");
  scenes::AirportRunwayEnd end;
  end.pavement_end = {core::radians(numbers[0]), core::radians(numbers[1]), 0.0};
  if (numbers.size() == 3) end.elevation_m = numbers[2];
  return end;
}

std::optional<scenes::Airport> airport_from_ends(const InitOptions& options,
                                                 core::ProblemList& problems) {
  const auto near = end_from(options.threshold, "--threshold", problems);
  const auto far = end_from(options.far_end, "--far-end", problems);
  const std::string reciprocal = scenes::reciprocal_runway(options.runway);
  if (reciprocal.empty())
    problems.error(ErrorClass::range, {}, "--runway", "\"" + options.runway + "\"",
                   "01 to 36, with L, C or R where there are parallels");
  if (!near || !far || reciprocal.empty()) return std::nullopt;
  scenes::Airport airport;
  airport.ident = options.airport;
  scenes::AirportRunway runway;
  runway.ends[0] = *near;
  runway.ends[0].name = options.runway;
  runway.ends[1] = *far;
  runway.ends[1].name = reciprocal;
  runway.width_m = options.runway_width_m;
  runway.surface = scenes::surface_of_text("");
  airport.runways.push_back(std::move(runway));
  return airport;
}

std::optional<scenes::Airport> find_airport(const InitOptions& options,
                                            core::ProblemList& problems) {
  if (!options.apt_dat.empty())
    return scenes::read_apt_dat(options.apt_dat, options.airport, problems);
  if (!options.runways.empty())
    return scenes::read_runway_csv(options.runways, options.airport, problems);
  return airport_from_ends(options, problems);
}

std::string source_of(const InitOptions& options) {
  const std::string& file = options.apt_dat.empty() ? options.runways : options.apt_dat;
  return file.empty() ? "the command line" : fs::path(file).filename().string();
}

// The scene while nobody can see it yet; goes away with the object.
class Staging {
 public:
  explicit Staging(const fs::path& folder) : path_(core::temporary_beside(folder)) {
    for (fs::path above = folder.parent_path(); !fs::exists(above); above = above.parent_path())
      made_.push_back(above);
    fs::create_directories(folder.parent_path());
    fs::create_directory(path_);
  }
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    for (const fs::path& above : made_) fs::remove(above, ignored);  // those that stayed empty
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  std::vector<fs::path> made_;  // folders around it that were not there, the innermost first
};

// Problems of the staged scene, as those of the folder that it was to become.
std::vector<core::Problem> renamed(std::vector<core::Problem> problems, const fs::path& from,
                                   const fs::path& to) {
  const std::string old_name = from.string();
  for (core::Problem& problem : problems)
    for (std::string* text : {&problem.place.file, &problem.value, &problem.expected})
      for (std::size_t at = 0; (at = text->find(old_name, at)) != std::string::npos;
           at += to.string().size())
        text->replace(at, old_name.size(), to.string());
  return problems;
}

void check_target(const fs::path& folder, const std::string& name, bool overwrite,
                  core::ProblemList& problems) {
  std::error_code unknown;
  const fs::path target = folder / name;
  if (!core::lies_inside(folder, target))
    problems.error(ErrorClass::path, core::Place{target.string()}, "", "leads out of the folder",
                   "a folder without such a link");
  else if (!overwrite && fs::exists(target, unknown))
    problems.error(ErrorClass::io, core::Place{target.string()}, "", "is there already",
                   "a new folder, or --overwrite");
}

// Reads and builds what was staged, exactly as render will.
std::shared_ptr<const scenes::Scene> build_staged(const Staging& staging, const fs::path& folder,
                                                  const InitOptions& options,
                                                  core::ProblemList& problems) {
  std::vector<fs::path> data;
  if (!options.data.empty()) data.emplace_back(options.data);
  core::ProblemList found;
  std::shared_ptr<const scenes::Scene> scene;
  try {
    scene = session::Session(staging.path(), {shipped_folder(), data}, found).scene();
  } catch (const core::InputError& error) {
    problems.append(renamed(error.problems(), staging.path(), folder));
    problems.throw_if_errors();
  }
  problems.append(renamed(found.all(), staging.path(), folder));
  return scene;
}

void put_in_place(const Staging& staging, const fs::path& folder,
                  const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    fs::create_directories((folder / name).parent_path());
    fs::rename(staging.path() / name, folder / name);
  }
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

// Names of all files, scene.toml last.
std::vector<std::string> write_staged(const Staging& staging, const scenes::NewScene& made) {
  std::vector<std::string> names;
  for (const scenes::NewSceneFile& file : made.files) {
    names.push_back(file.name);
    fs::create_directories((staging.path() / file.name).parent_path());
    fs::copy_file(file.from, staging.path() / file.name);
  }
  names.emplace_back("scene.toml");
  core::write_file_atomically(staging.path() / "scene.toml", made.text);
  return names;
}

int make(const InitOptions& options, const CommonOptions& common) {
  fs::path folder = fs::absolute(options.folder).lexically_normal();
  if (folder.filename().empty()) folder = folder.parent_path();
  core::ProblemList problems;
  const scenes::NewSceneRequest request = request_from(options, problems);
  const std::optional<scenes::NewScene> made = scenes::make_new_scene(request, problems);
  // After what the data are judged by, which stops at errors.
  check_target(folder, "scene.toml", options.overwrite, problems);
  check_data_folder(options.data, problems);
  if (made && !common.quiet) print_notes(made->notes);
  if (made)
    for (const scenes::NewSceneFile& file : made->files)
      check_target(folder, file.name, options.overwrite, problems);
  problems.throw_if_errors();

  const Staging staging(folder);
  const std::vector<std::string> names = write_staged(staging, *made);
  std::shared_ptr<const scenes::Scene> scene = build_staged(staging, folder, options, problems);
  put_in_place(staging, folder, names);
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
