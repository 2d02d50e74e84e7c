// The names of what ships with the program, as the command line takes them.
#pragma once

#include <string>
#include <vector>

namespace fanbeam::apps {

// Sorted. Throw InputError E-IO as shipped_folder.
std::vector<std::string> shipped_scenes();   // folders of scenes/ with a scene.toml
std::vector<std::string> shipped_sensors();  // files of sensors/, without .toml

// " b a c": names for a message, those that look most like `wanted` first.
std::string nearest_first(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace fanbeam::apps
