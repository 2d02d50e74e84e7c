// JSON that is read value by value: what is dumped again, and texts of any kind.
#include "core/json_node.h"

#include <catch2/catch.hpp>

using namespace fanbeam;

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
