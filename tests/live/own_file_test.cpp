// What a flight may write to.
#include "live/own_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;

// Opening it waited for whoever reads, and Ctrl-C ended nothing.
TEST_CASE("A pipe is no file of a flight's own, and is refused at once; a device is taken",
          "[own_file]") {
  const tests::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  for (const bool is_read : {false, true}) {
    INFO(is_read);
    const int reader = is_read ? ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK) : -1;
    REQUIRE((reader >= 0) == is_read);
    std::vector<core::Problem> problems;
    try {
      const live::OwnFile taken(pipe, "--record", "a file");
    } catch (const core::InputError& error) {
      problems = error.problems();
    }
    if (is_read) ::close(reader);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == "E-IO");
    CHECK(problems[0].value == "not a file");
    CHECK(problems[0].field == "--record");
    CHECK(problems[0].place.file == pipe.string());
  }
  CHECK(std::filesystem::is_fifo(pipe));  // it stays
  live::OwnFile device("/dev/null", "--record", "a file");
  device.begin();
  device.write("bytes");
  CHECK((::fcntl(device.descriptor(), F_GETFL) & O_NONBLOCK) == 0);
  device.close();
}
