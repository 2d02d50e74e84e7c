// TOML with every problem reported: types, ranges, unknown keys and their places.
#include "core/config_table.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/core/config_table_checks.h"

using namespace fanbeam::core;
using fanbeam::tests::check;
using fanbeam::tests::problems_of;
using fanbeam::tests::refusal_of;

TEST_CASE("Values of every type come back, and fallbacks where a key is missing",
          "[config_table]") {
  ProblemList problems;
  ConfigTable root = ConfigTable::from_text(
      "whole = 7\nreal = 2.5\nyes = true\nname = \"Zürich\"\nkind = \"log\"\n"
      "list = [1, 2.5]\nwords = [\"a\", \"b\"]\n[sub.deeper]\nx = 1\n[[row]]\nx = 1\n[[row]]\nx = "
      "2\n",
      "test.toml", problems);
  CHECK(root.number("whole", {0, 10}, 1.0) == 7.0);
  CHECK(root.number("real", {0, 10}, 1.0) == 2.5);
  CHECK(root.number("absent", {0, 10}, 1.5) == 1.5);
  CHECK(root.integer("whole", 0, 10, 1) == 7);
  CHECK(root.boolean("yes", false));
  CHECK(root.text("name", "") == "Zürich");
  CHECK(root.choice("kind", {"stc", "log"}, 0) == 1);
  CHECK(root.choice("absent", {"stc", "log"}, 1) == 1);
  CHECK(root.numbers("list", {0, 3}, 2, 2) == std::vector<double>{1.0, 2.5});
  CHECK(root.texts("words") == std::vector<std::string>{"a", "b"});
  CHECK(root.table("sub").table("deeper").number("x", {}, 0.0) == 1.0);
  CHECK_FALSE(root.table("absent").present());
  CHECK(root.table("absent").number("x", {}, 4.0) == 4.0);
  REQUIRE(root.tables("row").size() == 2);
  CHECK(root.tables("row")[1].number("x", {}, 0.0) == 2.0);
  CHECK(root.tables("absent").empty());
  CHECK_FALSE(root.optional_number("absent", {}).has_value());
  CHECK(problems.all().empty());
}

TEST_CASE("A wrong type is reported with place, value and expectation, and reading goes on",
          "[config_table]") {
  const auto found =
      problems_of("n = \"5\"\n  i = 2.5\nb = 1\nt = 3\nc = true\na = [1, \"x\"]\ns = 4\nr = [1]\n",
                  [](ConfigTable& root) {
                    CHECK(root.number("n", {0, 10}, 1.0) == 1.0);
                    CHECK(root.integer("i", 0, 10, 2) == 2);
                    CHECK(root.boolean("b", true));
                    CHECK(root.text("t", "fallback") == "fallback");
                    CHECK(root.choice("c", {"x", "y"}, 1) == 1);
                    CHECK(root.numbers("a", {0, 10}, 0, 5).empty());
                    CHECK_FALSE(root.table("s").present());
                    CHECK(root.tables("r").empty());
                  });
  check(found, {"test.toml:1:1: E-PARSE n = \"5\": expected a number, 0 to 10",
                "test.toml:2:3: E-PARSE i = 2.5: expected a whole number, 0 to 10",
                "test.toml:3:1: E-PARSE b = 1: expected true or false",
                "test.toml:4:1: E-PARSE t = 3: expected a text in quotes",
                "test.toml:5:1: E-PARSE c = true: expected one of \"x\", \"y\"",
                "test.toml:6:9: E-PARSE a = \"x\": expected 0 to 5 numbers, each 0 to 10",
                "test.toml:7:1: E-PARSE s = 4: expected a table",
                "test.toml:8:1: E-PARSE r = an array of 1: expected an array of tables, [[r]]"});
}

TEST_CASE("Keys that are read where they are there alone are known in a table without any",
          "[config_table]") {
  const auto found =
      problems_of("[air]\nvisibility = 100\n[[car]]\nalong = 5\n", [](ConfigTable& root) {
        CHECK_FALSE(root.table("air").has("visibility_m"));
        for (ConfigTable& car : root.tables("car"))
          if (car.has("along_m")) car.number("along_m", {}, 0.0);
        root.report_unknown_keys();
      });
  check(found, {"test.toml:2:1: E-REF air.visibility = unknown key: expected a key of this table, "
                "perhaps \"visibility_m\"",
                "test.toml:4:1: E-REF car[0].along = unknown key: expected a key of this table, "
                "perhaps \"along_m\""});
}

