// The shipped scenes: what their plans leave out changes no pixel by more than the plan says, which
// at the default accuracy is nothing that an eight-bit picture shows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>

#include "renderer/frame_renderer.h"
#include "renderer/plan/plan.h"
#include "sensors/display/display.h"
#include "tests/scenes/effect_scene.h"
#include "tests/shared_data.h"

namespace fanbeam::tests {
namespace {

const std::filesystem::path kSource = FANBEAM_SOURCE_DIR;

std::set<std::string> running(const core::EffectPlan& plan) {
  std::set<std::string> names;
  for (const core::EffectDecision& each : plan.decisions)
    if (each.on) names.emplace(name_of(each.effect));
  return names;
}

double bounds_left_out_grey(const core::EffectPlan& plan) {
  double sum = 0.0;
  for (const core::EffectDecision& each : plan.decisions)
    if (!each.on) sum += each.bound_grey;
  return sum;
}

std::vector<renderer::Frame> pictures(const scenes::Scene& scene, const core::EffectPlan& plan) {
  const renderer::FrameRenderer frames(scene.world, renderer::sampling_for(0.5), {},
                                       renderer::effects_of(plan, 1));
  std::vector<renderer::Frame> shown;
  const int count = scene.frame_count();
  for (const int frame : {0, count / 2, count - 1})
    shown.push_back(frames.render(scene.frame_pose(frame)));
  return shown;
}

// A scene that runs everything goes over to a plan that runs fewer losses, without being built
// anew.
void leave_out_losses(const core::EffectPlan& plan, scenes::Scene& scene) {
  atmosphere::Weather weather = scene.facts.weather;
  weather.simulate_gas = plan.runs(core::EffectId::gas);
  weather.simulate_fog = plan.runs(core::EffectId::fog);
  weather.simulate_rain = plan.runs(core::EffectId::rain);
  weather.simulate_snow = plan.runs(core::EffectId::snow);
  const double frequency_Hz = scene.world.sensor.waveform.frequency_Hz;
  scene.world.attenuation = atmosphere::PathAttenuation(weather, frequency_Hz);
  scene.world.rain_cells.reset();
  const atmosphere::RainCells cells(weather, frequency_Hz);
  if (!cells.empty()) scene.world.rain_cells = cells;
}

int largest_step(const core::Picture8& a, const core::Picture8& b) {
  int worst = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    worst =
        std::max(worst, std::abs(static_cast<int>(a.pixels[i]) - static_cast<int>(b.pixels[i])));
  return worst;
}

// Returns whether a plan left something out.
bool check_scene(const std::filesystem::path& folder,
                 const std::vector<std::filesystem::path>& data) {
  INFO(folder.filename().string());
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder, {kSource, data, {}}, problems);
  scenes::BuildOptions options;
  options.wishes = renderer::parse_effect_wishes("all");
  const auto scene = scenes::build_scene(description, options, problems);
  const std::vector<renderer::Frame> all = pictures(*scene, scene->plan);
  const sensors::Sensor& sensor = scene->world.sensor;
  bool left_out = false;
  for (const double accuracy_grey : {0.5, 2.0, 8.0}) {
    const core::EffectPlan plan = renderer::plan(scene->facts, accuracy_grey, {});
    INFO("accuracy " << accuracy_grey << '\n' << plan_text(plan));
    CHECK(bounds_left_out_grey(plan) <= accuracy_grey / 2.0);
    if (running(plan) == running(scene->plan)) continue;
    left_out = true;
    // Stages are left out by pictures(); what else can differ would have to be built.
    REQUIRE(plan.runs(core::EffectId::surface_state) ==
            scene->plan.runs(core::EffectId::surface_state));
    REQUIRE(plan.runs(core::EffectId::side_lobes) == scene->plan.runs(core::EffectId::side_lobes));
    leave_out_losses(plan, *scene);
    const std::vector<renderer::Frame> planned = pictures(*scene, plan);
    for (std::size_t i = 0; i < planned.size(); ++i) {
      CHECK(largest_difference_grey(planned[i], all[i]) <= bounds_left_out_grey(plan));
      if (accuracy_grey > 2.0) continue;
      CHECK(largest_step(sensors::bscope_picture(sensor, planned[i].bscope_grey),
                         sensors::bscope_picture(sensor, all[i].bscope_grey)) <= 1);
      CHECK(largest_step(sensors::cscope_picture(sensor, planned[i].cscope_grey),
                         sensors::cscope_picture(sensor, all[i].cscope_grey)) <= 1);
    }
  }
  return left_out;
}

}  // namespace

TEST_CASE("Shipped scenes look the same with the plan and with everything on",
          "[effects][shipped]") {
  std::vector<std::filesystem::path> data;
  if (const auto dem = shared_data("lowi-innsbruck/dem_lowi_wgs84_1arcsec.tif"))
    data.push_back(dem->parent_path().parent_path());
  int scenes = 0, with_something_left_out = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "scenes")) {
    if (!std::filesystem::exists(entry.path() / "scene.toml")) continue;
    const std::string name = entry.path().filename().string();
    const bool needs_data = name.starts_with("innsbruck") || name.starts_with("keflavik");
    if (needs_data && data.empty()) continue;
    ++scenes;
    if (check_scene(entry.path(), data)) ++with_something_left_out;
  }
  CHECK(scenes >= 4);
  CHECK(with_something_left_out >= 3);
}

}  // namespace fanbeam::tests
