#include "core/folder_swap.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <system_error>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::core {
namespace {

namespace fs = std::filesystem;

void throw_if(const std::error_code& status, const fs::path& path) {
  if (status)
    throw_input_error(ErrorClass::io, Place{path.string()}, "", status.message(),
                      "a folder that can be replaced");
}

// Leaves the old folder, if any, under the name of the new one.
void exchange(const fs::path& made, const fs::path& folder) {
  std::error_code status;
  if (!fs::exists(fs::symlink_status(folder))) {
    fs::rename(made, folder, status);
    return throw_if(status, folder);
  }
  if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) return;
  const fs::path aside = temporary_beside(folder);
  fs::rename(folder, aside, status);
  throw_if(status, folder);
  fs::rename(made, folder, status);
  if (status) {
    std::error_code back;
    fs::rename(aside, folder, back);
    throw_if(status, folder);
  }
  fs::rename(aside, made, status);
  throw_if(status, aside);
}

}  // namespace

void replace_folder(const fs::path& folder, const std::function<void(const fs::path&)>& fill) {
  std::error_code status;
  const fs::path temporary = temporary_beside(folder);
  fs::create_directories(temporary, status);
  throw_if(status, folder);
  try {
    fill(temporary);
    exchange(temporary, folder);
  } catch (...) {
    fs::remove_all(temporary, status);
    throw;
  }
  fs::remove_all(temporary, status);  // what was there before
}

}  // namespace fanbeam::core
