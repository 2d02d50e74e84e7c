#include "apps/shipped_names.h"

#include <algorithm>
#include <filesystem>

#include "apps/common.h"
#include "core/spelling.h"

namespace fanbeam::apps {

namespace fs = std::filesystem;

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(shipped_folder() / "scenes"))
    if (fs::is_regular_file(entry.path() / "scene.toml"))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> shipped_sensors() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(shipped_folder() / "sensors"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string nearest_first(const std::string& wanted, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : core::nearest_names(wanted, names, names.size()))
    text += " " + name;
  return text;
}

}  // namespace fanbeam::apps
