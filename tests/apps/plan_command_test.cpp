// fanbeam plan as a user meets it.
#include <cmath>

#include "renderer/plan/effect_catalogue.h"
#include "scenes/frame_plan.h"
#include "tests/apps/plain_scene.h"
#include "tests/apps/program.h"
#include "tests/scenes/far_approach.h"

using namespace fanbeam::tests;
namespace core = fanbeam::core;
namespace scenes = fanbeam::scenes;
using Json = nlohmann::json;

namespace {

Json json_plan(const std::string& words) {
  const Result result = run_fanbeam("plan -q --json " + words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return Json::parse(result.output);
}

}  // namespace

TEST_CASE("plan decides as render does", "[plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  for (const std::string& scene : {std::string("flat-grass"), quoted(folder.path())})
    for (const char* options : {"", "--effects -gas,+speckle", "--effects all,-multipath",
                                "--products bscope,power,detections"}) {
      INFO(scene << ' ' << options);
      const Result render = run_fanbeam("render -q --frames 0 -o " + quoted(folder.path() / "out") +
                                        " " + scene + " " + options);
      INFO(render.output);
      REQUIRE(render.exit_code == 0);
      const Json rendered = json_of(folder.path() / "out" / "run.json");
      const Json planned = json_plan(scene + " " + options);
      REQUIRE(planned["plan"].size() == rendered["plan"].size());
      REQUIRE(planned["plan"].size() == fanbeam::renderer::effect_catalogue().size());
      for (std::size_t i = 0; i < planned["plan"].size(); ++i)
        for (const char* key : {"effect", "on", "reason", "bound_grey"})
          CHECK(planned["plan"][i][key] == rendered["plan"][i][key]);
      CHECK(planned["scene"] == rendered["scene"]);
      CHECK(planned["sensor"] == rendered["sensor"]);
      CHECK(planned["caster"]["reason"] == rendered["caster"]["reason"]);
    }
}

TEST_CASE("plan --json names where the law comes from that the weather goes by", "[plan]") {
  const TemporaryFolder folder;
  folder.write("scene.toml",
               kPlainOverGrass + "[weather]\nrain_rate_mm_per_h = 5.0\nrain_law = \"mie\"\n");
  const Json plan = json_plan(quoted(folder.path()));
  for (const Json& row : plan["plan"])
    if (row["effect"] == "rain")
      CHECK(row["source"] == "Mie scattering of water spheres (Bohren and Huffman 1983)");
}

TEST_CASE("The table fits 100 columns and names every effect with its reason", "[plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  const Result result = run_fanbeam("plan --per-frame --frames ::100 " + quoted(folder.path()));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  for (const std::string& line : lines_of(result.output)) {
    INFO(line);
    CHECK(line.size() <= 100);
    CHECK_FALSE(line.ends_with(' '));
  }
  for (const fanbeam::renderer::Effect& effect : fanbeam::renderer::effect_catalogue())
    CHECK(result.output.find("\n" + std::string(effect.name()) + " ") != std::string::npos);
  for (const char* word :
       {"scene        far", "sensor       HiVision", "0.5 grey levels: 0.25 for",
        "caster       profile: over buildings slices come", "planned in   ", "the scene has no fog",
        "frame by frame, ", "  frames 0 to ", "double-bounce off,"})
    CHECK(result.output.find(word) != std::string::npos);
  for (const std::string& line : lines_of(result.output))
    if (line.starts_with("fog ")) CHECK(line.find("off      -      -  the scene has") < 40);
  const Result quiet = run_fanbeam("plan -q " + quoted(folder.path()));
  CHECK(quiet.output.find("why") != std::string::npos);
  CHECK(quiet.output.find("grey, dB:") == std::string::npos);
}

TEST_CASE("The budget adds up", "[plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  for (const double grey : {0.5, 40.0}) {
    const Json plan = json_plan(quoted(folder.path()) + " --accuracy " + core::number_text(grey));
    double left_out = 0.0;
    for (const Json& row : plan["plan"])
      if (!row["on"]) left_out += row["bound_grey"].get<double>();
    CHECK(plan["accuracy"]["grey"] == grey);
    CHECK(plan["accuracy"]["left_out_grey"].get<double>() == Approx(left_out));
    CHECK(left_out <= grey / 2.0);
    CHECK(plan["accuracy"]["for_effects_grey"] == grey / 2.0);
    CHECK(plan["planning_ms"] > 0.0);
  }
}

