// A locale whose decimal sign is a comma, made here, as few machines have one installed (F18).
#pragma once

#include <catch2/catch.hpp>
#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/needed_program.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::tests {

// Where the program localedef is missing nothing is made, and the case is told to be skipped.
class CommaLocale {
 public:
  CommaLocale() {
    if (!needed_program("localedef")) return;
    folder_.write("numbers",
                  "comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \",\"\n"
                  "thousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n");
    const std::string path = folder_.path().string();
    // It warns of the other categories, and its exit code says no more than that.
    const int warned = std::system(("localedef --no-archive -c -i " + path +
                                    "/numbers -f ANSI_X3.4-1968 " + path + "/comma >/dev/null 2>&1")
                                       .c_str());
    INFO("localedef ended with " << warned);
    REQUIRE(std::filesystem::exists(folder_.path() / "comma" / "LC_NUMERIC"));
    made_ = true;
  }
  bool made() const { return made_; }
  std::string folder() const { return folder_.path().string(); }
  // Words for the shell, in front of a command.
  std::string environment() const { return "LOCPATH=" + folder() + " LC_ALL=comma"; }

 private:
  TemporaryFolder folder_;
  bool made_ = false;
};

// This process has that locale, for C functions, as long as the object lives.
class HeldCommaLocale {
 public:
  explicit HeldCommaLocale(const CommaLocale& comma) : before_(std::setlocale(LC_ALL, nullptr)) {
    setenv("LOCPATH", comma.folder().c_str(), 1);
    const bool set = std::setlocale(LC_ALL, "comma") != nullptr;
    unsetenv("LOCPATH");
    REQUIRE(set);
    REQUIRE(std::string(std::localeconv()->decimal_point) == ",");
  }
  ~HeldCommaLocale() { std::setlocale(LC_ALL, before_.c_str()); }
  HeldCommaLocale(const HeldCommaLocale&) = delete;
  HeldCommaLocale& operator=(const HeldCommaLocale&) = delete;

 private:
  std::string before_;
};

}  // namespace fanbeam::tests
