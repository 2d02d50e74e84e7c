#include "session/shipped.h"

#include <algorithm>
#include <system_error>

#include "core/spelling.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

bool holds_shipped_files(const fs::path& folder) {
  return fs::is_regular_file(folder / "materials" / "library.toml") &&
         fs::is_regular_file(folder / "sensors" / "hivision.toml");
}

// Names of the folders in `folder` that hold a scene, sorted; none where it cannot be read.
std::vector<std::string> scenes_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code refused;
  for (fs::directory_iterator entry(folder, refused), end; !refused && entry != end;
       entry.increment(refused))
    if (std::error_code status; fs::is_regular_file(entry->path() / "scene.toml", status))
      names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// " b a c": those that look most like `wanted` first.
std::string nearest_first(const std::string& wanted, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : core::nearest_names(wanted, names, names.size()))
    text += " " + name;
  return text;
}

}  // namespace

fs::path shipped_above(const fs::path& file) {
  for (fs::path folder = file.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (holds_shipped_files(folder / "share" / "fanbeam")) return folder / "share" / "fanbeam";
    if (holds_shipped_files(folder)) return folder;
  }
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "shipped files",
                          "not found", "share/fanbeam above it, or a source tree around it");
}

std::vector<std::string> shipped_scenes(const fs::path& shipped) {
  return scenes_in(shipped / "scenes");
}

std::vector<std::string> shipped_sensors(const fs::path& shipped) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(shipped / "sensors"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find_scene(const fs::path& name, const fs::path& shipped, const fs::path& beside) {
  std::error_code refused;  // such as a name too long to be one
  for (const fs::path& candidate : {beside / name, shipped / name, shipped / "scenes" / name})
    if (fs::is_regular_file(candidate, refused) || fs::exists(candidate / "scene.toml", refused))
      return candidate;
  std::vector<std::string> there = scenes_in(beside.empty() ? fs::path(".") : beside);
  for (const std::string& scene : shipped_scenes(shipped)) there.push_back(scene);
  core::throw_input_error(
      core::ErrorClass::io, "scene", "\"" + name.string() + "\" not found",
      "a folder with scene.toml, or one of the scenes:" + nearest_first(name.string(), there));
}

fs::path find_sensor(const fs::path& name, const fs::path& shipped, const std::string& field,
                     const fs::path& beside) {
  std::error_code refused;
  for (const fs::path& candidate : {beside / name, shipped / "sensors" / (name.string() + ".toml")})
    if (fs::is_regular_file(candidate, refused)) return candidate;
  core::throw_input_error(core::ErrorClass::io, field, "\"" + name.string() + "\" not found",
                          "a sensor file, or one of the shipped sensors:" +
                              nearest_first(name.string(), shipped_sensors(shipped)));
}

void check_data_folder(const fs::path& folder, const std::string& field,
                       core::ProblemList& problems) {
  std::error_code refused;
  if (!fs::is_directory(folder, refused))
    problems.error(core::ErrorClass::io, {}, field, "\"" + folder.string() + "\"",
                   "a folder that exists, with terrain and flight data");
}

}  // namespace fanbeam::session
