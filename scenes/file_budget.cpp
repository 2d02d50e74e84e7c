#include "scenes/file_budget.h"

#include <system_error>

#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::scenes {

std::string FileBudget::read(const std::filesystem::path& file, std::uint64_t largest_bytes) {
  std::error_code unreadable;  // read_file will tell
  const std::uint64_t size_bytes = std::filesystem::file_size(file, unreadable);
  if (!unreadable && size_bytes > left_bytes_)
    core::throw_input_error(core::ErrorClass::limit, core::Place{file.string()},
                            "files of all models and buildings",
                            "more than " + std::to_string(kMostBodyFiles_bytes) + " bytes",
                            "at most that, a file counted each time it is placed");
  if (!unreadable) left_bytes_ -= size_bytes;
  files_.insert(file);
  return core::read_file(file, largest_bytes);
}

}  // namespace fanbeam::scenes
