// The pictures of a folder.
#pragma once

#include <filesystem>
#include <set>

#include "core/errors.h"

namespace fanbeam::measure {

// PNG and EXR below it, relative to it, links that lead nowhere too (whoever reads them tells); none where
// there is no such folder. Throws InputError E-IO where it cannot be read.
inline std::set<std::filesystem::path> image_files_below(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::set<fs::path> images;
  std::error_code status;
  for (fs::recursive_directory_iterator entry(folder, status), end; !status && entry != end;
       entry.increment(status)) {
    const fs::path ending = entry->path().extension();
    std::error_code dangling;
    if ((ending == ".png" || ending == ".exr") && !entry->is_directory(dangling))
      images.insert(entry->path().lexically_relative(folder));
  }
  if (status && fs::exists(folder))
    core::throw_input_error(core::ErrorClass::io, core::Place{folder.string()}, "",
                            status.message(), "a folder that can be read");
  return images;
}

}  // namespace fanbeam::measure
