#include "core/spelling.h"

#include <catch2/catch.hpp>

using namespace fanbeam::core;

TEST_CASE("Edit distance counts single-letter changes", "[core][spelling]") {
  REQUIRE(edit_distance("", "") == 0);
  REQUIRE(edit_distance("", "abc") == 3);
  REQUIRE(edit_distance("kitten", "sitting") == 3);
  REQUIRE(edit_distance("grass", "gras") == 1);
}

TEST_CASE("Swapped neighbours are one slip", "[core][spelling]") {
  CHECK(edit_distance("ab", "ba") == 1);
  CHECK(edit_distance("lenght_m", "length_m") == 1);
  CHECK(edit_distance("lenght_m", "height_m") == 2);
  CHECK(edit_distance("abcd", "badc") == 2);
  CHECK(edit_distance("ca", "abc") == 3);  // none is changed twice; 2 without that
  CHECK(nearest_names("lenght_m", {"height_m", "length_m"}, 1) ==
        std::vector<std::string>{"length_m"});
}

TEST_CASE("A missing name is told with those there and the likely one", "[core][spelling]") {
  const std::vector<std::string> known = {"time_s", "lat_deg", "lon_deg", "altitude_ft"};
  const std::string all = "time_s, lat_deg, lon_deg, altitude_ft";
  CHECK(names_there_text("alt_ft", known) == "; perhaps altitude_ft of " + all);
  CHECK(names_there_text("lat", known) == "; perhaps lat_deg of " + all);
  CHECK(names_there_text("timestamp", known) == "; there are " + all);
  CHECK(names_there_text("", known) == "; there are " + all);
  CHECK(names_there_text("x", {}) == "; there are none");
  CHECK(names_there_text("x", {"", "roll"}) == "; there are , roll");
  const std::string many = names_there_text("b", std::vector<std::string>(25, "column"));
  CHECK(many.ends_with(", column and 5 more"));
  CHECK(names_there_text(std::string(10'000'000, 'x'), {std::string(10'000'000, 'x')}).size() <
        200);
}

TEST_CASE("A short name that lies in a misspelt one is not what was meant", "[core][spelling]") {
  CHECK(names_there_text("radar_overides", {"id", "title", "radar_overrides"})
            .starts_with("; perhaps radar_overrides of "));
  CHECK(names_there_text("radar_overides", {"radar", "radar_overrides"})
            .starts_with("; perhaps radar_overrides of "));
  CHECK(names_there_text("radar_overides", {"id", "title"}) == "; there are id, title");
  CHECK(names_there_text("longitude", {"alt", "lon", "altitude"}).starts_with("; perhaps lon of "));
}

TEST_CASE("Nearest names come nearest first and stay in order where equal", "[core][spelling]") {
  const std::vector<std::string> known = {"water", "brick", "roof", "root"};
  REQUIRE(nearest_names("roop", known, 2) == std::vector<std::string>{"roof", "root"});
  REQUIRE(nearest_names("brik", known, 1) == std::vector<std::string>{"brick"});
  REQUIRE(nearest_names("x", {}, 3).empty());
  REQUIRE(nearest_names(std::string(10'000'000, 'x'), known, 9).size() == 4);
}
