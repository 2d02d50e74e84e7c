// A look at the head of an OpenEXR file before the library sees it: the library takes memory for every length
// that stands there.
#pragma once

#include <filesystem>
#include <functional>

#include "core/png_check.h"

namespace fanbeam::core {

// Walks the attributes of all parts and checks their lengths, and those inside of string lists and previews,
// against the file's (openexr.com, "OpenEXR File Layout"). `accept` gets the size of each data window, and may
// throw. False, and nothing checked, where the file does not begin as an OpenEXR file does. Throws InputError:
// E-PARSE with the byte where the head is damaged or ends too early, E-IO.
bool check_exr(const std::filesystem::path& path,
               const std::function<void(const ClaimedSize&)>& accept);

}  // namespace fanbeam::core
