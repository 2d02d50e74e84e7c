// What a measured time has to name: the processor and the instructions it ran.
#pragma once

#include <string>

namespace fanbeam::core {

// As the operating system calls it; "unknown" where it does not.
std::string processor_name();

// Level of x86-64 that hot functions run at here (dispatch.h): "x86-64-v4", "x86-64-v3" or
// "x86-64".
std::string instruction_level();

}  // namespace fanbeam::core