TEST_CASE("Ranges include their ends, or leave out the lower one", "[config_table]") {
  const auto count = [](const std::string& value, NumberRange range) {
    return problems_of("x = " + value, [&](ConfigTable& root) { root.number("x", range, 1.0); })
        .size();
  };
  CHECK(count("0", {0, 1}) == 0);
  CHECK(count("1", {0, 1}) == 0);
  CHECK(count("1.0000000000000002", {0, 1}) == 1);
  CHECK(count("-5e-324", {0, 1}) == 1);
  CHECK(count("0", {0, 1, true}) == 1);
  CHECK(count("5e-324", {0, 1, true}) == 0);
  CHECK(to_string(NumberRange{0, 1}) == "0 to 1");
  CHECK(to_string(NumberRange{0, 1, true}) == "above 0, at most 1");
  CHECK(to_string(NumberRange{0.1, 1e7}) == "0.1 to 1e7");
  CHECK(to_string(NumberRange{-2.5e-7, 1e300}) == "-2.5e-7 to 1e300");
  const NumberRange or_zero{.low = 0.3, .high = 10000, .or_zero = true};
  CHECK(to_string(or_zero) == "0, or 0.3 to 10000");
  CHECK((or_zero.holds(0.0) && or_zero.holds(0.3) && !or_zero.holds(0.2) && !or_zero.holds(-0.1)));
  CHECK(to_string(NumberRange{}) == "a finite number");
  NumberRange half;
  half.low = 2.5;
  CHECK(to_string(half) == "at least 2.5");
}

TEST_CASE("T06 numbers that are none, infinite or too large never pass", "[config_table]") {
  const auto found =
      problems_of("a = nan\nb = inf\nc = -inf\nd = [1, nan]\ne = 90.0000001\nf = -1e308\n",
                  [](ConfigTable& root) {
                    CHECK(root.number("a", {}, 1.0) == 1.0);
                    CHECK(root.number("b", {}, 1.0) == 1.0);
                    CHECK_FALSE(root.optional_number("c", {}).has_value());
                    CHECK(root.numbers("d", {}, 0, 9).empty());
                    CHECK(root.required_number("e", {-90, 90}) == -90.0);
                    CHECK(root.number("f", {-1e9, 1e9}, 0.0) == 0.0);
                  });
  check(found, {"test.toml:1:1: E-NONFINITE a = nan: expected a finite number",
                "test.toml:2:1: E-NONFINITE b = inf: expected a finite number",
                "test.toml:3:1: E-NONFINITE c = -inf: expected a finite number",
                "test.toml:4:9: E-NONFINITE d = nan: expected 0 to 9 numbers, each a finite number",
                "test.toml:5:1: E-RANGE e = 90.0000001: expected -90 to 90",
                "test.toml:6:1: E-RANGE f = -1e+308: expected -1e9 to 1e9"});
  const Problem too_large = refusal_of("a = 1\nb = 1e400\n");
  CHECK(too_large.code == "E-PARSE");
  CHECK(too_large.place.line == 2);
  CHECK(refusal_of("a = 99999999999999999999").code == "E-PARSE");
}

TEST_CASE("Whole numbers keep every digit of 64 bits and mind their limits", "[config_table]") {
  const auto found = problems_of("a = 9223372036854775807\nb = -1\nc = 11", [](ConfigTable& root) {
    CHECK(root.integer("a", 0, std::numeric_limits<std::int64_t>::max(), 0) == 9223372036854775807);
    CHECK(root.integer("b", 0, 10, 3) == 3);
    CHECK(root.integer("c", 0, 10, 3) == 3);
  });
  check(found, {"test.toml:2:1: E-RANGE b = -1: expected a whole number, 0 to 10",
                "test.toml:3:1: E-RANGE c = 11: expected a whole number, 0 to 10"});
}

TEST_CASE("Missing required keys and wrong choices name what was expected", "[config_table]") {
  const auto found = problems_of("[t]\nkind = \"lag\"\nlist = [1, 2, 3]\n", [](ConfigTable& root) {
    ConfigTable table = root.table("t");
    table.required_number("x_m", {1, 9});
    table.required_text("name");
    table.choice("kind", {"stc", "log"}, 0);
    table.numbers("list", {}, 2, 2);
  });
  check(
      found,
      {"test.toml:1:1: E-REF t.x_m = missing: expected 1 to 9",
       "test.toml:1:1: E-REF t.name = missing: expected a text in quotes",
       "test.toml:2:1: E-RANGE t.kind = \"lag\": expected one of \"stc\", \"log\"",
       "test.toml:3:1: E-RANGE t.list = an array of 3: expected 2 numbers, each a finite number"});
}

TEST_CASE("Texts with control characters are refused, and shown as escapes", "[config_table]") {
  const auto found = problems_of(
      "title = \"\\u001b]0;owned\\u0007\"\nlist = [\"plain\", \"a\\nb\"]\n\"k\\u001b\" = 1\n",
      [](ConfigTable& root) {
        CHECK(root.text("title", "fallback") == "fallback");
        CHECK(root.texts("list").empty());
        root.report_unknown_keys();
      });
  check(found, {"test.toml:1:1: E-RANGE title = \"\\x1b]0;owned\\x07\": expected a text without "
                "control characters",
                "test.toml:2:18: E-RANGE list = \"a\\x0ab\": expected a text without control "
                "characters",
                "test.toml:3:1: E-REF k\\x1b = unknown key: expected a key of this table"});
}

