#define CATCH_CONFIG_RUNNER
#include <tbb/global_control.h>

#include <catch2/catch.hpp>

#include "tests/fp_traps.h"

int main(int argc, char** argv) {
  // As a host program may: limits of up to eight threads mean as many, also on fewer cores.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  fanbeam::tests::set_fp_traps_as_asked();
  return Catch::Session().run(argc, argv);
}
