// Files of a run in one archive.
#include "datasets/run_files.h"

#include <catch2/catch.hpp>

#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;

TEST_CASE("An archive that the disk has no room for says so", "[run_files]") {
  const tests::TemporaryFolder folder;
  folder.write("run.json", "{}");
  CHECK_THROWS_WITH(
      datasets::pack(folder.path(), {"run.json"}, "/dev/full"),
      Catch::Contains("/dev/full: E-IO archive = ") && Catch::Contains("No space left on device"));
}
