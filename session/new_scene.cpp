#include "session/new_scene.h"

#include <system_error>

#include "core/files.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

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

void write_staged(const Staging& staging, const scenes::NewScene& made) {
  for (const scenes::NewSceneFile& file : made.files) {
    fs::create_directories((staging.path() / file.name).parent_path());
    fs::copy_file(file.from, staging.path() / file.name);
  }
  core::write_file_atomically(staging.path() / "scene.toml", made.text);
}

// Reads and builds what was staged, exactly as render will.
std::shared_ptr<const scenes::Scene> build_staged(const Staging& staging, const fs::path& folder,
                                                  const Setup& setup, core::ProblemList& problems) {
  core::ProblemList found;
  std::shared_ptr<const scenes::Scene> scene;
  try {
    scene = Session(staging.path(), setup, found).scene();
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

}  // namespace

std::vector<std::string> new_scene_files(const scenes::NewScene& made) {
  std::vector<std::string> names;
  for (const scenes::NewSceneFile& file : made.files) names.push_back(file.name);
  names.emplace_back("scene.toml");
  return names;
}

void check_new_files(const fs::path& folder, const std::vector<std::string>& files, bool overwrite,
                     core::ProblemList& problems) {
  std::error_code unknown;
  for (const std::string& name : files) {
    const fs::path file = folder / name;
    if (!core::lies_inside(folder, file))
      problems.error(core::ErrorClass::path, core::Place{file.string()}, "",
                     "leads out of the folder", "a folder without such a link");
    else if (!overwrite && fs::exists(file, unknown))
      problems.error(core::ErrorClass::io, core::Place{file.string()}, "", "is there already",
                     "a new folder, or --overwrite");
  }
}

std::shared_ptr<const scenes::Scene> put_new_scene(const scenes::NewScene& made,
                                                   const fs::path& folder, const Setup& setup,
                                                   core::ProblemList& problems) {
  const Staging staging(folder);
  write_staged(staging, made);
  std::shared_ptr<const scenes::Scene> scene = build_staged(staging, folder, setup, problems);
  put_in_place(staging, folder, new_scene_files(made));
  return scene;
}

}  // namespace fanbeam::session