TEST_CASE("--per-frame tells what the frames' plans say, frame by frame", "[plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  const Json plan = json_plan(quoted(folder.path()) + " --per-frame --frames 0:1200:7");
  const auto scene = built_for_frames(folder);
  std::size_t span = 0;
  const Json& spans = plan["per_frame"];
  REQUIRE(spans.size() >= 3);
  CHECK(spans[0]["first_frame"] == 0);
  for (int frame = 0; frame < std::min(1200, scene->frame_count()); frame += 7) {
    if (frame > spans[span]["last_frame"]) ++span;
    REQUIRE(span < spans.size());
    REQUIRE(frame >= spans[span]["first_frame"]);
    INFO("frame " << frame);
    std::string told, expected;
    for (const Json& off : spans[span]["left_out"]) told += off["effect"].get<std::string>() + " ";
    const core::EffectPlan own = scenes::frame_plan(*scene, frame);
    for (const core::EffectDecision& decision : own.decisions)
      if (decision.on != scene->plan.runs(decision.effect))
        expected += std::string(name_of(decision.effect)) + " ";
    CHECK(told == expected);
  }
  CHECK(span + 1 == spans.size());
}

TEST_CASE("Measured costs are numbers for what can be switched, and missing for what cannot",
          "[plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  const Json plan = json_plan(quoted(folder.path()) + " --measure --repetitions 2 --frames -1");
  CHECK(plan["measured"]["repetitions"] == 2);
  CHECK(plan["measured"]["frames"].size() == 1);
  CHECK(plan["measured"]["frame_ms"] > 0.0);
  for (const Json& row : plan["plan"]) {
    INFO(row.dump());
    const std::string effect = row["effect"];
    const bool impossible = effect == "fog" || effect == "snow" || effect == "surface-state" ||
                            effect == "side-lobes" || effect == "range-response" ||
                            effect == "swerling";
    REQUIRE(row.contains("cost_ms") == !impossible);
    if (impossible) continue;
    CHECK(std::isfinite(row["cost_ms"].get<double>()));
    CHECK(row["cost_error_ms"].get<double>() >= 0.0);
  }
  const Result table =
      run_fanbeam("plan --measure --repetitions 1 --frames -1 " + quoted(folder.path()));
  CHECK(table.output.find("ms a frame  why") != std::string::npos);
  CHECK(table.output.find("+-") != std::string::npos);
}

TEST_CASE("plan refuses what it cannot use, with the exit codes of every command", "[plan]") {
  for (const char* words : {"plan flat-grass --effects +magic", "plan flat-grass --products sounds",
                            "plan flat-grass --accuracy -1", "plan flat-grass --accuracy much",
                            "plan flat-grass --frames 0:1", "plan flat-grass --repetitions 3",
                            "plan flat-grass --measure --repetitions 0",
                            "plan flat-grass --per-frame --frames 7", "plan --nope"}) {
    INFO("fanbeam " << words);
    const Result result = run_fanbeam(words);
    INFO(result.output);
    CHECK(result.exit_code == 2);
    CHECK_FALSE(result.output.empty());
  }
  CHECK(run_fanbeam("plan flat-grass --effects +magic").output.find("+double-bounce") !=
        std::string::npos);
  const TemporaryFolder folder;
  folder.write("scene.toml", "[scene]\nname = \"bad\"\n");
  const Result bad = run_fanbeam("plan --json " + quoted(folder.path()));
  CHECK(bad.exit_code == 3);
  CHECK(bad.output.find("E-REF scene.origin") != std::string::npos);
  CHECK(run_fanbeam("plan no-such-scene").exit_code == 4);
  const Result help = run_fanbeam("plan --help");
  CHECK(help.exit_code == 0);
  for (const char* option :
       {"--json", "--accuracy", "--effects", "--per-frame", "--measure", "--frames", "--sensor",
        "--data", "--threads", "--quiet", "--version", "--log-level"})
    CHECK(help.output.find(option) != std::string::npos);
  CHECK(help.output.find("--repetitions") == std::string::npos);
}
