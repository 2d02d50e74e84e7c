#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "tests/fp_traps.h"

int main(int argc, char** argv) {
  fanbeam::tests::set_fp_traps_as_asked();
  return Catch::Session().run(argc, argv);
}
