#include "terrain/raster/raster_file.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/files.h"
#include "tests/terrain/ascii_grid.h"

namespace fanbeam::terrain {
namespace {

using Catch::Matchers::Contains;
using tests::AsciiGrid;
using tests::TemporaryFolder;

std::string refusal_of(const std::filesystem::path& file) {
  try {
    read_raster_band(file);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

template <typename Number>
void append(std::string& bytes, Number number) {
  std::array<char, sizeof(Number)> raw{};
  std::memcpy(raw.data(), &number, sizeof(Number));
  bytes.append(raw.data(), raw.size());
}

// A little-endian GeoTIFF of 4 x 4 Int16 samples of 77 in longitude and latitude, one strip. Fields
// as in TIFF 6.0 and GeoTIFF 1.1 (OGC 19-008).
std::string tiny_geotiff(bool strip_written, std::uint16_t samples_per_pixel) {
  constexpr std::uint16_t kShort = 3, kLong = 4, kDouble = 12;
  constexpr std::uint32_t kEntries = 13, kExtra = 8 + 2 + 12 * kEntries + 4;
  constexpr std::uint32_t kTiepoint = kExtra + 24, kKeys = kTiepoint + 48, kStrip = kKeys + 32;
  const std::uint32_t strip_bytes = strip_written ? 32U * samples_per_pixel : 0U;
  std::string bytes = "II";
  append(bytes, std::uint16_t{42});
  append(bytes, std::uint32_t{8});
  append(bytes, static_cast<std::uint16_t>(kEntries));
  const auto field = [&bytes](std::uint16_t tag, std::uint16_t type, std::uint32_t count,
                              std::uint32_t value) {
    append(bytes, tag);
    append(bytes, type);
    append(bytes, count);
    append(bytes, value);
  };
  field(256, kShort, 1, 4);
  field(257, kShort, 1, 4);
  field(258, kShort, 1, 16);
  field(259, kShort, 1, 1);
  field(262, kShort, 1, 1);
  field(273, kLong, 1, strip_written ? kStrip : 0);
  field(277, kShort, 1, samples_per_pixel);
  field(278, kShort, 1, 4);
  field(279, kLong, 1, strip_bytes);
  field(339, kShort, 1, 2);
  field(33550, kDouble, 3, kExtra);
  field(33922, kDouble, 6, kTiepoint);
  field(34735, kShort, 16, kKeys);
  append(bytes, std::uint32_t{0});
  for (const double scale : {0.01, 0.01, 0.0}) append(bytes, scale);
  for (const double tie : {0.0, 0.0, 0.0, 11.0, 47.0, 0.0}) append(bytes, tie);
  // Geographic, pixel is area, EPSG:4326.
  for (const int key : {1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326})
    append(bytes, static_cast<std::uint16_t>(key));
  for (std::uint32_t i = 0; i < strip_bytes / 2; ++i) append(bytes, std::int16_t{77});
  return bytes;
}

// A GeoTIFF of 4 x 4 samples of 77 whose first row is masked, and that names no nodata value.
std::filesystem::path write_masked(const TemporaryFolder& folder, const char* internal) {
  GDALAllRegister();
  const CPLConfigOptionSetter where("GDAL_TIFF_INTERNAL_MASK", internal, false);
  const std::filesystem::path file = folder.path() / "masked.tif";
  const GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      file.c_str(), 4, 4, 1, GDT_Int16, nullptr));
  REQUIRE(dataset != nullptr);
  std::array<double, 6> geotransform = {11.0, 0.01, 0.0, 47.0, 0.0, -0.01};
  CHECK(dataset->SetGeoTransform(geotransform.data()) == CE_None);
  CHECK(dataset->SetProjection(tests::kWgs84Wkt) == CE_None);
  const auto fill = [](GDALRasterBand& band, GDALDataType type, auto values) {
    CHECK(band.RasterIO(GF_Write, 0, 0, 4, 4, values.data(), 4, 4, type, 0, 0, nullptr) == CE_None);
  };
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  fill(band, GDT_Int16, std::vector<std::int16_t>(16, 77));
  REQUIRE(dataset->CreateMaskBand(GMF_PER_DATASET) == CE_None);
  std::vector<std::uint8_t> mask(16, 255);
  std::fill_n(mask.begin(), 4, std::uint8_t{0});
  fill(*band.GetMaskBand(), GDT_Byte, mask);
  return file;
}

}  // namespace

TEST_CASE("GeoTIFF blocks that were never written are no heights of zero", "[raster_file]") {
  const TemporaryFolder folder;
  const RasterBand whole = read_raster_band(folder.write("whole.tif", tiny_geotiff(true, 1)));
  CHECK(whole.samples == std::vector<float>(16, 77.0F));
  CHECK_THAT(refusal_of(folder.write("sparse.tif", tiny_geotiff(false, 1))),
             Contains("E-PARSE samples = blocks that were never written"));
}

TEST_CASE("Where the mask of a raster is 0 there is no value, in the file or beside it",
          "[raster_file]") {
  for (const char* internal : {"YES", "NO"}) {
    CAPTURE(internal);
    const TemporaryFolder folder;
    const auto file = write_masked(folder, internal);
    CHECK(std::filesystem::exists(file.string() + ".msk") == (internal[0] == 'N'));
    const RasterBand band = read_raster_band(file);
    REQUIRE(band.samples.size() == 16);
    for (std::size_t i = 0; i < 16; ++i)
      CHECK((i < 4 ? std::isnan(band.samples[i]) : band.samples[i] == 77.0F));
  }
}

TEST_CASE("F05 a mask beside a raster that is no TIFF is never opened", "[raster_file]") {
  const TemporaryFolder folder;
  const auto file = folder.write("whole.tif", tiny_geotiff(true, 1));
  const char* vrt = "<VRTDataset rasterXSize=\"4\" rasterYSize=\"4\"/>";
  for (const char* name : {"whole.tif.msk", "WHOLE.TIF.MSK"}) {
    folder.write(name, vrt);
    CHECK_THAT(refusal_of(file), Contains("E-PATH side file") && Contains("a mask that is a TIFF"));
    std::filesystem::remove(folder.path() / name);
  }
  CHECK(refusal_of(file) == "accepted");
}

TEST_CASE("A picture of three bands is no terrain", "[raster_file]") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of(folder.write("picture.tif", tiny_geotiff(true, 3))),
             Contains("E-UNSUPPORTED bands = 3"));
}

