// What stands for an option's value in help and man pages where its type alone says too little.
// Shell completion offers the scenes, sensors, materials, files or folders there are.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace fanbeam::apps {

inline constexpr const char* kSceneValue = "SCENE";
inline constexpr const char* kSensorValue = "SENSOR";
inline constexpr const char* kMaterialValue = "MATERIAL";
inline constexpr const char* kCommandValue = "COMMAND";
inline constexpr const char* kFramesValue = "FRAMES";
inline constexpr const char* kFileValue = "FILE";
inline constexpr const char* kInputValue = "INPUT";  // a scene, a file or a folder
inline constexpr const char* kFolderValue = "FOLDER";

inline constexpr const char* kOffered = "list ";  // begins the description of `offers`

// For an option that takes a comma-separated list: completion offers these. Checks nothing.
inline CLI::Validator offers(const std::vector<std::string>& names) {
  return {[](const std::string&) { return std::string(); },
          kOffered + CLI::detail::generate_set(names)};
}

}  // namespace fanbeam::apps
