#include "scenes/data_search.h"

#include "core/files.h"

namespace fanbeam::scenes {

namespace fs = std::filesystem;

DataSearch::DataSearch(fs::path scene_folder, std::vector<fs::path> data_folders) {
  folders_.push_back(std::move(scene_folder));
  for (fs::path& folder : data_folders) folders_.push_back(std::move(folder));
}

fs::path DataSearch::find(core::ConfigTable& table, std::string_view key) const {
  const std::size_t before = table.problems().all().size();
  const std::string name = table.required_text(key);
  if (table.problems().all().size() > before) return {};
  return find(name, table.place(key), table.path(key), table.problems());
}

fs::path DataSearch::find(const std::string& name, const core::Place& place,
                          const std::string& field, core::ProblemList& problems) const {
  std::string searched;
  for (const fs::path& folder : folders_) {
    try {
      const fs::path candidate = core::path_inside(folder, name, place, field);
      if (fs::is_regular_file(candidate)) return candidate;
    } catch (const core::InputError& error) {
      problems.append(error.problems());
      return {};
    }
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  problems.error(core::ErrorClass::io, place, field, "\"" + name + "\" not found",
                 "a file in one of: " + searched +
                     "; name another data folder with --data DIR or FANBEAM_DATA");
  return {};
}

fs::path DataSearch::root_of(const fs::path& file) const {
  for (const fs::path& folder : folders_)
    if (core::lies_inside(folder, file)) return fs::weakly_canonical(folder);
  return file.parent_path();
}

}  // namespace fanbeam::scenes
