// Replacing a whole folder, so that its name only ever holds all of the old or all of the new.
#pragma once

#include <filesystem>
#include <functional>

namespace fanbeam::core {

// Calls `fill` with a new empty folder beside `folder`, exchanges the two in one step (renameat2
// with RENAME_EXCHANGE; file systems without it get two renames, between which the name is missing)
// and removes the old one. Missing parents are made. What a killed program leaves of it,
// remove_abandoned_temporaries (files.h) removes. Whatever `fill` throws comes through, and then
// `folder` is untouched. Throws InputError E-IO with the path and the system's reason.
void replace_folder(const std::filesystem::path& folder,
                    const std::function<void(const std::filesystem::path&)>& fill);

}  // namespace fanbeam::core
