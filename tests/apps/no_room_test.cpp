// Hard case F17: a full disk, a folder that is read-only, missing or a file, and writing that is
// interrupted. A final name only ever holds a complete file, and the program says that it failed.
#include <unistd.h>

#include <algorithm>

#include "tests/apps/child.h"
#include "tests/apps/program.h"
#include "tests/needed_program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;

// Pictures of 4, 23 and 180 kB.
const std::string kRender =
    "render obstacle-field --frames 100:160:20 --rays-per-cell 1 -q --products bscope,power,ppi ";

Files rendered(const fs::path& folder, const std::string& more = "") {
  const Result result = run_fanbeam(kRender + more + " -o " + quoted(folder));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return results(folder);
}

// Without folders, and without the files in the making that a killed program leaves behind.
Files finished(const Files& all) {
  Files files;
  for (const auto& [name, bytes] : all)
    if (fs::path(name).filename().string().front() != '.' && fs::path(name).has_extension())
      files.emplace(name, bytes);
  return files;
}

// Every file is one of `whole` to the last byte, or untouched since `before`. Answers how many are
// of `whole`.
std::size_t check_complete(const Files& found, const Files& whole, const Files& before = {}) {
  std::size_t complete = 0;
  for (const auto& [name, bytes] : found) {
    INFO(name << ", " << bytes.size() << " bytes");
    const bool is_whole = whole.count(name) == 1 && whole.at(name) == bytes;
    const bool is_old = before.count(name) == 1 && before.at(name) == bytes;
    CHECK((is_whole || is_old));
    complete += is_whole ? 1 : 0;
  }
  return complete;
}

std::size_t size_of(const Files& files) {
  std::size_t bytes = 0;
  for (const auto& [name, content] : files) bytes += content.size();
  return bytes;
}

// A shell with file systems of its own, which vanish with it.
const std::string kOwnMounts = "unshare --map-root-user --mount sh -c ";

bool can_mount() {
  if (std::system((kOwnMounts + "'mount -t tmpfs none /mnt' >/dev/null 2>&1").c_str()) == 0)
    return true;
  skipped("user namespaces or root rights, for a small disk");
  return false;
}

// Renders onto a disk of `kilobytes` that holds `before`, and copies what is there afterwards. The
// disk is made read-only first if asked.
Result render_onto_disk(const fs::path& scratch, std::size_t kilobytes, const fs::path& before,
                        bool read_only, Files& after, const std::string& command = kRender) {
  const fs::path disk = scratch / "disk", copy = scratch / "copy";
  fs::create_directories(disk);
  fs::remove_all(copy);
  std::ofstream(scratch / "on_disk.sh")
      << "mount -t tmpfs -o size=" << kilobytes << "k none " << quoted(disk) << " || exit 99\n"
      << (before.empty() ? "" : "cp -a " + quoted(before / ".") + " " + quoted(disk) + "\n")
      << (read_only ? "mount -o remount,ro " + quoted(disk) + "\n" : "")
      << "'" FANBEAM_BINARY_DIR "/bin/fanbeam' " << command << "-o " << quoted(disk)
      << "\ncode=$?\n"
      << "cp -a " << quoted(disk) << " " << quoted(copy) << "\nexit $code\n";
  const Result result =
      run_shell(kOwnMounts + "\". " + (scratch / "on_disk.sh").string() + "\" 2>&1");
  after = results(copy);
  return result;
}

}  // namespace

TEST_CASE("F17 a disk that fills up: E-IO, and only complete files, new or old", "[no_room]") {
  if (!can_mount()) return;
  const TemporaryFolder folder;
  const Files whole = rendered(folder.path() / "whole");
  Files found;
  // Room for some of the pictures.
  const Result full = render_onto_disk(folder.path(), size_of(whole) / 2048 + 40, {}, false, found);
  INFO(full.output);
  CHECK(full.exit_code == 4);
  CHECK(full.output.find("E-IO") != std::string::npos);
  CHECK(full.output.find("No space left") != std::string::npos);
  for (const auto& [name, bytes] : found) CHECK(fs::path(name).filename().string().front() != '.');
  const std::size_t complete = check_complete(finished(found), finished(whole));
  CHECK(complete > 0);
  CHECK(complete < finished(whole).size());

  // Pictures of an earlier run fill the disk: replacing the large ones fails and leaves them.
  const fs::path old_folder = folder.path() / "old";
  const Files old_files = rendered(old_folder, "--seed 5");
  fs::remove(old_folder / "timing.json");
  std::size_t pages = 16;
  for (const auto& [name, bytes] : old_files) pages += bytes.size() / 4096 + 1;
  const Result again = render_onto_disk(folder.path(), 4 * pages, old_folder, false, found);
  INFO(again.output);
  CHECK(again.exit_code == 4);
  check_complete(finished(found), finished(whole), finished(old_files));
  // All but the record, as small ones were replaced.
  CHECK_FALSE(found.contains("run.json"));
  CHECK(finished(found).size() + 1 >= finished(old_files).size());
}

