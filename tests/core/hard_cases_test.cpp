// docs/hard-cases.md cannot rot: its cases have tests, its marks have mutants, and none is missing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = FANBEAM_SOURCE_DIR;
const std::string kMark = "●";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

struct Row {
  std::string test_cell;
  bool marked = false;
};

// By case: the lines that begin with "| M01 |".
std::map<std::string, Row> documented_cases() {
  std::map<std::string, Row> rows;
  std::istringstream lines(text_of(kRoot / "docs/hard-cases.md"));
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.size() > 7 ? line.substr(2, 3) : "";
    if (!std::regex_match(name, std::regex("[A-Z][0-9]{2}")) || !line.starts_with("| ")) continue;
    INFO(line);
    CHECK(rows.count(name) == 0);
    const std::size_t second = line.find("| ", 2);
    REQUIRE(second != std::string::npos);
    const std::size_t third = line.find(" |", second + 1);
    rows[name] = {line.substr(second, third - second), line.find(kMark) != std::string::npos};
  }
  return rows;
}

// By case: the files, relative to the root, with a TEST_CASE whose name holds it; of Python's, whose
// functions are named in words, those with a comment that does, beside what is asserted.
std::map<std::string, std::set<std::string>> tested_cases() {
  std::map<std::string, std::set<std::string>> files;
  const std::regex test_case("TEST_CASE\\(\\s*\"([^\"]*)");
  const std::regex comment("# ([^\n]*)");
  const std::regex name("\\b[A-Z][0-9]{2}\\b");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    const bool python = entry.path().filename().string().ends_with("_test.py");
    if (!python && entry.path().extension() != ".cpp") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), python ? comment : test_case), end;
         it != end; ++it) {
      const std::string title = (*it)[1];
      for (std::sregex_iterator id(title.begin(), title.end(), name); id != end; ++id)
        files[id->str()].insert(entry.path().lexically_relative(kRoot).string());
    }
  }
  return files;
}

}  // namespace

TEST_CASE("Every case of docs/hard-cases.md has a test of its name in the file that it names",
          "[hard_cases]") {
  const auto tests = tested_cases();
  for (const auto& [name, row] : documented_cases()) {
    INFO(name << ": " << row.test_cell);
    REQUIRE(tests.count(name) == 1);
    const std::set<std::string>& files = tests.at(name);
    const std::regex quoted("`(tests/[a-z0-9_/]+\\.(?:cpp|py))`");
    std::size_t named = 0;
    for (std::sregex_iterator it(row.test_cell.begin(), row.test_cell.end(), quoted), end;
         it != end; ++it, ++named) {
      INFO((*it)[1]);
      CHECK(files.count((*it)[1]) == 1);
    }
    CHECK(named > 0);
  }
}

TEST_CASE("docs/hard-cases.md marks exactly the cases that have a mutant, and leaves none out",
          "[hard_cases]") {
  const auto rows = documented_cases();
  std::set<std::string> mutants;
  for (const auto& entry : fs::directory_iterator(kRoot / "tests/mutations"))
    if (entry.path().extension() == ".patch")
      mutants.insert(entry.path().filename().string().substr(0, 3));
  for (const std::string& mutant : mutants) {
    INFO(mutant);
    CHECK(rows.count(mutant) == 1);
  }
  for (const auto& [name, row] : rows) {
    INFO(name);
    CHECK(row.marked == (mutants.count(name) == 1));
  }
  // The catalogue's numbers; the feeds' F11 to F16 come with the feeds.
  const std::map<char, int> numbers = {{'T', 13}, {'R', 19}, {'M', 7},  {'A', 7},
                                       {'S', 11}, {'G', 8},  {'F', 19}, {'K', 6}};
  for (const auto& [letter, last] : numbers)
    for (int number = 1; number <= last; ++number) {
      if (letter == 'F' && number >= 11 && number <= 16) continue;
      const std::string name =
          std::string(1, letter) + (number < 10 ? "0" : "") + std::to_string(number);
      INFO(name);
      CHECK(rows.count(name) == 1);
    }
}
