#include "benchmarks/bench_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "benchmarks/process_memory.h"
#include "session/session.h"

namespace fanbeam::benchmarks {
namespace {

namespace fs = std::filesystem;

void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

}  // namespace

renderer::Effects BenchScene::effects() const {
  return renderer::without_draws(renderer::effects_of(scene->plan, 1));
}

renderer::Effects BenchScene::noise_alone() const {
  constexpr auto kNoise = core::EffectId::thermal_noise;
  return {core::EffectSet{}.with(kNoise, scene->plan.runs(kNoise))};
}

std::string data_folder() {
  const char* variable = std::getenv("FANBEAM_DATA");
  if (variable != nullptr && *variable != '\0') return variable;
  return (fs::path(FANBEAM_SOURCE_DIR) / ".." / "shared" / "data").lexically_normal().string();
}

std::set<std::string> shipped_scenes() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(FANBEAM_SOURCE_DIR) / "scenes"))
    if (fs::exists(entry.path() / "scene.toml")) names.insert(entry.path().filename().string());
  return names;
}

std::unique_ptr<session::Session> open(const std::string& name,
                                       const scenes::BuildOptions& options) {
  const fs::path shipped = FANBEAM_SOURCE_DIR;
  core::ProblemList problems;
  const session::Setup setup{.shipped = shipped, .data_folders = {data_folder()}, .build = options};
  return std::make_unique<session::Session>(shipped / "scenes" / name, setup, problems);
}

std::shared_ptr<const scenes::Scene> build(const std::string& name,
                                           const scenes::BuildOptions& options) {
  return open(name, options)->scene();
}

std::optional<BenchScene> load(const std::string& name, const scenes::BuildOptions& options) {
  fmt::print(stderr, "building {}\n", name);
  forget_peak_memory();
  const double before_bytes = process_memory_bytes("VmRSS");
  BenchScene result;
  result.name = name;
  try {
    result.scene = build(name, options);
  } catch (const core::InputError& error) {
    const auto& problems = error.problems();
    const bool only_missing =
        std::all_of(problems.begin(), problems.end(), [](const core::Problem& problem) {
          return !problem.is_error() || problem.code == core::code(core::ErrorClass::io);
        });
    if (!only_missing) throw;
    fmt::print(stderr, "[skipped] {} needs data that are not in {}\n", name, data_folder());
    return std::nullopt;
  }
  renderer::render_frame(result.scene->world, renderer::sampling_for(renderer::kDefaultRaysPerCell),
                         {}, result.noise_alone(), view_at(result, 2500.0).pose);
  result.peak_memory_bytes = process_memory_bytes("VmHWM") - before_bytes;
  return result;
}

std::vector<int> spread_frames(const scenes::Scene& scene, int most) {
  const int count = std::min(most, scene.frame_count());
  std::vector<int> frames;
  for (int i = 0; i < count; ++i) frames.push_back((2 * i + 1) * scene.frame_count() / (2 * count));
  return frames;
}

View view_at(const BenchScene& scene, double distance_m) {
  View view;
  view.scene = &scene;
  const auto ground_distance_m = [](const renderer::FramePose& pose) {
    return std::hypot(pose.position_m.x, pose.position_m.y);
  };
  double nearest_m = 1e300;
  double last_m = 1e300;
  for (int frame = 0; frame < scene.scene->frame_count(); ++frame) {
    const renderer::FramePose pose = scene.scene->frame_pose(frame);
    const double at_m = ground_distance_m(pose);
    if (at_m > last_m) break;  // behind the threshold
    last_m = at_m;
    if (std::abs(at_m - distance_m) >= nearest_m) continue;
    nearest_m = std::abs(at_m - distance_m);
    view.frame = frame;
    view.pose = pose;
  }
  view.distance_m = ground_distance_m(view.pose);
  view.height_m = view.pose.position_m.z;
  view.antenna = renderer::antenna_of(view.sensor(), view.pose);
  return view;
}

}  // namespace fanbeam::benchmarks
