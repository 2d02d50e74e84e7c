// Shipped scenes and the views of them that are measured.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "renderer/plan/effects.h"
#include "scenes/scene.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::session {
class Session;
}

namespace fanbeam::benchmarks {

inline constexpr const char* kDefaultScene = "braunschweig-26";
inline constexpr const char* kCityScene = "innsbruck-26";
inline constexpr const char* kObstacleScene = "obstacle-field";
inline constexpr const char* kRainScene = "rain-94ghz";
// Before the threshold, of the views.
inline constexpr double kDistances_m[] = {2500.0, 1000.0};

struct BenchScene {
  std::string name;
  std::shared_ptr<const scenes::Scene> scene;
  // Highest resident memory while the scene was built and one frame rendered, over what the process
  // held before.
  double peak_memory_bytes = 0.0;

  // All that the plan asks for, as expected power: the whole picture.
  renderer::Effects effects() const;
  // Of surfaces and point targets alone: the mean noise, if the plan asks for it.
  renderer::Effects noise_alone() const;
};

// FANBEAM_DATA, else ../shared/data beside the source tree.
std::string data_folder();

// Those of the source tree, by name.
std::set<std::string> shipped_scenes();

// A shipped scene of the source tree. Throws core::InputError.
std::unique_ptr<session::Session> open(const std::string& name,
                                       const scenes::BuildOptions& options = {});
// The scene of that.
std::shared_ptr<const scenes::Scene> build(const std::string& name,
                                           const scenes::BuildOptions& options = {});

// The same with its memory; nothing, and a line on stderr, when its data are not there.
std::optional<BenchScene> load(const std::string& name, const scenes::BuildOptions& options = {});

// Numbers of at most `most` frames, evenly spread over the approach.
std::vector<int> spread_frames(const scenes::Scene& scene, int most);

// One frame of the approach.
struct View {
  const BenchScene* scene = nullptr;
  int frame = 0;
  double distance_m = 0.0;  // along the ground to the scene's origin, which is the threshold
  double height_m = 0.0;    // above it
  renderer::FramePose pose;
  sensors::AntennaFrame antenna;

  const renderer::World& world() const { return scene->scene->world; }
  const sensors::Sensor& sensor() const { return world().sensor; }
};

// The frame nearest to `distance_m` before the threshold.
View view_at(const BenchScene& scene, double distance_m);

}  // namespace fanbeam::benchmarks
