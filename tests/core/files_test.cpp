// Reading with a cap, writing whole files or nothing, and paths that must stay inside their folder
// (F05, F17).
#include "core/files.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/errors.h"
#include "tests/core/file_checks.h"
#include "tests/core/left_temporary.h"

using namespace fanbeam::core;
using fanbeam::tests::code_of;
using fanbeam::tests::entries;
namespace fs = std::filesystem;

namespace {

// An empty folder of its own for a test case.
class Scratch {
 public:
  Scratch() : folder_(fs::path(FANBEAM_BINARY_DIR) / "files_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const std::string& name) const { return folder_ / name; }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

}  // namespace

TEST_CASE("What is written is what is read, zero bytes and line ends included", "[files]") {
  const Scratch scratch;
  const std::string bytes("a\0b\r\nc\xff", 7);
  write_file_atomically(scratch / "deep/er/file.bin", bytes);
  CHECK(read_file(scratch / "deep/er/file.bin", 7) == bytes);
  write_file_atomically(scratch / "deep/er/file.bin", "new");
  CHECK(read_file(scratch / "deep/er/file.bin", 7) == "new");
  CHECK(entries(scratch / "deep/er") == 1);
}

TEST_CASE("Reading refuses what is too large, missing or a folder", "[files]") {
  const Scratch scratch;
  write_file_atomically(scratch / "eight", "12345678");
  CHECK(code_of([&] { read_file(scratch / "eight", 8); }) == "accepted");
  CHECK(code_of([&] { read_file(scratch / "eight", 7); }) == "E-LIMIT");
  CHECK(code_of([&] { read_file(scratch / "missing", 8); }) == "E-IO");
  CHECK(code_of([&] { read_file(scratch.folder(), 8); }) == "E-IO");
}

// A pipe that nobody writes to: opening it would never end.
TEST_CASE("What is no file is told as such and not opened", "[files]") {
  const Scratch scratch;
  write_file_atomically(scratch / "two", "12");
  REQUIRE(::mkfifo((scratch / "pipe").c_str(), 0600) == 0);
  ProblemList problems;
  std::string bytes;
  CHECK(open_file(scratch / "two", problems) >> bytes);
  CHECK(bytes == "12");
  CHECK(problems.all().empty());
  for (const fs::path& none : {scratch / "pipe", scratch.folder(), scratch / "missing"})
    CHECK_FALSE(open_file(none, problems).is_open());
  REQUIRE(problems.all().size() == 3);
  for (const Problem& problem : problems.all()) CHECK(problem.code == "E-IO");
  CHECK(problems.all()[0].value == "not a file");
  CHECK(problems.all()[0].place.file == (scratch / "pipe").string());
  CHECK(problems.all()[1].value == "not a file");
  CHECK(problems.all()[2].value == "No such file or directory");
}

TEST_CASE("The size is checked before memory is asked for", "[files]") {
  const Scratch scratch;
  write_file_atomically(scratch / "sparse", "");
  fs::resize_file(scratch / "sparse",
                  std::uintmax_t{1} << 40U);  // a terabyte that occupies nothing
  CHECK(code_of([&] { read_file(scratch / "sparse", 1U << 20U); }) == "E-LIMIT");
}

TEST_CASE("A writer that fails leaves the old file and no temporary one", "[files]") {
  const Scratch scratch;
  write_file_atomically(scratch / "picture.png", "old");
  CHECK_THROWS_AS(write_atomically(scratch / "picture.png",
                                   [](const fs::path& temporary) {
                                     CHECK(temporary.extension() == ".png");
                                     std::ofstream(temporary) << "half";
                                     throw std::runtime_error("disk full");
                                   }),
                  std::runtime_error);
  CHECK(read_file(scratch / "picture.png", 100) == "old");
  CHECK(entries(scratch.folder()) == 1);
}

TEST_CASE("The final name never holds a part of a file", "[files]") {
  const Scratch scratch;
  write_atomically(scratch / "run.json", [&](const fs::path& temporary) {
    std::ofstream(temporary) << "{";
    CHECK_FALSE(fs::exists(scratch / "run.json"));
  });
  CHECK(fs::exists(scratch / "run.json"));
}

TEST_CASE(
    "What another machine writes into a shared folder is not abandoned because this one has no "
    "such process",
    "[files]") {
  const Scratch scratch;
  constexpr pid_t kNobody = 99999999;
  const fs::path own = fanbeam::tests::temporary_of(kNobody, scratch / "00000.png");
  const fs::path other = scratch / ".00001.00c0ffee-99999999.0.tmp.png";
  const fs::path of_old_version = scratch / ".00002.99999999.0.tmp.png";
  for (const fs::path& file : {own, other, of_old_version}) std::ofstream(file) << "half";
  remove_abandoned_temporaries(scratch.folder());
  CHECK_FALSE(fs::exists(own));
  CHECK(fs::exists(other));
  CHECK(fs::exists(of_old_version));
  for (const fs::path& file : {other, of_old_version})
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(25));
  remove_abandoned_temporaries(scratch.folder());
  CHECK(entries(scratch.folder()) == 0);
}

TEST_CASE("A name as long as a file's may be can be written", "[files]") {
  const Scratch scratch;
  const std::string name = std::string(251, 'a') + ".png";
  write_file_atomically(scratch / name, "x");
  CHECK(read_file(scratch / name, 1) == "x");
  CHECK(temporary_beside(scratch / name).filename().string().size() == 255);
}

TEST_CASE("F17 a place that cannot be written to is told with its path", "[files][F17]") {
  const Scratch scratch;
  write_file_atomically(scratch / "file", "not a folder");
  CHECK(code_of([&] { write_file_atomically(scratch / "file/below", "x"); }) == "E-IO");
  fs::create_directories(scratch / "folder/inside");
  CHECK(code_of([&] { write_file_atomically(scratch / "folder", "x"); }) == "E-IO");
  CHECK(read_file(scratch / "file", 100) == "not a folder");
  CHECK(entries(scratch.folder()) == 2);
  CHECK(code_of([] { write_file_atomically("/proc/no_such_folder/x", "x"); }) == "E-IO");
}

TEST_CASE("F05 paths inside the folder resolve, with detours that come back", "[files][F05]") {
  const Scratch scratch;
  fs::create_directories(scratch / "models");
  const fs::path root = fs::canonical(scratch.folder());
  const Place place{"scene.toml", 3, 1};
  CHECK(path_inside(scratch.folder(), "models/truck.glb", place, "file") ==
        root / "models/truck.glb");
  CHECK(path_inside(scratch.folder(), "models/../dem.tif", place, "file") == root / "dem.tif");
  CHECK(path_inside(scratch.folder(), "./with space.tif", place, "file") ==
        root / "with space.tif");
  CHECK(path_inside(scratch.folder(), "..almost.tif", place, "file") == root / "..almost.tif");
  CHECK(path_inside(scratch.folder(), "flight_08:30.csv", place, "file") ==
        root / "flight_08:30.csv");
  fs::create_symlink("models", scratch / "link");
  CHECK(path_inside(scratch.folder(), "link/truck.glb", place, "file") ==
        root / "models/truck.glb");
}

TEST_CASE("F05 what lies in a folder is told with all links followed", "[files][F05]") {
  const Scratch scratch;
  fs::create_directories(scratch / "scene/models");
  fs::create_directories(scratch / "scene-secrets");
  write_file_atomically(scratch / "scene/dem.tif", "x");
  fs::create_symlink("/etc/hostname", scratch / "scene/dem.prj");
  fs::create_symlink("dem.tif", scratch / "scene/same.tif");
  fs::create_symlink("../scene-secrets", scratch / "scene/neighbour");
  fs::create_symlink("loop", scratch / "scene/loop");
  fs::create_symlink("scene", scratch / "other-name");
  const fs::path scene = scratch / "scene";
  fs::create_hard_link(scene / "dem.tif", scratch / "second.tif");
  CHECK(lies_inside(scene / "dem.tif", scratch / "second.tif"));
  CHECK(lies_inside(scene / "dem.tif", scene / "same.tif"));
  CHECK_FALSE(lies_inside(scene, scratch / "second.tif"));
  for (const char* name : {"", "dem.tif", "same.tif", "models/none.glb", "models/../dem.tif"}) {
    INFO(name);
    CHECK(lies_inside(scene, scene / name));
    CHECK(lies_inside(scratch / "other-name", scene / name));
  }
  for (const char* name :
       {"dem.prj", "neighbour", "neighbour/key", "..", "../scene-secrets", "loop"}) {
    INFO(name);
    CHECK_FALSE(lies_inside(scene, scene / name));
  }
}

TEST_CASE("F05 paths outside the folder are refused with place and field", "[files][F05]") {
  const Scratch scratch;
  const fs::path scene = scratch / "scene";
  fs::create_directories(scene);
  fs::create_directories(scratch / "scene-secrets");
  fs::create_symlink("/etc", scene / "etc");
  fs::create_symlink("../scene-secrets", scene / "neighbour");
  for (const std::string& bad :
       {std::string("/etc/passwd"), std::string("../secret"), std::string("a/../../secret"),
        std::string("../scene-secrets/key"), std::string("etc/passwd"),
        std::string("neighbour/key"), std::string("file:///etc/passwd"),
        std::string("http://host/a.bin"), std::string("data:text/plain,x"), std::string(""),
        std::string("a\0b", 3)}) {
    INFO("path: " << bad);
    CHECK(code_of([&] {
            path_inside(scene, bad, {"scene.toml", 3, 1}, "model.file");
          }) == "E-PATH");
  }
  try {
    path_inside(scene, "../secret", {"scene.toml", 3, 1}, "model.file");
  } catch (const InputError& error) {
    CHECK(
        std::string(error.what()).starts_with("scene.toml:3:1: E-PATH model.file = \"../secret\""));
  }
}

TEST_CASE("How a file begins is told of what there is of it", "[files]") {
  const Scratch scratch;
  std::ofstream(scratch / "table.csv") << "time_s,beat\n0,1\n";
  std::ofstream(scratch / "short.csv") << "time_s";
  CHECK(file_begins_with(scratch / "table.csv", "time_s,beat\n"));
  CHECK_FALSE(file_begins_with(scratch / "table.csv", "time_s,other\n"));
  CHECK_FALSE(file_begins_with(scratch / "short.csv", "time_s,beat\n"));
  CHECK_FALSE(file_begins_with(scratch / "none.csv", "time_s"));
  CHECK_FALSE(file_begins_with(scratch.folder(), "time_s"));
}
