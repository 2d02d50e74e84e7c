// JSON that is read value by value: what is dumped again, and texts of any kind.
#include "core/json_node.h"

#include <catch2/catch.hpp>

#include "tests/processor_time.h"

using namespace fanbeam;

namespace {

std::vector<core::Problem> problems_of(const std::string& text) {
  core::ProblemList problems;
  CHECK_FALSE(core::parse_json(text, "t.json", {8, 1'000'000}, problems));
  return problems.all();
}

}  // namespace

TEST_CASE("A value is dumped on a line with its members sorted, whatever it is", "[json]") {
  core::ProblemList problems;
  const auto file = core::parse_json(
      "{\"b\": [1, 2.5, null],\n \"a\": {\"z\": \"x\\ny\", \"c\": true}, \"n\": null}", "t.json",
      {8, 100}, problems);
  REQUIRE(file);
  const core::JsonNode root(*file, problems);
  CHECK(root.dumped() == R"({"a":{"c":true,"z":"x\ny"},"b":[1,2.5,null],"n":null})");
  CHECK(root.member("b").element(1).dumped() == "2.5");
  CHECK(root.member("n").dumped() == "null");
  CHECK(root.member("missing").dumped() == "null");
  // A line break is text, but none that a name may have.
  const core::JsonNode broken = root.member("a").member("z");
  CHECK(broken.any_text() == "x\ny");
  CHECK(problems.all().empty());
  CHECK_FALSE(broken.text());
  CHECK_FALSE(root.member("b").any_text());
  CHECK(problems.all().size() == 2);
}

// The last one counted, unseen.
TEST_CASE("A name that is twice in one object is refused, in two objects it is not", "[json]") {
  for (const char* text :
       {R"({"a": 1, "a": 2})", R"({"a": 1, "b": [{"c": 1, "a": {}, "c": {"a": 2}}]})",
        R"({"x": [], "x": []})", R"({"\u0061": 1, "a": 1})"}) {
    INFO(text);
    const auto problems = problems_of(text);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == "E-PARSE");
    CHECK(problems[0].place.file == "t.json");
    CHECK(problems[0].value.find(" twice in one object") != std::string::npos);
  }
  CHECK(problems_of(R"({"b": [{"c": 1, "a": {}, "c": {"a": 2}}]})")[0].value ==
        "\"c\" twice in one object");
  core::ProblemList problems;
  const auto file = core::parse_json(R"({"a": {"b": 1, "c": {"a": 2}}, "b": [{"a": 3}, {"a": 4}]})",
                                     "t.json", {8, 100}, problems);
  REQUIRE(file);
  CHECK(core::JsonNode(*file, problems).dumped() ==
        R"({"a":{"b":1,"c":{"a":2}},"b":[{"a":3},{"a":4}]})");
  CHECK(problems.all().empty());
}

TEST_CASE("Numbers keep their digits and their kinds, texts their bytes", "[json]") {
  core::ProblemList problems;
  const std::string text =
      R"({"a":[0,-1,18446744073709551615,-9223372036854775808,0.1,1e300,true,false,null],"b":"\u00e4\"","c":{}})";
  const auto file = core::parse_json(text, "t.json", {8, 100}, problems);
  REQUIRE(file);
  CHECK(core::JsonNode(*file, problems).dumped() ==
        "{\"a\":[0,-1,18446744073709551615,-9223372036854775808,0.1,1e+300,true,false,null],"
        "\"b\":\"\xc3\xa4\\\"\",\"c\":{}}");
}

TEST_CASE("What is no JSON is told with its line and column, a number too large as such",
          "[json]") {
  const auto broken = problems_of("{\"a\": 1,\n \"b\": }");
  REQUIRE(broken.size() == 1);
  CHECK(broken[0].code == "E-PARSE");
  CHECK(broken[0].place.line == 2);
  CHECK(broken[0].place.column == 7);
  for (const char* text : {"", "{", "{} {}", "{\"a\": \"\xff\"}", "[1]", "7"})
    CHECK(problems_of(text).at(0).code == "E-PARSE");
  CHECK(problems_of("{\"a\": 1e999}").at(0).code == "E-NONFINITE");
}

// The parser took it for the end, and what stood behind it for nothing.
TEST_CASE("A zero byte in a JSON text is told where it stands", "[json]") {
  const auto zero = std::string(1, '\0');
  for (const std::string& behind : {std::string(), std::string("garbage"), std::string("{")}) {
    const auto problems = problems_of("{\"a\":\n 1} " + zero + behind);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == "E-PARSE");
    CHECK(problems[0].value == "a zero byte");
    CHECK(problems[0].place.line == 2);
    CHECK(problems[0].place.column == 5);
  }
  CHECK(problems_of("{\"a\": \"" + zero + "\"}").at(0).place.column == 8);
}

// Each object went through all before it.
TEST_CASE("The time to read a list of objects grows as the list", "[json]") {
  std::string text = "{\"a\": [{}";
  for (int i = 0; i < 200'000; ++i) text += ",{\"b\":1}";
  text += "]}";
  core::ProblemList problems;
  const double begin_s = tests::processor_time_s();
  REQUIRE(core::parse_json(text, "t.json", {8, 1'000'000}, problems));
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);  // a tenth; through all: a minute
}

TEST_CASE("A required member that is null is told as null, one that is not there as missing",
          "[json]") {
  core::ProblemList problems;
  const auto file = core::parse_json(R"({"a": null, "b": 0})", "t.json", {8, 100}, problems);
  REQUIRE(file);
  const core::JsonNode root(*file, problems);
  CHECK_FALSE(root.required("a").present());
  CHECK_FALSE(root.required("c").present());
  CHECK(root.required("b").present());
  REQUIRE(problems.all().size() == 2);
  CHECK(problems.all()[0].code == "E-REF");
  CHECK(problems.all()[0].value == "null");
  CHECK(problems.all()[0].expected == "a value");
  CHECK(problems.all()[1].value == "missing");
}
