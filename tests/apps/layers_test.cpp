// Ground truth as files: layers by name, numbers that layers.json names.
#include <algorithm>
#include <set>

#include "core/image.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using tests::json_of;
using tests::quoted;
using tests::run_fanbeam;
namespace fs = std::filesystem;

namespace {

const fs::path kTruthOut = fs::path(FANBEAM_BINARY_DIR) / "layers_test";

const std::vector<double>& layer(const core::Image& image, const std::string& name) {
  const auto found =
      std::find_if(image.layers.begin(), image.layers.end(),
                   [&](const core::Image::Layer& each) { return each.name == name; });
  INFO(name);
  REQUIRE(found != image.layers.end());
  return found->values;
}

}  // namespace

TEST_CASE("render writes layers whose numbers layers.json names", "[layers]") {
  const fs::path out = kTruthOut / "out";
  fs::remove_all(kTruthOut);
  REQUIRE(run_fanbeam("render braunschweig-26 --frames 971 --products layers,cscope_layers -q "
                      "-o " +
                      quoted(out))
              .exit_code == 0);
  const nlohmann::json names = json_of(out / "layers.json");
  const core::Image truth = core::read_image(out / "layers" / "00971.exr");
  CHECK(truth.columns == 164);
  CHECK(truth.rows == 524);
  CHECK(truth.layers.size() == 7);
  std::set<std::string> objects;
  for (const double id : layer(truth, "object_id"))
    objects.insert(names["objects"].at(static_cast<std::size_t>(id)).get<std::string>());
  for (const char* seen : {"terrain", "runway 08/26", "runway 08/26 markings", "runway light"})
    CHECK(objects.contains(seen));
  std::set<std::string> materials;
  for (const double id : layer(truth, "material_id"))
    if (id >= 0.0) materials.insert(names["materials"].at(static_cast<std::size_t>(id)));
  CHECK(materials.contains("paint"));
  for (const core::Image::Layer& each : truth.layers) CHECK(names["layers"].contains(each.name));
  // Lit from the first cell that the beam reaches on; the top row is the farthest.
  const std::vector<double>& lit = layer(truth, "visibility_share");
  CHECK(*std::max_element(lit.begin(), lit.end()) == 1.0);
  const std::vector<double>& elevation_deg = layer(truth, "elevation_deg");
  const auto at = [](int row) { return static_cast<std::size_t>(row * 164 + 82); };
  CHECK(elevation_deg[at(500)] < elevation_deg[at(250)]);

  const core::Image by_elevation = core::read_image(out / "cscope_layers" / "00971.exr");
  CHECK(by_elevation.layers.size() == 7);
  const std::vector<double>& range_m = layer(by_elevation, "range_m");
  CHECK(*std::max_element(range_m.begin(), range_m.end()) <= 3700.0 + 2 * 6.68);

  CHECK(json_of(out / "run.json")["files"] == nlohmann::json({"layers.json"}));
}

TEST_CASE("Truth by elevation is refused for a C-scope that draws none", "[layers]") {
  const tests::TemporaryFolder folder;
  std::string scene = tests::bytes_of(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml");
  folder.write("scene.toml", scene + "\n[display]\ncscope_mode = \"flat_earth\"\n");
  const tests::Result result =
      run_fanbeam("render " + quoted(folder.path()) + " --products cscope_layers -o " +
                  quoted(kTruthOut / "none"));
  INFO(result.output);
  CHECK(result.exit_code == 3);
  CHECK(result.output.find("E-UNSUPPORTED C-scope layers, which labels") != std::string::npos);
  CHECK(result.output.find("cscope_mode = \"true_elevation\"") != std::string::npos);
}

TEST_CASE("Truth is compared in its own unit: what has no decibels differs all the same",
          "[layers]") {
  fs::create_directories(kTruthOut);
  const auto written = [](const char* name, const char* layer, double value) {
    core::write_exr(kTruthOut / name, {2, 1, {{layer, {value, value}}}}, {});
    return quoted(kTruthOut / name);
  };
  const std::string dark = written("a.exr", "nrcs_dB", -30.0);
  const tests::Result differs =
      run_fanbeam("compare " + dark + " " + written("b.exr", "nrcs_dB", -20.0));
  INFO(differs.output);
  CHECK(differs.exit_code == 1);
  CHECK(differs.output.find("mean +10.0000, RMS 10.0000, largest 10.000 dB") != std::string::npos);
  CHECK(run_fanbeam("compare " + dark + " " + dark).exit_code == 0);
  // A power that doubles is 3 dB; an elevation of twice as much is what it is.
  for (const auto& [layer, told] : {std::pair{"power_W", "RMS 3.0103, largest 3.010 dB"},
                                    std::pair{"elevation_deg", "RMS 2.0000, largest 2.000 deg"}}) {
    const std::string from = written("from.exr", layer, 2.0), to = written("to.exr", layer, 4.0);
    const tests::Result result = run_fanbeam("compare " + from + " " + to);
    INFO(result.output);
    CHECK(result.output.find(told) != std::string::npos);
  }
}