// GDAL hands the unit of a GeoTIFF on, that of an ESRI grid not: feet were read as metres.
TEST_CASE("Heights in feet are refused wherever a raster says so, metres in any spelling are read",
          "[raster_file]") {
  const TemporaryFolder folder;
  AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  const auto told = [&](const std::string& system) {
    grid.wkt = system;
    return refusal_of(grid.write(folder, "dem", [](int, int) { return std::string("5669.5"); }));
  };
  const auto esri = [](const std::string& unit) {
    return R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",)"
           R"(SPHEROID["WGS_1984",6378137.0,298.257223563]],)"
           R"(PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],)"
           R"(VERTCS["NAVD88",VDATUM["North_American_Vertical_Datum_1988"],)"
           R"(PARAMETER["Vertical_Shift",0.0],PARAMETER["Direction",1.0],UNIT[)" +
           unit + "]]";
  };
  CHECK_THAT(told(esri("\"Foot\",0.3048")), Contains("E-UNSUPPORTED unit") && Contains("metres"));
  CHECK_THAT(told(esri("\"Foot_US\",0.3048006096012192")), Contains("E-UNSUPPORTED unit"));
  CHECK(told(esri("\"Meter\",1.0")) == "accepted");
  const auto older = [](const std::string& zunits) {
    return "Projection GEOGRAPHIC\nDatum WGS84\nSpheroid WGS84\nUnits DD\n" + zunits +
           "\nParameters\n";
  };
  CHECK_THAT(told(older("Zunits    FEET")), Contains("E-UNSUPPORTED unit = FEET"));
  for (const char* zunits : {"Zunits    METERS", "Zunits    NO", ""})
    CHECK(told(older(zunits)) == "accepted");
  // The band's own unit, which GDAL keeps in a file beside the grid, counts before the system's.
  const auto of_band = [&](const std::string& unit) {
    folder.write("dem.asc.aux.xml", "<PAMDataset><PAMRasterBand band=\"1\"><UnitType>" + unit +
                                        "</UnitType></PAMRasterBand></PAMDataset>");
    return told(tests::kWgs84Wkt);
  };
  for (const char* unit : {"Metres", "METERS", "Meter", "M"}) CHECK(of_band(unit) == "accepted");
  CHECK_THAT(of_band("Feet"), Contains("E-UNSUPPORTED unit = Feet"));
}

TEST_CASE("Rasters that cannot be placed on the Earth are refused", "[raster_file]") {
  const TemporaryFolder folder;
  const auto ten = [](int, int) { return std::string("10"); };
  AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  grid.wkt = "";
  CHECK_THAT(refusal_of(grid.write(folder, "no_crs", ten)),
             Contains("E-REF georeference = no coordinate reference system: expected one in a .prj "
                      "file beside the grid"));
  grid.wkt = "LOCAL_CS[\"site grid\",UNIT[\"metre\",1]]";
  CHECK_THAT(refusal_of(grid.write(folder, "site", ten)), Contains("E-REF"));
  AsciiGrid globe{36, 18, -180.0, -90.0, 10.0};
  CHECK_THAT(refusal_of(globe.write(folder, "globe", ten)), Contains("E-UNSUPPORTED"));
  AsciiGrid far{4, 4, 11.0, 147.0, 0.01};
  CHECK_THAT(refusal_of(far.write(folder, "far", ten)), Contains("E-REF"));
}

