// What a process that ended while it wrote leaves of write_atomically.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/files.h"

namespace fanbeam::tests {

// The name that a process of this machine gives to what is to become `path`. None has an id above 2^22.
inline std::filesystem::path temporary_of(pid_t process, const std::filesystem::path& path) {
  std::string name = core::temporary_beside(path).string();
  const std::string own = "-" + std::to_string(getpid()) + ".";
  name.replace(name.rfind(own), own.size(), "-" + std::to_string(process) + ".");
  return name;
}

}  // namespace fanbeam::tests
