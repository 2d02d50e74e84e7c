// --isa: kernels and Embree alike go no further than the level asked for.
#include <filesystem>

#include "core/image.h"
#include "core/image_compare.h"
#include "core/machine.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using tests::json_of;
using tests::quoted;
using tests::run_fanbeam;
namespace fs = std::filesystem;

namespace {

const fs::path kLevelOut = fs::path(FANBEAM_BINARY_DIR) / "isa_test";

tests::Result render_grass(const std::string& folder, const std::string& words) {
  return run_fanbeam("render flat-grass --frames 0 --quiet --products bscope,power -o " +
                     quoted(kLevelOut / folder) + " " + words);
}

}  // namespace

TEST_CASE("Each level of the machine can be asked for, is recorded, and gives one picture",
          "[isa]") {
  fs::remove_all(kLevelOut);
  REQUIRE(render_grass("v2", "--isa v2").exit_code == 0);
  const nlohmann::json run = json_of(kLevelOut / "v2" / "run.json");
  CHECK(run["isa"] == "v2");
  CHECK(json_of(kLevelOut / "v2" / "timing.json")["isa"] == "x86-64-v2");
  REQUIRE(render_grass("free", "").exit_code == 0);
  CHECK_FALSE(json_of(kLevelOut / "free" / "run.json").contains("isa"));
  CHECK(json_of(kLevelOut / "free" / "timing.json")["isa"] == core::name_of(core::machine_level()));
  if (core::machine_level() < core::InstructionLevel::v3) return;
  REQUIRE(render_grass("v3", "--isa v3").exit_code == 0);
  CHECK(json_of(kLevelOut / "v3" / "timing.json")["isa"] == "x86-64-v3");
  const auto power = [](const std::string& folder) {
    return core::read_image(kLevelOut / folder / "power" / "00000.exr");
  };
  const auto layers = core::compare_images(power("v2"), power("v3"), "v2", "v3");
  // Not byte for byte: SSE4.2 has no fused multiply-add, so Embree's hits move in the last bit.
  CHECK(layers.front().rms_dB < 0.01);
  CHECK(layers.front().different > 0);
}

TEST_CASE("A level that the machine lacks is wrong usage, told with what it has", "[isa]") {
  const tests::Result wrong = render_grass("v5", "--isa v5");
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.output.find("v4") != std::string::npos);
  if (core::machine_level() == core::InstructionLevel::v4) return;
  const tests::Result lacking = render_grass("v4", "--isa v4");
  CHECK(lacking.exit_code == 2);
  CHECK(lacking.output.find("what this machine has: v2") != std::string::npos);
  CHECK_FALSE(fs::exists(kLevelOut / "v4"));
}
