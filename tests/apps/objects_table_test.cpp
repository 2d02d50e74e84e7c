#include "apps/objects_table.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace fanbeam;

TEST_CASE("The table of typical objects has a line for each and their notes below", "[objects]") {
  core::ProblemList problems;
  const auto library = materials::ObjectLibrary::from_file(
      std::string(FANBEAM_SOURCE_DIR) + "/materials/objects.toml", problems);
  REQUIRE(problems.all().empty());
  std::istringstream table(apps::objects_table(library));
  std::string line;
  std::getline(table, line);
  CHECK(line.starts_with("object"));
  for (const materials::TypicalObject& object : library.all()) {
    std::getline(table, line);
    CHECK(line.starts_with(object.name + " "));
    CHECK(line.ends_with(object.source));
  }
  std::getline(table, line);
  CHECK(line.empty());
  // Notes, and what the car's lobes mean for its line.
  std::string notes;
  while (std::getline(table, line)) notes += line + '\n';
  CHECK(notes.find("car: 5 lobes over aspect") != std::string::npos);
  CHECK(notes.find("fence_post: Steel tube of 0.03 m radius") != std::string::npos);
}
