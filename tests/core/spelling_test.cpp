#include "core/spelling.h"

#include <catch2/catch.hpp>

using namespace fanbeam::core;

TEST_CASE("Edit distance counts single-letter changes", "[core][spelling]") {
  REQUIRE(edit_distance("", "") == 0);
  REQUIRE(edit_distance("", "abc") == 3);
  REQUIRE(edit_distance("kitten", "sitting") == 3);
  REQUIRE(edit_distance("grass", "gras") == 1);
}

TEST_CASE("Nearest names come nearest first and stay in order where equal", "[core][spelling]") {
  const std::vector<std::string> known = {"water", "brick", "roof", "root"};
  REQUIRE(nearest_names("roop", known, 2) == std::vector<std::string>{"roof", "root"});
  REQUIRE(nearest_names("brik", known, 1) == std::vector<std::string>{"brick"});
  REQUIRE(nearest_names("x", {}, 3).empty());
  REQUIRE(nearest_names(std::string(10'000'000, 'x'), known, 9).size() == 4);
}
