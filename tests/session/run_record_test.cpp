// What run.json tells of how a run was made: what was set beside what the files say, and the sampling in
// use.
#include "session/records/run_record.h"

#include <catch2/catch.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "core/units.h"
#include "session/records/conditions_json.h"
#include "session/records/record_json.h"
#include "session/session.h"
#include "tests/processor_time.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

std::unique_ptr<session::Session> opened(const TemporaryFolder& folder,
                                         const renderer::CasterWish caster,
                                         const renderer::Readings& read = {}) {
  folder.write("scene.toml", tests::kSmallScene);
  core::ProblemList problems;
  session::Setup setup{.shipped = FANBEAM_SOURCE_DIR};
  setup.build.caster = caster;
  setup.build.read = read;
  return std::make_unique<session::Session>(folder.path(), setup, problems);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("What was set since a scene was opened is told, and what is set back is not",
          "[records]") {
  const TemporaryFolder folder;
  const auto session = opened(folder, renderer::CasterWish::automatic);
  const auto told = [&] {
    return session::changed_conditions_json(*session->opened(), *session->scene());
  };
  CHECK(told().empty());
  const atmosphere::Weather own = session->scene()->weather;
  atmosphere::Weather weather = own;
  weather.visibility_m.reset();
  weather.rain_rate_mm_per_h = 20.0;
  session->set(weather);
  CHECK(told() == R"({"weather":{"visibility_m":null,"rain_rate_mm_per_h":20.0}})");
  session->set(own);
  session->set(materials::SurfaceState::wet);
  CHECK(told() == R"({"weather":{"surface":"wet"}})");
  session->set(materials::SurfaceState::dry);
  session->set(session::SensorSettings{
      .high_dB = 0.0, .cscope_mode = sensors::Display::CScopeMode::shadow, .noise_figure = 100.0});
  CHECK(told() ==
        R"({"sensor":{"display_high_dB":0.0,"cscope_mode":"shadow","noise_figure_dB":20.0}})");
  session->set(session::SensorSettings{});
  const session::TargetState truck{.name = "truck",
                                   .position = {core::radians(52.002), core::radians(10.0), 60.0},
                                   .rcs = materials::ConstantRcs{100.0},
                                   .swerling = core::Swerling::case1};
  session->set(std::span(&truck, 1));
  // The scene's own lights stand where they stood.
  CHECK(told().starts_with(
      R"({"targets":[{"name":"truck","rcs":{"shape":"constant","rcs_m2":100.0},"swerling":1,)"
      R"("path":[{"time_s":0.0,"latitude_deg":52.00)"));
  session->set(std::span<const session::TargetState>());
  CHECK(told().empty());
}

TEST_CASE("run.json has what was set beside its input, and the fingerprint knows it", "[records]") {
  const TemporaryFolder folder;
  const auto session = opened(folder, renderer::CasterWish::automatic);
  session::RunRecord record;
  const std::string before = session::input_fingerprint(*session->scene(), record);
  CHECK_FALSE(has(session::run_json(*session->scene(), record), "\"set\":"));
  record.set = R"({"weather":{"humidity":0.5}})";
  CHECK(has(session::run_json(*session->scene(), record),
            " \"set\": {\n  \"weather\": {\n   \"humidity\": 0.5\n  }\n },\n"));
  CHECK(session::input_fingerprint(*session->scene(), record) != before);
}

TEST_CASE("Bounds of the plan are of the input only where frames decide by them", "[records]") {
  const TemporaryFolder folder;
  const auto asked = opened(folder, renderer::CasterWish::automatic, {.detections = true});
  const auto plain = opened(folder, renderer::CasterWish::automatic);
  for (const bool per_frame : {false, true}) {
    INFO(per_frame);
    session::RunRecord record;
    record.plan_per_frame = per_frame;
    const bool same = session::input_fingerprint(*asked->scene(), record) ==
                      session::input_fingerprint(*plain->scene(), record);
    CHECK(same == !per_frame);
  }
}

// Its caster was that of the scene, slices, and the passes stood nowhere.
TEST_CASE("A reference of a scene of slices is told as the rays that it is", "[records]") {
  const TemporaryFolder folder;
  const auto session = opened(folder, renderer::CasterWish::profile);
  const auto scene = session->scene();
  REQUIRE(scene->caster.chosen == renderer::CasterKind::profile);
  session::RunRecord record;
  record.choice = session::choose_sampling({.reference = true}, *scene, session->seed(), {}, {});
  const std::string run = session::run_json(*scene, record);
  CHECK(has(run, "\"chosen\": \"rays\""));
  CHECK(has(run, "\"reason\": \"a reference is always made of rays\""));
  CHECK(has(run, "\"rays_per_cell_and_column\": 2048.0"));
  CHECK(has(run, "\"jittered_passes\": 16"));
  CHECK_FALSE(has(run, "slices_per_"));
  // Seed and rows stood in no fingerprint: a run with another jitter kept the frames that were there.
  const renderer::Sampling asked = record.choice.sampling;
  const std::string before = session::input_fingerprint(*scene, record);
  const auto keeps = [&](const auto& change) {
    record.choice.sampling = asked;
    change(record.choice.sampling);
    return session::input_fingerprint(*scene, record) == before;
  };
  CHECK(keeps([](renderer::Sampling&) {}));
  CHECK_FALSE(keeps([](renderer::Sampling& one) { one.jittered_passes = 4; }));
  CHECK_FALSE(keeps([](renderer::Sampling& one) { ++one.seed; }));
  CHECK_FALSE(keeps([](renderer::Sampling& one) { one.largest_step_rows = 0.5; }));
}

TEST_CASE("Settings stand in the order of the file, a key that is there twice once", "[records]") {
  const core::ResolvedConfig settings = {
      {"b", 1.5}, {"a", true}, {"c", std::string("text")}, {"a", false}};
  CHECK(session::resolved_json<nlohmann::ordered_json>(settings).dump() ==
        R"({"b":1.5,"a":false,"c":"text"})");
  CHECK(session::resolved_json<nlohmann::ordered_json>({}).dump() == "{}");
}

// Every key was looked for in the list of all before it: 10 000 targets took half a minute.
TEST_CASE("A scene of ten thousand targets is recorded at once", "[records]") {
  core::ResolvedConfig settings;
  for (int i = 0; i < 200'000; ++i)
    settings.emplace_back("target[" + std::to_string(i) + "].rcs_m2", 10.0);
  const double begin_s = tests::processor_time_s();
  CHECK(session::resolved_json<nlohmann::ordered_json>(settings).size() == settings.size());
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
}
