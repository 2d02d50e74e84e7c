// Reference systems that would make PROJ read files of the input's choice.
#include "terrain/crs_definition.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "core/errors.h"
#include "terrain/buildings/footprints.h"
#include "tests/terrain/ascii_grid.h"
#include "tests/terrain/refused_raster.h"

namespace fanbeam::terrain {
namespace {

using Catch::Contains;
using tests::refusal_of_raster;
using tests::TemporaryFolder;

std::string with_crs(const std::string& crs) {
  return R"({"type":"FeatureCollection","crs":)" + crs + R"(,"features":[]})";
}

std::string refusal_of_footprints(const std::filesystem::path& file) {
  try {
    core::ProblemList problems;
    read_footprints(file, {}, problems);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("F05 definitions that name files are known, and the usual ones are not among them",
          "[crs]") {
  for (const char* text :
       {"+init=/tmp/x:1", "+INIT = epsg:4326", "+proj=longlat +nadgrids=x.gsb",
        "+proj=longlat +nadgrids=@x.gsb", "+nadgrids=@null,x.gsb", "+geoidgrids=g.gtx",
        "DATUM[\"y\",EXTENSION[\"PROJ4_GRIDS\",\"/tmp/x\"]]", "+proj=tinshift +file=t.json",
        "+proj=defmodel +model=m.json", "PARAMETERFILE[\"Latitude and longitude\",\"x.gsb\"]"}) {
    INFO(text);
    CHECK(names_files(text));
  }
  for (const char* text :
       {"EPSG:3857", "urn:ogc:def:crs:OGC:1.3:CRS84", "+proj=utm +zone=32 +datum=WGS84", "",
        "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +wktext +no_defs",
        "EXTENSION[\"PROJ4_GRIDS\",\"@null\"]", tests::kUtm32NorthWkt}) {
    INFO(text);
    CHECK_FALSE(names_files(text));
  }
}

TEST_CASE("F05 a GeoJSON's crs is seen however it is written", "[crs]") {
  for (const char* crs :
       {R"({"type":"name","properties":{"name":"+init=/tmp/x:1"}})", R"("+init=/tmp/x:1")",
        R"({"type":"name","properties":{"name":"+in\u0069t=/tmp/x:1"}})",
        R"({"a":[{"b":"EPSG:1"},{"c":["+nadgrids=x"]}]})"}) {
    INFO(crs);
    CHECK(crs_names_files(with_crs(crs), "f"));
  }
  CHECK(crs_names_files(R"({"\u0063RS":"+init=x","features":[]})", "f"));
  CHECK(crs_names_files(R"({"features":[{"crs":{"n":"EPSG:1"}},{"CRS":{"n":"+init=x"}}]})", "f"));
  CHECK_FALSE(crs_names_files(R"({"crs":"EPSG:1","name":"+init=x"})", "f"));
  CHECK_FALSE(crs_names_files(R"({"crs":{"n":"EPSG:1"},"a":{"name":"+init=x"}})", "f"));
  CHECK_FALSE(crs_names_files(R"({"name":"+init=x","features":[]})", "f"));
  CHECK_THROWS_WITH(crs_names_files(R"({"crs":"EPSG:1")", "f"), Contains("E-PARSE"));
}

// A pipe that nobody writes to: opening it would never end.
TEST_CASE("F05 footprints and rasters whose reference system names a file open no file", "[crs]") {
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const auto crs = [](const std::string& name) {
    return with_crs(R"({"type":"name","properties":{"name":")" + name + "\"}}");
  };
  for (const std::string& name :
       {"+init=" + pipe + ":x", "+proj=longlat +ellps=bessel +nadgrids=" + pipe})
    CHECK_THAT(refusal_of_footprints(folder.write("a.geojson", crs(name))), Contains("E-PATH crs"));

  const auto ten = [](int, int) { return std::string("10"); };
  tests::AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  grid.wkt =
      "GEOGCS[\"x\",DATUM[\"y\",SPHEROID[\"z\",6377397.155,299.1528128],"
      "EXTENSION[\"PROJ4_GRIDS\",\"" +
      pipe + "\"]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
  CHECK_THAT(refusal_of_raster(grid.write(folder, "grids", ten)), Contains("E-PATH side file"));
}

TEST_CASE("F05 side files of rasters are files, and short", "[crs]") {
  const TemporaryFolder folder;
  const auto ten = [](int, int) { return std::string("10"); };
  tests::AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  const auto file = grid.write(folder, "dem", ten);
  CHECK(refusal_of_raster(file) == "accepted");
  REQUIRE(mkfifo((folder.path() / "dem.asc.aux.xml").c_str(), 0600) == 0);
  CHECK_THAT(refusal_of_raster(file), Contains("E-IO"));
  std::filesystem::remove(folder.path() / "dem.asc.aux.xml");
  folder.write("dem.prj", std::string(2'000'000, 'A'));
  CHECK_THAT(refusal_of_raster(file), Contains("E-LIMIT"));
}

}  // namespace fanbeam::terrain
