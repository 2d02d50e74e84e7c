// An 8-bit grey picture as the bytes of a PNG file, for whoever sends it instead of keeping it.
#pragma once

#include <string>

#include "core/image.h"

namespace fanbeam::core {

// Carries no metadata. The same picture gives the same bytes.
std::string png_bytes(const Picture8& picture);

}  // namespace fanbeam::core
