// Where the files that ship with fanbeam lie, and how scenes and sensors are named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"

namespace fanbeam::session {

// The folder with scenes/, sensors/ and materials/: share/fanbeam beside what is installed, the
// source tree around a build; looked for from `file` upwards. Throws InputError E-IO where neither
// is there.
std::filesystem::path shipped_above(const std::filesystem::path& file);

// Sorted. Throw std::filesystem::filesystem_error where the folder cannot be read.
std::vector<std::string> shipped_scenes(const std::filesystem::path& shipped);
std::vector<std::string> shipped_sensors(const std::filesystem::path& shipped);

// A folder with scene.toml, that file, or the name of a shipped scene ("braunschweig-26",
// "scenes/braunschweig-26"). A relative name is looked for in the folder `beside` first, which a file that
// names it gives; empty: the working directory. Throws InputError E-IO with the names there are.
std::filesystem::path find_scene(const std::filesystem::path& name,
                                 const std::filesystem::path& shipped,
                                 const std::filesystem::path& beside = {});

// A sensor file, or the name of a shipped sensor ("hivision-94"); `beside` as above. Throws InputError
// E-IO, about `field`.
std::filesystem::path find_sensor(const std::filesystem::path& name,
                                  const std::filesystem::path& shipped, const std::string& field,
                                  const std::filesystem::path& beside = {});

// Whose data is looked at first. E-IO, about `field`, where it is no folder.
void check_data_folder(const std::filesystem::path& folder, const std::string& field,
                       core::ProblemList& problems);

}  // namespace fanbeam::session
