// Another project's program: opens a scene, changes its weather and moves a target, renders three
// poses from two threads, and looks at the watts and at one frame's ground truth.
//
//   consumer SHIPPED SCENE
//
// SHIPPED is the folder with scenes/, sensors/ and materials/ (share/fanbeam below the prefix).
#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>

#include "core/image.h"
#include "sensors/display/display.h"
#include "session/session.h"

using namespace fanbeam;

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const std::filesystem::path shipped = argv[1];
  core::ProblemList problems;  // everything wrong at once, with file, line and column

  // Seconds: terrain, buildings, Embree's tree.
  session::Setup setup{.shipped = shipped};
  setup.build.read.power = true;  // its plan counts on somebody reading watts
  session::Session session(shipped / "scenes" / argv[2], setup, problems);

  // Milliseconds each; frames under way keep the conditions that they began with.
  const auto opened = session.scene();
  atmosphere::Weather weather = opened->weather;
  weather.rain_rate_mm_per_h = 10.0;
  session.set(weather);
  const core::Pose first = opened->trajectory->poses().front();
  session::TargetState truck{.name = "truck", .rcs = materials::ConstantRcs{50.0}};
  truck.position = opened->frame.to_geodetic(opened->frame.to_local_m(first.position) +
                                             glm::dvec3(0.0, 1000.0, -10.0));
  session.set(std::span(&truck, 1));

  // Any pose, from any thread.
  std::array<renderer::Frame, 3> frames;
  const auto render = [&](std::size_t i) {
    core::Pose pose = first;
    pose.position.height_m += 10.0 * static_cast<double>(i);
    frames[i] = session.render(pose, i, {.layers = i == 0});
  };
  std::thread other([&] { render(1); });
  render(0);
  render(2);
  other.join();

  // The truck drives on by 200 m, which moves its echo and nothing else.
  truck.position = opened->frame.to_geodetic(opened->frame.to_local_m(first.position) +
                                             glm::dvec3(0.0, 1200.0, -10.0));
  session.set(std::span(&truck, 1));
  const renderer::Frame later = session.render(first, 0, {});
  std::size_t moved = 0;
  for (std::size_t i = 0; i < later.bscope_W.size(); ++i)
    moved += later.bscope_W[i] != frames[0].bscope_W[i] ? 1 : 0;
  std::printf("%zu cells differ when the truck has moved\n", moved);
  if (moved == 0 || moved > later.bscope_W.size() / 10) return 1;

  core::write_png("bscope.png",
                  sensors::bscope_picture(opened->description.sensor, frames[0].bscope_grey), {});
  for (const renderer::Frame& frame : frames) {
    const double strongest_W = *std::max_element(frame.bscope_W.begin(), frame.bscope_W.end());
    std::printf("%zu cells, the strongest %.3g W%s\n", frame.bscope_W.size(), strongest_W,
                frame.events.empty() ? "" : ", outside the flight volume");
    if (!(strongest_W > 0.0 && strongest_W < 1.0)) return 1;
  }
  // What stands in each cell: here grass, seen under a grazing angle that falls with range.
  const renderer::LayerSet& truth = frames[0].layers->bscope;
  const std::size_t columns = static_cast<std::size_t>(opened->description.sensor.scan.columns);
  const std::size_t near = 100 * columns + columns / 2, far = 400 * columns + columns / 2;
  std::printf("%s, %.2f and %.2f deg\n",
              opened->world.geometry->material_names.at(truth.material[near]).c_str(),
              57.29578F * truth.grazing_rad[near], 57.29578F * truth.grazing_rad[far]);
  if (!(truth.grazing_rad[near] > truth.grazing_rad[far] && truth.grazing_rad[far] > 0.0F))
    return 1;

  // The scene's flight stands still: the poses above it are not what its plan was made for.
  return frames[0].events.empty() && !frames[2].events.empty() ? 0 : 1;
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}
