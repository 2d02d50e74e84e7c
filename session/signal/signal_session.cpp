#include "session/signal/signal_session.h"

#include <utility>

namespace fanbeam::session {

Setup signal_setup(scenes::BuildOptions build) {
  build.heights_shown = false;
  build.read.signals = true;
  return {.build = std::move(build), .sample = true, .pictures = false};
}

std::shared_ptr<const scenes::Scene> planned_for_signals(
    std::shared_ptr<const scenes::Scene> scene) {
  if (scene->description.sample && scene->options.read.signals) return scene;
  scenes::SceneSetting setting = *scene;
  setting.description.sample = true;
  setting.options.read.signals = true;
  core::ProblemList told;  // when the session was opened
  auto planned = scenes::settled(std::move(setting), scene->world.targets, told);
  planned->build_s = scene->build_s;
  return planned;
}

}  // namespace fanbeam::session
