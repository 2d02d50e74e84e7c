// A small scene with a runway, for what flies over it.
#pragma once

#include <memory>

#include "session/session.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

// Planned for the air over its terrain.
inline std::unique_ptr<session::Session> live_session(const TemporaryFolder& folder,
                                                      const std::string& text = kSmallScene) {
  folder.write("scene.toml", text);
  core::ProblemList problems;
  scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  description.flight_heights.stated = true;
  auto session = std::make_unique<session::Session>(description, session::Setup{}, problems);
  session->set(session::Samples{1.0});
  return session;
}

}  // namespace fanbeam::tests
