// A new scene in its folder: written beside it, read and built there as any program will, and only then
// given its name: one that cannot be built leaves nothing behind.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scenes/new_scene/new_scene.h"
#include "session/session.h"

namespace fanbeam::session {

// Inside the scene's folder, scene.toml last.
std::vector<std::string> new_scene_files(const scenes::NewScene& made);

// E-PATH for each of the files that links lead out of the folder, E-IO for each that is there unless
// `overwrite`.
void check_new_files(const std::filesystem::path& folder, const std::vector<std::string>& files,
                     bool overwrite, core::ProblemList& problems);

// The scene as built. What it is warned of is added to `problems`, by the names that its files get. `folder` is
// absolute; folders above it are made. Throws InputError with all problems where the scene cannot be built,
// std::filesystem::filesystem_error.
std::shared_ptr<const scenes::Scene> put_new_scene(const scenes::NewScene& made,
                                                   const std::filesystem::path& folder,
                                                   const Setup& setup, core::ProblemList& problems);

}  // namespace fanbeam::session