TEST_CASE("F17 a folder that is read-only, a file, or cannot be made is E-IO", "[no_room]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "kept");
  for (const fs::path& place :
       {file, file / "below", fs::path("/proc/fanbeam"), fs::path("/dev/full")}) {
    const Result result = run_fanbeam(kRender + "-o " + quoted(place));
    INFO(place.string() << ": " << result.output);
    CHECK(result.exit_code == 4);
    CHECK(result.output.find("E-IO") != std::string::npos);
    CHECK(result.output.find(place.string()) != std::string::npos);
  }
  CHECK(bytes_of(file) == "kept");
  if (can_mount()) {
    Files found;
    const Result result = render_onto_disk(folder.path(), 4000, {}, true, found);
    INFO(result.output);
    CHECK(result.exit_code == 4);
    CHECK(result.output.find("E-IO") != std::string::npos);
    CHECK(found.empty());
  }
  if (geteuid() != 0) {  // whom no permission stops
    const fs::path closed = folder.path() / "closed";
    fs::create_directories(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(run_fanbeam(kRender + "-o " + quoted(closed)).exit_code == 4);
    fs::permissions(closed, fs::perms::owner_all);
    CHECK(fs::is_empty(closed));
  }
}

TEST_CASE("F17 missing folders are made, and pictures that exist are replaced", "[no_room]") {
  const TemporaryFolder folder;
  const Files whole = rendered(folder.path() / "not/there/yet");
  rendered(folder.path() / "again", "--seed 5");
  CHECK(rendered(folder.path() / "again") == whole);
}

TEST_CASE("F17 a program stopped while it writes leaves complete files, and can go on",
          "[no_room]") {
  const TemporaryFolder folder;
  const Files whole = rendered(folder.path() / "whole");
  const fs::path out = folder.path() / "out";
  const std::string program =
      "'" FANBEAM_BINARY_DIR "/bin/fanbeam' " + kRender + "--resume -o " + quoted(out) + " 2>&1";
  // The system refuses to write beyond this size, in blocks of 512 bytes, and would end a program
  // that does not ignore SIGXFSZ: in the middle of the first table of ranges and before it of the
  // first plan view.
  for (const char* blocks : {"100", "16", "2"}) {
    fs::remove_all(out);
    const Result stopped =
        run_shell(std::string("ulimit -c 0; ulimit -f ") + blocks + "; " + program);
    INFO(stopped.output);
    CHECK(stopped.exit_code == 4);
    CHECK(stopped.output.find("E-IO") != std::string::npos);
    const Files found = finished(results(out));
    CHECK(found.count("run.json") == 0);
    CHECK(check_complete(found, finished(whole)) < finished(whole).size());
  }
  // Killed at any time.
  for (const char* seconds : {"0.6", "0.8", "1.0", "1.2"}) {
    run_shell(std::string("timeout -s KILL ") + seconds + " " + program);
    if (fs::exists(out)) check_complete(finished(results(out)), finished(whole));
  }
  REQUIRE(run_shell(program).exit_code == 0);
  CHECK(results(out) == whole);  // nothing in the making is left
}

namespace {

// What writes files, with a place for the folder or file at the end; few and small pictures.
struct Writing {
  const char* what;
  std::string command;
  const char* needs;  // a program
};

std::vector<Writing> writings() {
  const std::string frames = "render obstacle-field --frames 100:140:20 --rays-per-cell 1 -q ";
  return {
      {"films", frames + "--products preview ", "ffmpeg"},
      {"GIF films", frames + "--products preview --preview-format gif ", "ffmpeg"},
      {"PNG films", frames + "--products preview --preview-format apng ", "ffmpeg"},
      {"pictures", frames + "--products bscope,cscope,pair,figure,ppi,ppi_north,ppi_figure ", ""},
      {"watts and tables", frames + "--products power,detections,obstacles ", ""},
      {"beat signals",
       "fmcw street-76ghz -q --products "
       "beat,spectrum,cube,range-doppler,range-azimuth,top-view,detections ",
       "gnuplot"},
      {"plots of materials", "materials plot short_grass asphalt_worn ", "gnuplot"}};
}

}  // namespace

TEST_CASE("F17 whatever writes: no file or a whole one, and exit code 4, by disk and by limit",
          "[no_room]") {
  const TemporaryFolder folder;
  for (const Writing& writing : writings()) {
    if (*writing.needs != '\0' && !needed_program(writing.needs)) continue;
    INFO(writing.what);
    // A plot has one file; all else has a folder.
    const bool plot = writing.command.starts_with("materials");
    const fs::path whole_at = folder.path() / "whole";
    fs::remove_all(whole_at);
    const std::string name = plot ? "/plot.png" : "";
    fs::create_directories(whole_at);
    const Result good = run_fanbeam(writing.command + "-o '" + whole_at.string() + name + "'");
    INFO(good.output);
    REQUIRE(good.exit_code == 0);
    const Files whole = finished(results(whole_at));
    std::size_t largest = 0;
    for (const auto& [file, bytes] : whole) largest = std::max(largest, bytes.size());

    // A limit of the size of files that the largest exceeds: by a little, and by a lot.
    for (const std::size_t blocks : {(largest - 1) / 512, largest / 1024, std::size_t{1}}) {
      const fs::path out = folder.path() / "out";
      fs::remove_all(out);
      fs::create_directories(out);
      const Result limited = run_shell("ulimit -c 0; ulimit -f " + std::to_string(blocks) +
                                       "; '" FANBEAM_BINARY_DIR "/bin/fanbeam' " + writing.command +
                                       "-o '" + out.string() + name + "' 2>&1");
      INFO(blocks << " blocks of 512 bytes: " << limited.output);
      CHECK(limited.exit_code == 4);
      CHECK(limited.output.find("E-IO") != std::string::npos);
      for (const auto& [file, bytes] : contents(out))
        CHECK(fs::path(file).filename().string().find(".tmp") == std::string::npos);
      check_complete(finished(results(out)), whole);
    }
    if (plot || !can_mount()) continue;
    Files found;
    const Result full = render_onto_disk(folder.path(), size_of(whole) / 2048 + 8, {}, false, found,
                                         writing.command);
    INFO(full.output);
    CHECK(full.exit_code == 4);
    CHECK(full.output.find("E-IO") != std::string::npos);
    check_complete(finished(found), whole);
  }
}

TEST_CASE("F17 a film that a killed run was making is gone after --resume", "[no_room]") {
  if (!needed_program("ffmpeg")) return;
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  {
    Child child({"render", "obstacle-field", "--frames", "100:1000", "--rays-per-cell", "1", "-q",
                 "--products", "bscope,preview", "-o", out.string()});
    while (child.running() && !fs::exists(out / "bscope/00105.png")) wait_ms(2.0);
    child.send(SIGKILL);
    child.wait();
  }
  // ffmpeg sees the end of its input and finishes its own file.
  run_shell("for i in $(seq 150); do pgrep -f '[f]fmpeg.*" + out.string() +
            "' >/dev/null || break; sleep 0.2; done");
  std::size_t hidden = 0;
  for (const auto& [file, bytes] : contents(out))
    hidden += fs::path(file).filename().string().starts_with(".") ? 1 : 0;
  CHECK(hidden > 0);  // else this proves nothing
  REQUIRE(run_fanbeam("render obstacle-field --frames 100:102 --rays-per-cell 1 -q --resume -o " +
                      quoted(out))
              .exit_code == 0);
  for (const auto& [file, bytes] : contents(out)) {
    INFO(file);
    CHECK_FALSE(fs::path(file).filename().string().starts_with("."));
  }
}

TEST_CASE("F17 what cannot be printed is E-IO too", "[no_room]") {
  const TemporaryFolder folder;
  for (const char* words : {"plan flat-grass", "plan flat-grass --json", "materials", "atmosphere",
                            "validate flat-grass", "render flat-grass -o out"}) {
    const Result result =
        run_shell("cd " + quoted(folder.path()) + " && '" FANBEAM_BINARY_DIR "/bin/fanbeam' " +
                  words + " 2>&1 >/dev/full");
    INFO(words << ": " << result.output);
    CHECK(result.exit_code == 4);
    CHECK(result.output.find("E-IO") != std::string::npos);
  }
}
