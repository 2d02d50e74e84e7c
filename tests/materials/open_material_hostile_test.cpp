#include <catch2/catch.hpp>
#include <string>

#include "tests/materials/open_material_files.h"

namespace fanbeam::materials {
namespace {

using Lines = std::vector<std::string>;
using tests::open_surface;
using tests::OpenMaterialFolder;
using tests::told;

// What is told about the material after one replacement in one file; a material with a problem of
// its own must be gone.
Lines after(const std::string& file, const std::string& from, const std::string& to,
            const std::string& name = "Concrete") {
  const OpenMaterialFolder folder;
  folder.replace(file, from, to);
  const tests::OpenSurface result = open_surface(folder.path(), name);
  if (file.starts_with("materials/")) CHECK_FALSE(result.surface);
  return told(result);
}

TEST_CASE("Files that are not there or lie outside the folder are refused",
          "[materials][open_material]") {
  REQUIRE(after("block.xoma", "block.xomm", "missing.xomm") == Lines{"E-IO missing.xomm "});
  REQUIRE(after("block.xoma", "block.xomm", "../block.xomm") ==
          Lines{"E-PATH block.xoma /materialMappingUri"});
  REQUIRE(after("block.xomm", "materials/concrete.xomp", "/etc/concrete.xomp") ==
          Lines{"E-PATH block.xomm /materialMapping/2/1"});
  REQUIRE(after("block.xomm", "materials/concrete.xomp", "materials/../../x.xomp") ==
          Lines{"E-PATH block.xomm /materialMapping/2/1"});
  REQUIRE(after("block.xomm", "materials/concrete.xomp", "https://x.org/concrete.xomp") ==
          Lines{"E-PATH block.xomm /materialMapping/2/1"});
  REQUIRE(after("block.xomm", "materials/concrete.xomp", "%2e%2e/concrete.xomp") ==
          Lines{"E-PATH block.xomm /materialMapping/2/1"});
  REQUIRE(after("materials/concrete.xomp", "concrete_emp.xompt", "../../x_emp.xompt") ==
          Lines{"E-PATH concrete.xomp /materialProperties/electromagneticPropertiesUri"});
  REQUIRE(after("materials/panel.xomp", "panel_brdf.xompt", "no_brdf.xompt", "Panel") ==
          Lines{"E-IO no_brdf.xompt "});
  // From the material's folder back into the allowed one is no way out.
  const OpenMaterialFolder folder;
  folder.replace("materials/concrete.xomp", "concrete_emp.xompt",
                 "../materials/concrete_emp.xompt");
  REQUIRE(open_surface(folder.path(), "Concrete").surface);
}

TEST_CASE("A symbolic link out of the folder is refused", "[materials][open_material]") {
  const OpenMaterialFolder folder, elsewhere;
  std::filesystem::remove(folder.path() / "materials" / "concrete_emp.xompt");
  std::filesystem::create_symlink(elsewhere.path() / "materials" / "concrete_emp.xompt",
                                  folder.path() / "materials" / "concrete_emp.xompt");
  REQUIRE(told(open_surface(folder.path(), "Concrete")) ==
          Lines{"E-PATH concrete.xomp /materialProperties/electromagneticPropertiesUri"});
}

TEST_CASE("Wrong types and values are told under their JSON pointer",
          "[materials][open_material]") {
  const std::string xomp = "materials/concrete.xomp", emp = "materials/concrete_emp.xompt";
  REQUIRE(after(xomp, "0.0005", "\"NaN\"") ==
          Lines{"E-PARSE concrete.xomp /materialProperties/surfaceRoughness/surfaceHeightRms"});
  REQUIRE(after(xomp, "0.0005", "-0.0005") ==
          Lines{"E-RANGE concrete.xomp /materialProperties/surfaceRoughness/surfaceHeightRms"});
  REQUIRE(after(xomp, "0.0005", "NaN") == Lines{"E-PARSE concrete.xomp JSON text"});
  REQUIRE(after(xomp, "0.0005", "1e999") == Lines{"E-NONFINITE concrete.xomp JSON text"});
  REQUIRE(after(xomp, "\"surfaceHeightRms\": 0.0005,", "") ==
          Lines{"E-REF concrete.xomp /materialProperties/surfaceRoughness/surfaceHeightRms"});
  REQUIRE(after(xomp, "\"concrete_emp.xompt\"", "[\"concrete_emp.xompt\"]") ==
          Lines{"E-PARSE concrete.xomp /materialProperties/electromagneticPropertiesUri"});
  REQUIRE(after(xomp, "\"concrete_emp.xompt\"", "\"concrete.txt\"") ==
          Lines{"E-RANGE concrete.xomp /materialProperties/electromagneticPropertiesUri"});
  REQUIRE(after(emp, "0.36]", "-0.36]") ==
          Lines{"E-RANGE concrete_emp.xompt /electromagneticProperties/3/6"});
  REQUIRE(after(emp, "0.36]", "\"0.36\"]") ==
          Lines{"E-PARSE concrete_emp.xompt /electromagneticProperties/3/6"});
  REQUIRE(after(emp, ", 0.36]", "]") ==
          Lines{"E-PARSE concrete_emp.xompt /electromagneticProperties/3"});
  REQUIRE(after(emp, "[0.01, 273", "[0.02, 273") ==
          Lines{"E-RANGE concrete_emp.xompt /electromagneticProperties/3/0"});
  REQUIRE(after(emp, "[0.004, 293", "[0.004, 203") ==
          Lines{"E-RANGE concrete_emp.xompt /electromagneticProperties/2"});
  REQUIRE(after("block.xomm", ", \"own reflectivity\"]", "]") ==
          Lines{"E-PARSE block.xomm /materialMapping/0"});
  REQUIRE(after("block.xomm", "\"own reflectivity\"", "7") ==
          Lines{"E-PARSE block.xomm /materialMapping/0/2"});
  REQUIRE(after("block.xomm", "\"Panel\"", "\"Concrete\"") ==
          Lines{"E-RANGE block.xomm /materialMapping/2/0"});
  REQUIRE(after("block.xoma", "\"Steel\"]", "\"Stell\"]") ==
          Lines{"E-REF block.xoma /materialReplacements/0/1"});
  REQUIRE(after("materials/panel_brdf.xompt", "0.05]", "-0.05]", "Panel") ==
          Lines{"E-RANGE panel_brdf.xompt /brdf/lookupTable/2/4"});
  REQUIRE(after("materials/panel_reflCoeff.xompt", "0.7,", "1.7,", "Panel") ==
          Lines{"E-RANGE panel_reflCoeff.xompt /reflectionCoefficient/lookupTable/0/5"});
}

TEST_CASE("Metadata that the standard requires are checked", "[materials][open_material]") {
  const std::string xomp = "materials/concrete.xomp";
  REQUIRE(after(xomp, "\"license\": \"Apache-2.0\",", "") ==
          Lines{"E-REF concrete.xomp /metadata/license"});
  REQUIRE(
      after(xomp, "\"openMaterial3dVersion\": \"1.0.0\"", "\"openMaterial3dVersion\": \"2.0.0\"") ==
      Lines{"E-UNSUPPORTED concrete.xomp /metadata/openMaterial3dVersion"});
  REQUIRE(after(xomp, "\"materialVersion\": \"1.0.0\"", "\"materialVersion\": \"1\"") ==
          Lines{"E-PARSE concrete.xomp /metadata/materialVersion"});
  REQUIRE(after(xomp, "00000000-", "0000000g-") == Lines{"E-PARSE concrete.xomp /metadata/uuid"});
  REQUIRE(after(xomp, "[\"fanbeam authors\"]", "[]") ==
          Lines{"E-PARSE concrete.xomp /metadata/authors"});
  REQUIRE(after(xomp, "\"metadata\"", "\"meta\"") == Lines{"E-REF concrete.xomp /metadata"});
}

TEST_CASE("Custom properties of ours are read strictly", "[materials][open_material]") {
  const std::string at = " /materialProperties/customProperties/fanbeam";
  const auto steel = [](const std::string& from, const std::string& to) {
    return after("materials/steel.xomp", from, to, "Steel");
  };
  REQUIRE(steel("\"nrcs\"", "\"ncrs\"") == Lines{"E-REF steel.xomp" + at + "/ncrs"});
  REQUIRE(steel("\"a\": 0.5", "\"A\": 0.5") ==
          Lines{"E-REF steel.xomp" + at + "/nrcs/0/A", "E-REF steel.xomp" + at + "/nrcs/0/a"});
  REQUIRE(steel("\"a\": 0.5", "\"a\": -0.5") == Lines{"E-RANGE steel.xomp" + at + "/nrcs/0/a"});
  REQUIRE(steel("\"c\": 8", "\"c\": 0.5") == Lines{"E-RANGE steel.xomp" + at + "/nrcs/0/c"});
  REQUIRE(steel("\"VV\"", "\"V\"") == Lines{"E-RANGE steel.xomp" + at + "/nrcs/1/polarisation"});
  REQUIRE(steel("[70, 82]", "[82, 70]") ==
          Lines{"E-RANGE steel.xomp" + at + "/nrcs/2/frequency_range_GHz"});
  REQUIRE(steel("[1, 10, 90]", "[1, 1, 90]") ==
          Lines{"E-RANGE steel.xomp" + at + "/nrcs/2/grazing_deg/1"});
  REQUIRE(steel("[1, 10, 90]", "[1, 10]") ==
          Lines{"E-RANGE steel.xomp" + at + "/nrcs/2/sigma0_dB"});
  REQUIRE(steel("[1, 10, 90]", "[]") == Lines{"E-RANGE steel.xomp" + at + "/nrcs/2/sigma0_dB"});
  REQUIRE(steel("[1, 10, 90]", "[0, 10, 90]") ==
          Lines{"E-RANGE steel.xomp" + at + "/nrcs/2/grazing_deg/0",
                "E-RANGE steel.xomp" + at + "/nrcs/2/sigma0_dB"});
}

TEST_CASE("All problems of a material and its tables are told together",
          "[materials][open_material]") {
  const OpenMaterialFolder folder;
  folder.replace("materials/steel.xomp", "0.0002", "true");
  folder.replace("materials/steel.xomp", "\"b\": 2", "\"b\": \"2\"");
  folder.replace("materials/panel_brdf.xompt", "\"license\"", "\"licence\"");
  const std::string properties = "/materialProperties/";
  REQUIRE(told(open_surface(folder.path(), "Steel")) ==
          Lines{"E-PARSE steel.xomp " + properties + "surfaceRoughness/surfaceHeightRms",
                "E-PARSE steel.xomp " + properties + "customProperties/fanbeam/nrcs/0/b",
                "E-REF panel_brdf.xompt /metadata/license"});
}

TEST_CASE("Depth, size and length of hostile files are capped", "[materials][open_material]") {
  const auto emp = [](const std::string& text) {
    const OpenMaterialFolder folder;
    folder.write("materials/concrete_emp.xompt", text);
    return told(open_surface(folder.path(), "Concrete"));
  };
  const std::string deep(100000, '[');
  REQUIRE(emp(deep) == Lines{"E-LIMIT concrete_emp.xompt nesting"});
  REQUIRE(emp("{\"x\": " + deep) == Lines{"E-LIMIT concrete_emp.xompt nesting"});
  // Brackets inside a text are none.
  REQUIRE(emp("{\"x\": \"" + deep + "\\\"[\"}") ==
          Lines{"E-REF concrete_emp.xompt /metadata",
                "E-REF concrete_emp.xompt /electromagneticProperties"});
  REQUIRE(emp(std::string((16u << 20) + 1, ' ')) == Lines{"E-LIMIT concrete_emp.xompt file size"});
  std::string rows = "[0]";
  for (int i = 0; i < 200000; ++i) rows += ",[0]";
  REQUIRE(emp("{\"metadata\": {}, \"electromagneticProperties\": [" + rows + "]}").back() ==
          "E-LIMIT concrete_emp.xompt /electromagneticProperties");
  REQUIRE(emp("") == Lines{"E-PARSE concrete_emp.xompt JSON text"});
  REQUIRE(emp("[]") == Lines{"E-PARSE concrete_emp.xompt JSON text"});
  REQUIRE(emp("{\"x\": \"\xff\xfe\"}") == Lines{"E-PARSE concrete_emp.xompt JSON text"});
  REQUIRE(emp("{} {}") == Lines{"E-PARSE concrete_emp.xompt JSON text"});
}

TEST_CASE("A broken file tells line and column", "[materials][open_material]") {
  const OpenMaterialFolder folder;
  folder.write("materials/concrete.xomp", "{\n  \"metadata\": {\n    \"name\": ?\n}}");
  const tests::OpenSurface result = open_surface(folder.path(), "Concrete");
  REQUIRE(result.problems.all().front().place.line == 3);
  REQUIRE(result.problems.all().front().place.column == 13);
}

TEST_CASE("Only assets and mappings are opened as such", "[materials][open_material]") {
  const tests::OpenSurface result =
      open_surface(tests::open_material_data(), "Steel", {}, "materials/steel.xomp");
  REQUIRE(told(result) == Lines{"E-UNSUPPORTED steel.xomp "});
}

}  // namespace
}  // namespace fanbeam::materials
