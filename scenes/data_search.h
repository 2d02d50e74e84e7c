// Finding the files that a scene names: inside its own folder first, then in the data folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config_table.h"
#include "core/errors.h"

namespace fanbeam::scenes {

class DataSearch {
 public:
  // `data_folders` in the order of preference.
  DataSearch(std::filesystem::path scene_folder, std::vector<std::filesystem::path> data_folders);

  // The file that `key` of `table` names, or an empty path after reporting: E-PATH when the name
  // leaves every folder it is looked up in, E-IO with all places searched and what to set when it
  // is nowhere.
  std::filesystem::path find(core::ConfigTable& table, std::string_view key) const;

  // The same for a name that stands at `place` in the field `field`.
  std::filesystem::path find(const std::string& name, const core::Place& place,
                             const std::string& field, core::ProblemList& problems) const;

  // The folder that `file` was found in: models may only read files inside it.
  std::filesystem::path root_of(const std::filesystem::path& file) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace fanbeam::scenes
