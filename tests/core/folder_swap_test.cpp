#include "core/folder_swap.h"

#include <catch2/catch.hpp>
#include <set>
#include <stdexcept>
#include <string>

#include "core/errors.h"
#include "core/files.h"
#include "tests/core/left_temporary.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

}  // namespace

TEST_CASE("A folder is replaced as a whole: nothing of the old one stays", "[files]") {
  const tests::TemporaryFolder folder;
  const fs::path target = folder.path() / "deep" / "pictures";
  core::replace_folder(target, [](const fs::path& made) {
    core::write_file_atomically(made / "old.txt", "old");
    core::write_file_atomically(made / "both.txt", "old");
  });
  CHECK(names_in(target) == std::set<std::string>{"old.txt", "both.txt"});
  core::replace_folder(target, [&](const fs::path& made) {
    core::write_file_atomically(made / "both.txt", "new");
    CHECK(core::read_file(target / "both.txt", 99) == "old");  // until all is there
  });
  CHECK(names_in(target) == std::set<std::string>{"both.txt"});
  CHECK(core::read_file(target / "both.txt", 99) == "new");
  CHECK(names_in(target.parent_path()) == std::set<std::string>{"pictures"});
}

TEST_CASE("A folder whose replacement fails half way is what it was", "[files]") {
  const tests::TemporaryFolder folder;
  const fs::path target = folder.path() / "pictures";
  core::replace_folder(
      target, [](const fs::path& made) { core::write_file_atomically(made / "a.txt", "old"); });
  CHECK_THROWS_AS(core::replace_folder(target,
                                       [](const fs::path& made) {
                                         core::write_file_atomically(made / "a.txt", "new");
                                         throw std::runtime_error("disk full");
                                       }),
                  std::runtime_error);
  CHECK(core::read_file(target / "a.txt", 99) == "old");
  CHECK(names_in(folder.path()) == std::set<std::string>{"pictures"});
}

TEST_CASE("What a killed program left of a replacement is removed with all that is in it",
          "[files]") {
  const tests::TemporaryFolder folder;
  const fs::path left = tests::temporary_of(99999999, folder.path() / "pictures");
  core::write_file_atomically(left / "bscope" / "00000.png", "half");
  core::remove_abandoned_temporaries(folder.path());
  CHECK(names_in(folder.path()).empty());
}
