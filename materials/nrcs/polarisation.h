// The polarisation of the core under the name this folder uses.
#pragma once

#include "core/polarisation.h"

namespace fanbeam::materials {

using core::Polarisation;

}  // namespace fanbeam::materials