TEST_CASE("Unknown keys are errors wherever they stand, with the names most like them",
          "[config_table]") {
  const std::string text =
      "tpyo = 1\n[weather]\nvisibility_km = 3\nrain_rate_mm = 3\n[[box]]\nlength = 1\nat = { lat = "
      "1 }\n";
  const auto found = problems_of(text, [](ConfigTable& root) {
    ConfigTable weather = root.table("weather");
    weather.number("visibility_m", {}, 0.0);
    weather.number("rain_rate_mm_per_h", {}, 0.0);
    for (ConfigTable& box : root.tables("box")) {
      box.number("length_m", {}, 0.0);
      box.table("at").number("latitude_deg", {}, 0.0);
    }
    root.report_unknown_keys();
  });
  REQUIRE(found.size() == 5);
  for (const Problem& problem : found) {
    CHECK(problem.code == "E-REF");
    CHECK(problem.value == "unknown key");
    CHECK(problem.place.column > 0);
  }
  const auto problem_of = [&](const std::string& field) {
    for (const Problem& problem : found)
      if (problem.field == field) return problem;
    FAIL("no problem of " << field);
    return Problem{};
  };
  CHECK(problem_of("tpyo").place.line == 1);
  CHECK(problem_of("weather.visibility_km").expected ==
        "a key of this table, perhaps \"visibility_m\"");
  CHECK(problem_of("weather.rain_rate_mm").expected ==
        "a key of this table, such as \"rain_rate_mm_per_h\", \"visibility_m\"");
  CHECK(problem_of("box[0].length").expected == "a key of this table, perhaps \"length_m\"");
  CHECK(problem_of("box[0].at.lat").place.line == 7);
  CHECK(problem_of("box[0].at.lat").place.column == 8);
}

TEST_CASE("What a table has already is not what a misspelt key was meant to be", "[config_table]") {
  const auto box = [](ConfigTable& root) {
    for (const char* key : {"at", "height_m", "length_m", "width_m"}) root.has(key);
    root.report_unknown_keys();
  };
  const std::string told = "unknown key: expected a key of this table";
  check(problems_of("lenght_m = 10\nwidth_m = 10\nheight_m = -3\n", box),
        {"test.toml:1:1: E-REF lenght_m = " + told + ", perhaps \"length_m\""});
  check(problems_of("heigth_m = 3\nheight_m = 3\nwidth_m = 1\nlength_m = 1\nat = 1\n", box),
        {"test.toml:1:1: E-REF heigth_m = " + told});
}

TEST_CASE("The place of a key is found by its path, and none for what is not there",
          "[config_table]") {
  ProblemList problems;
  const KeyPlaces place_of = ConfigTable::from_text(
                                 "[[box]]\nwall = 1\n[[box]]\n  wall = { a = 1 }\n"
                                 "list = [1,\n  2]\n[t]\n\"x.y[0]\" = 1\n",
                                 "test.toml", problems)
                                 .key_places();
  const auto place = [&](const std::string& path) {
    const std::optional<Place> found = place_of(path);
    return found ? std::to_string(found->line) + ":" + std::to_string(found->column) : "none";
  };
  CHECK(place("box[0].wall") == "2:1");
  CHECK(place("box[1].wall.a") == "4:12");
  CHECK(place("box[1].list[1]") == "6:3");
  CHECK(place("t.x.y[0]") == "8:1");
  CHECK(place_of("box[0].wall")->file == "test.toml");
  for (const char* absent : {"", "box[2].wall", "box[0].wal", "box[0].walls", "box.wall",
                             "box[x].wall", "box[].wall", "box[0", "box[0]wall", "t.x", "none"})
    CHECK(place(absent) == "none");
}

TEST_CASE("Resolved values list every answer with its path, defaults included", "[config_table]") {
  ProblemList problems;
  ConfigTable root =
      ConfigTable::from_text("[a]\nx_m = 3\n[[b]]\ns = \"t\"\n", "test.toml", problems);
  ConfigTable a = root.table("a");
  a.number("x_m", {}, 1.0);
  a.number("y_m", {}, 2.5);
  a.optional_number("z_m", {});
  for (ConfigTable& b : root.tables("b")) b.text("s", "");
  root.choice("mode", {"one", "two"}, 1);
  root.boolean("on", true);
  const ResolvedConfig expected = {{"a.x_m", 3.0},
                                   {"a.y_m", 2.5},
                                   {"b[0].s", std::string("t")},
                                   {"mode", std::string("two")},
                                   {"on", true}};
  CHECK((root.resolved() == expected));
}

TEST_CASE("Keys of a table keep the order of the file", "[config_table]") {
  ProblemList problems;
  ConfigTable root =
      ConfigTable::from_text("[t]\nzebra = 1\napple = 2\n10 = 3\n2 = 4\n", "test.toml", problems);
  CHECK(root.table("t").keys() == std::vector<std::string>{"zebra", "apple", "10", "2"});
  CHECK(root.table("absent").keys().empty());
}
