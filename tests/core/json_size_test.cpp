// How deep and long JSON is, told before a parser sees it.
#include "core/json_size.h"

#include <catch2/catch.hpp>
#include <string>

namespace fanbeam::core {
namespace {

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

bool fits(const std::string& json, const JsonLimits& limits) {
  return !json_excess(json, limits).has_value();
}

TEST_CASE("F01 the depth of JSON counts open brackets and braces alone", "[json]") {
  const JsonLimits limits{3, 1000};
  CHECK(fits("", limits));
  CHECK(fits(nested(3), limits));
  CHECK(fits("[[[]], [[]], {\"a\": {}}]", limits));
  const auto excess = json_excess("{\"a\": [{\"b\": [0]}]}", limits);
  REQUIRE(excess.has_value());
  CHECK(excess->of == JsonExcess::Of::levels);
  CHECK(excess->offset == 13);
}

TEST_CASE("F01 what stands in strings is not counted, whatever is escaped there", "[json]") {
  const JsonLimits limits{1, 2};
  CHECK(fits(R"(["[[[[,,,,"])", limits));
  CHECK(fits(R"(["\"[[[[,,,,"])", limits));
  CHECK(fits(R"(["\\\"[[[["])", limits));
  CHECK_FALSE(fits(R"(["\\", [[[]]]])", limits));
  CHECK_FALSE(fits(R"(["", [[]]])", limits));
  CHECK(fits("[\"[[[[", limits));    // ends in a string
  CHECK(fits("[\"[[[[\\", limits));  // and in an escape
}

TEST_CASE("F01 the values of JSON are bounded by its brackets and commas", "[json]") {
  CHECK(fits("[1, 2, 3]", {8, 3}));
  const auto excess = json_excess("[1, 2, 3, 4]", {8, 3});
  REQUIRE(excess.has_value());
  CHECK(excess->of == JsonExcess::Of::values);
  CHECK(excess->offset == 8);
  CHECK_FALSE(fits("[[], [], []]", {8, 5}));
  CHECK(fits("[[], [], []]", {8, 6}));
}

}  // namespace
}  // namespace fanbeam::core
