// An 8-bit grey picture as the bytes of a file, for whoever sends it instead of keeping it. Carries
// no metadata. The same picture gives the same bytes.
#pragma once

#include <string>

#include "core/image.h"

namespace fanbeam::core {

std::string png_bytes(const Picture8& picture);

// For players that know nothing else; speckle leaves it 3 grey levels RMS from the picture at its
// quality of 90.
std::string jpeg_bytes(const Picture8& picture);

}  // namespace fanbeam::core
