// JSON that is read value by value: what is dumped again, and texts of any kind.
#include "core/json_node.h"

#include <catch2/catch.hpp>

using namespace fanbeam;

namespace {

// What reading the text says.
std::vector<core::Problem> problems_of(const std::string& text) {
  core::ProblemList problems;
  core::parse_json(text, "t.json", {8, 100}, problems);
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

// Which of the two counted, nobody said (RFC 8259, section 4).
TEST_CASE("A name that stands twice in one object is refused, in others it is not", "[json]") {
  for (const char* text : {R"({"a": 1, "b": 2, "a": 1})", R"([{"a": {}}, {"x": {"a": 0, "a": 1}}])",
                           R"({"b": {"c": []}, "\u0061": 1, "a": 2})"}) {
    INFO(text);
    const std::vector<core::Problem> problems = problems_of(text);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == "E-PARSE");
    CHECK(problems[0].value == "\"a\" twice in one object");
  }
  CHECK(problems_of(R"({"a": {"a": {"a": 1}, "b": {"a": 2}}, "b": [{"a": 1}, {"a": 1}]})").empty());
}

TEST_CASE("A required member that is null is told as null, one that is not there as missing",
          "[json]") {
  core::ProblemList problems;
  const auto file = core::parse_json(R"({"there": null})", "t.json", {8, 100}, problems);
  REQUIRE(file);
  const core::JsonNode root(*file, problems);
  CHECK_FALSE(root.required("there").present());
  CHECK_FALSE(root.required("away").present());
  REQUIRE(problems.all().size() == 2);
  CHECK(problems.all()[0].value == "null");
  CHECK(problems.all()[1].value == "missing");
}