TEST_CASE("A raster beyond web Mercator is refused, where GDAL would not end", "[raster_file]") {
  const TemporaryFolder folder;
  AsciiGrid grid{4, 4, 1e300, 0.0, 1e299};
  grid.wkt =
      "PROJCS[\"WGS_1984_Web_Mercator_Auxiliary_Sphere\",GEOGCS[\"GCS_WGS_1984\","
      "DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137,298.257223563]],"
      "PRIMEM[\"Greenwich\",0],UNIT[\"Degree\",0.0174532925199433]],"
      "PROJECTION[\"Mercator_Auxiliary_Sphere\"],PARAMETER[\"False_Easting\",0],"
      "PARAMETER[\"False_Northing\",0],PARAMETER[\"Central_Meridian\",0],"
      "PARAMETER[\"Standard_Parallel_1\",0],PARAMETER[\"Auxiliary_Sphere_Type\",0],"
      "UNIT[\"Meter\",1]]";
  CHECK_THAT(refusal_of(grid.write(folder, "mercator", [](int, int) { return std::string("10"); })),
             Contains("E-REF"));
}

TEST_CASE("Missing, foreign and damaged raster files are refused", "[raster_file]") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of(folder.path() / "nothing.tif"), Contains("E-IO"));
  CHECK_THAT(refusal_of(folder.path()), Contains("E-IO"));
  CHECK_THAT(refusal_of("/vsicurl/http://localhost/x.tif"), Contains("E-IO"));
  CHECK_THAT(refusal_of(folder.write("text.tif", "this is no raster")), Contains("E-PARSE"));
  CHECK_THAT(refusal_of(folder.write("empty.hgt", "")), Contains("E-PARSE"));
  CHECK_THAT(refusal_of(folder.write("x.vrt", "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"/>")),
             Contains("E-PARSE"));
  const AsciiGrid grid{30, 30, 11.0, 47.0, 0.01};
  const auto file = grid.write(folder, "whole", [](int, int) { return std::string("250"); });
  const std::string whole = core::read_file(file, 1U << 20U);
  for (const double part : {0.3, 0.6, 0.97})
    CHECK_THAT(
        refusal_of(folder.write(
            "whole.asc",
            whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))))),
        Contains("E-PARSE"));
}

// GDAL opens the .prj and .aux.xml beside a raster by itself.
TEST_CASE("F05 a side file that is a link out of the folder is never opened", "[raster_file]") {
  const TemporaryFolder outside;
  outside.write("other.prj", tests::kWgs84Wkt);
  AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  grid.wkt = "";
  for (const char* side : {"dem.prj", "dem.asc.aux.xml", "dem.ovr"}) {
    const TemporaryFolder folder;
    const auto file = grid.write(folder, "dem", [](int, int) { return std::string("10"); });
    std::filesystem::create_symlink(outside.path() / "other.prj", folder.path() / side);
    CHECK_THAT(refusal_of(file), Contains("E-PATH side file") && Contains(side));
  }
  const TemporaryFolder folder;
  const auto file = grid.write(folder, "dem", [](int, int) { return std::string("10"); });
  folder.write("real.prj", tests::kWgs84Wkt);
  std::filesystem::create_symlink("real.prj", folder.path() / "dem.prj");
  CHECK(refusal_of(file) == "accepted");
  // The raster itself is no side file: who may read it is its caller's matter.
  const TemporaryFolder links;
  std::filesystem::create_symlink(outside.write("tiny.tif", tiny_geotiff(true, 1)),
                                  links.path() / "link.tif");
  CHECK(refusal_of(links.path() / "link.tif") == "accepted");
}

TEST_CASE("F05 a .PRJ beside a grid is looked at like a .prj", "[raster_file]") {
  const TemporaryFolder folder;
  AsciiGrid grid{4, 4, 11.0, 47.0, 0.01};
  grid.wkt = "";
  const auto file = grid.write(folder, "dem", [](int, int) { return std::string("10"); });
  folder.write("dem.PRJ", "+proj=longlat +nadgrids=grid.gsb");
  CHECK_THAT(refusal_of(file), Contains("E-PATH side file = dem.PRJ"));
}

TEST_CASE("A GeoTIFF cut anywhere is refused", "[raster_file]") {
  const TemporaryFolder folder;
  const std::string whole = tiny_geotiff(true, 1);
  REQUIRE(refusal_of(folder.write("whole.tif", whole)) == "accepted");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    CHECK_THAT(refusal_of(folder.write("cut.tif", whole.substr(0, length))), Contains("E-"));
  }
}

TEST_CASE("A header that claims a huge raster is refused before memory is taken", "[raster_file]") {
  const TemporaryFolder folder;
  folder.write("huge.prj", tests::kWgs84Wkt);
  const auto file = folder.write("huge.asc",
                                 "ncols 20000\nnrows 20000\nxllcorner 11\nyllcorner 47\n"
                                 "cellsize 0.00001\nNODATA_value -9999\n1 2 3\n");
  CHECK_THAT(refusal_of(file), Contains("E-LIMIT") && Contains("20000 x 20000"));
}

}  // namespace fanbeam::terrain
