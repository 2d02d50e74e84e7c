// TOML texts that are broken or hostile, and machines that write numbers otherwise (R17, F18).
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <locale>

#include "tests/core/config_table_checks.h"

using namespace fanbeam::core;
using fanbeam::tests::check;
using fanbeam::tests::problems_of;
using fanbeam::tests::refusal_of;

namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace

TEST_CASE("A syntax error tells where it is, and nothing is read", "[config_text]") {
  const Problem problem = refusal_of("a = 1\nb = 2\nc = = 3\n");
  CHECK(problem.code == "E-PARSE");
  CHECK(problem.place.file == "test.toml");
  CHECK(problem.place.line == 3);
  CHECK(problem.place.column == 5);
  CHECK(problem.expected == "TOML");
  CHECK(refusal_of("a = \"open\nb = 1\n").place.line == 1);
  const Problem twice = refusal_of("a = 1\na = 2\n");
  CHECK(twice.code == "E-PARSE");
  CHECK(twice.place.line == 2);
}

TEST_CASE("Bytes that are no UTF-8 are E-PARSE with their line", "[config_text]") {
  const Problem problem = refusal_of("a = 1\nb = \"\xff\xfe\"\n");
  CHECK(problem.code == "E-PARSE");
  CHECK(problem.place.line == 2);
  CHECK(refusal_of(std::string("a = \"\0\"", 7)).code == "E-PARSE");
}

TEST_CASE("Deep nesting of any kind is E-LIMIT before the parser recurses into it",
          "[config_text]") {
  const int deep = 300'000;
  const std::string nested_tables =
      "x = 1\ny = " + repeated("{a=", deep) + "1" + repeated("}", deep);
  for (const std::string& text :
       {"a = " + repeated("[", deep) + repeated("]", deep), nested_tables,
        repeated("a.", deep) + "a = 1",
        // Quotes hide nothing: these are keys.
        repeated("\"a\".", deep) + "a = 1", repeated("'a' . ", deep) + "a = 1",
        std::string("[") + repeated("a.", deep) + "a]",
        // The strings before them end where TOML says.
        "s = [\"\"\"x\"\"\"\"\", " + repeated("[", deep),
        "s = '''it's''' # \"\nt = " + repeated("[", deep),
        "s = \"a\\\\\"\nt = " + repeated("[", deep)}) {
    INFO(text.substr(0, 40));
    const Problem problem = refusal_of(text);
    CHECK(problem.code == "E-LIMIT");
    CHECK(problem.field == "nesting");
    CHECK(problem.place.line == 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n')));
    CHECK(problem.place.column > 64);
  }
}

TEST_CASE("Brackets and points in texts, comments and numbers are no nesting", "[config_text]") {
  for (const std::string& text :
       {"s = \"" + repeated("[.", 500) + "\"", "s = '" + repeated("[\".", 500) + "'",
        "s = \"\"\"\n" + repeated("\"[{.\n", 500) + "\"\"\"",
        "# " + repeated("[.", 500) + "\ns = 1", "s = [" + repeated("1.5, ", 500) + "2.5]",
        repeated("[[row]]\nat = { a.b = 1.5 }\n", 500),
        "s = " + repeated("[", 60) + repeated("]", 60)}) {
    INFO(text.substr(0, 40));
    ProblemList problems;
    CHECK(ConfigTable::from_text(text, "test.toml", problems).present());
    CHECK(problems.all().empty());
  }
}

TEST_CASE("Files that are missing, folders or too large are refused without reading them",
          "[config_text]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(FANBEAM_BINARY_DIR) / "config_table_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  {
    std::ofstream(folder / "large.toml") << "a = 1\n";
    fs::resize_file(folder / "large.toml", 5U << 20U);
  }
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"missing.toml", "E-IO"}, {".", "E-IO"}, {"large.toml", "E-LIMIT"}};
  for (const auto& [name, code] : cases) {
    INFO(name);
    ProblemList problems;
    CHECK_FALSE(ConfigTable::from_file(folder / name, problems).present());
    REQUIRE(problems.all().size() == 1);
    CHECK(problems.all()[0].code == code);
    CHECK(problems.all()[0].place.file == (folder / name).string());
  }
  fs::remove_all(folder);
}

TEST_CASE("F18 numbers are read and told with a decimal point under any locale", "[config_text]") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const auto found = problems_of("x = 1234.5\ny = 1234567", [](ConfigTable& root) {
    CHECK(root.number("x", {}, 0.0) == 1234.5);
    CHECK(root.integer("y", 0, 2000000, 0) == 1234567);
    root.number("x", {0, 0.5}, 0.0);
    root.integer("y", 0, 10000, 0);
  });
  std::locale::global(before);
  check(found, {"test.toml:1:1: E-RANGE x = 1234.5: expected 0 to 0.5",
                "test.toml:2:1: E-RANGE y = 1234567: expected a whole number, 0 to 10000"});
}
