// Another project's program: opens a scene, renders one frame, and looks at the watts.
//
//   consumer SHIPPED SCENE
//
// SHIPPED is the folder with scenes/, sensors/ and materials/ (share/fanbeam below the prefix).
#include <algorithm>
#include <cstdio>

#include "core/image.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "sensors/display/display.h"

using namespace fanbeam;

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const std::filesystem::path shipped = argv[1];
  core::ProblemList problems;  // everything wrong at once, with file, line and column

  // Seconds: terrain, buildings, Embree's tree.
  const scenes::SceneDescription description =
      scenes::read_scene(shipped / "scenes" / argv[2], {shipped, {}, {}}, problems);
  const auto scene = scenes::build_scene(description, {}, problems);

  // Milliseconds: a frame of the flight, or scene->pose_at(any pose). Thread-safe.
  const renderer::FrameRenderer frames(scene->world, renderer::sampling_for(4.0), {},
                                       renderer::effects_of(scene->plan, 0));
  const renderer::Frame frame = frames.render(scene->frame_pose(0));

  core::write_png("bscope.png", sensors::bscope_picture(description.sensor, frame.bscope_grey), {});
  const double strongest_W = *std::max_element(frame.bscope_W.begin(), frame.bscope_W.end());
  std::printf("%zu cells, the strongest %.3g W\n", frame.bscope_W.size(), strongest_W);
  return strongest_W > 0.0 && strongest_W < 1.0 ? 0 : 1;
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}
