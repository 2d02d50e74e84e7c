#include "core/errors.h"

#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "core/text.h"

using namespace fanbeam::core;

TEST_CASE("Each error class prints its catalogue code", "[errors]") {
  CHECK(code(ErrorClass::parse) == "E-PARSE");
  CHECK(code(ErrorClass::range) == "E-RANGE");
  CHECK(code(ErrorClass::nonfinite) == "E-NONFINITE");
  CHECK(code(ErrorClass::ref) == "E-REF");
  CHECK(code(ErrorClass::limit) == "E-LIMIT");
  CHECK(code(ErrorClass::path) == "E-PATH");
  CHECK(code(ErrorClass::time) == "E-TIME");
  CHECK(code(ErrorClass::unsupported) == "E-UNSUPPORTED");
  CHECK(code(ErrorClass::io) == "E-IO");
}

TEST_CASE("A problem is told with place, field, value and what was expected", "[errors]") {
  const Problem range{"E-RANGE", {"scene.toml", 12, 5}, "visibility_m", "-3", "1 to 100000 m"};
  CHECK(to_string(range) == "scene.toml:12:5: E-RANGE visibility_m = -3: expected 1 to 100000 m");
  const Place byte_place{"mesh.glb", 0, 0, 4096};
  const Problem at_byte{"E-PARSE", byte_place, "chunk", "", "a shorter length"};
  CHECK(to_string(at_byte) == "mesh.glb byte 4096: E-PARSE chunk: expected a shorter length");
  const Problem warning{"W-DEGENERATE", {}, "mesh 'truck'", "3 triangles", "left out"};
  CHECK(to_string(warning) == "W-DEGENERATE mesh 'truck' = 3 triangles: left out");
  const Problem bare{"E-IO", {"a.csv", 7, 0}, "", "", ""};
  CHECK(to_string(bare) == "a.csv:7: E-IO");
}

TEST_CASE("Numbers in messages read back to the same value", "[errors]") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-3.0) == "-3");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const double value : {1.0 / 3.0, 6.02214076e23, -1e-300, 5e-324, kLargest})
    CHECK(parse_number(number_text(value)).value == value);
}

TEST_CASE("All problems of a list travel together, warnings beside errors", "[errors]") {
  ProblemList list;
  CHECK_NOTHROW(list.throw_if_errors());
  list.warning("FILLED", {"dem.tif"}, "voids", "3", "filled");
  CHECK_FALSE(list.has_errors());
  CHECK_NOTHROW(list.throw_if_errors());
  list.error(ErrorClass::ref, {"scene.toml", 3, 1}, "sensor.file", "\"x.toml\"",
             "an existing file");
  list.error(ErrorClass::range, {"scene.toml", 4, 1}, "width_m", "0", "above 0");
  try {
    list.throw_if_errors();
    FAIL("nothing thrown");
  } catch (const InputError& error) {
    CHECK(error.problems().size() == 3);
    CHECK(error.has(ErrorClass::ref));
    CHECK(error.has(ErrorClass::range));
    CHECK_FALSE(error.has(ErrorClass::io));
    CHECK(std::string(error.what()) ==
          "dem.tif: W-FILLED voids = 3: filled\n"
          "scene.toml:3:1: E-REF sensor.file = \"x.toml\": expected an existing file\n"
          "scene.toml:4:1: E-RANGE width_m = 0: expected above 0");
  }
}

TEST_CASE("What is thrown is in the order of its places, files as first met", "[errors]") {
  ProblemList list;
  const auto add = [&](const char* file, int line, int column, const char* field) {
    list.error(ErrorClass::range, {file, line, column}, field, "", "");
  };
  add("scene.toml", 16, 1, "e");
  add("radar.toml", 9, 1, "g");
  add("", 0, 0, "h");
  add("scene.toml", 3, 12, "c");
  add("scene.toml", 3, 12, "d");
  add("scene.toml", 3, 2, "b");
  list.warning("ODD", {"scene.toml", 1}, "a", "", "");
  add("radar.toml", 2, 1, "f");
  std::string order;
  try {
    list.throw_if_errors();
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) order += problem.field;
    CHECK(std::string(error.what()).starts_with("scene.toml:1: W-ODD a\n"));
  }
  CHECK(order == "abcdefgh");
  for (std::size_t i = 0; i < ProblemList::kMost; ++i) add("", 0, 0, "many");
  try {
    list.throw_if_errors();
  } catch (const InputError& error) {
    CHECK(error.problems().back().code == "W-MORE");
  }
}

TEST_CASE("A hostile input cannot fill memory with problems, and errors past the cap still count",
          "[errors]") {
  ProblemList list;
  for (std::size_t i = 0; i < ProblemList::kMost; ++i) list.warning("ODD", {}, "field", "", "kept");
  for (int i = 0; i < 1000; ++i) list.error(ErrorClass::range, {}, "field", "1", "0");
  CHECK(list.all().size() == ProblemList::kMost + 1);
  CHECK(list.all().back().code == "W-MORE");
  CHECK(list.has_errors());
  CHECK_THROWS_AS(list.throw_if_errors(), InputError);
}

TEST_CASE("A refusal shows its errors, however many warnings came before", "[errors]") {
  ProblemList list;
  for (std::size_t i = 0; i < 2 * ProblemList::kMost; ++i)
    list.warning("ODD", {}, "field", "", "kept");
  list.error(ErrorClass::range, {}, "first", "1", "0");
  list.error(ErrorClass::ref, {}, "second", "1", "0");
  REQUIRE(list.all().size() == ProblemList::kMost + 1);
  CHECK(list.all()[ProblemList::kMost - 2].field == "first");
  CHECK(list.all()[ProblemList::kMost - 1].field == "second");
  CHECK(list.all().back().code == "W-MORE");
  CHECK_FALSE(list.is_full());
}

TEST_CASE("A terminal never obeys what a message quotes", "[errors]") {
  const Problem problem{"E-REF", Place{"a\x1b[31m.gltf", 2, 1}, "mesh \"\x1b[2J\"", "\n\r\x07",
                        "one of \x9b"};
  CHECK(to_string(problem) ==
        "a\\x1b[31m.gltf:2:1: E-REF mesh \"\\x1b[2J\" = \\x0a\\x0d\\x07: expected one of \\x9b");
}

TEST_CASE("Megabytes of an input do not end up in a message, nor half a letter", "[errors]") {
  const std::string megabyte(1'000'000, 'x');
  std::string umlauts = "x";
  while (umlauts.size() < 1000) umlauts += "\u00e4";
  ProblemList list;
  list.error(ErrorClass::ref, {}, megabyte, umlauts, megabyte);
  CHECK(list.all()[0].field == std::string(300, 'x') + "...");
  CHECK(list.all()[0].value == umlauts.substr(0, 499) + "...");
  CHECK(to_string(list.all()[0]).size() < 3000);
  try {
    throw_input_error(ErrorClass::ref, Place{}, megabyte, megabyte, megabyte);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).size() < 3000);
  }
}

TEST_CASE("throw_input_error carries one problem", "[errors]") {
  try {
    throw_input_error(ErrorClass::range, "rain_rate_mm_per_h", -2.5, "0 to 300");
    FAIL("nothing thrown");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) == "E-RANGE rain_rate_mm_per_h = -2.5: expected 0 to 300");
  }
}
