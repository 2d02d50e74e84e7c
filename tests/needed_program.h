// Programs that a test calls and that some machines lack.
#pragma once

#include <cstdlib>
#include <string>

#include "tests/skipped.h"

namespace fanbeam::tests {

// Whether it is there; where it is not, the test is to skip, which has been told.
inline bool needed_program(const std::string& name) {
  if (std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0) return true;
  skipped("the program " + name);
  return false;
}

}  // namespace fanbeam::tests
