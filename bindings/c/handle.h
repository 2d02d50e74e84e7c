// What the handles of fanbeam.h hold.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "bindings/c/background_renderer.h"
#include "bindings/c/convert.h"
#include "bindings/c/fanbeam.h"
#include "core/errors.h"
#include "core/stop.h"
#include "renderer/stages/frame_layers.h"
#include "session/session.h"

struct fanbeam_session {
  fanbeam_session(const std::filesystem::path& scene, const fanbeam::session::Setup& setup,
                  fanbeam::core::ProblemList& problems)
      : held(scene, setup, problems),
        shape(fanbeam::bindings::shape_of(held.scene()->description.sensor)),
        shows_cscope(setup.build.heights_shown),
        background(held, stop) {}

  fanbeam::session::Session held;
  const fanbeam::bindings::Shape shape;
  const bool shows_cscope;
  fanbeam::core::StopSource stop;

  // A change here is made of what was set before: one after the other.
  std::mutex changing;
  std::vector<fanbeam::session::TargetState> targets;

  // Last: its thread ends before what it uses goes.
  fanbeam::bindings::BackgroundRenderer background;
};

struct fanbeam_layers {
  fanbeam::renderer::FrameLayers layers;
  fanbeam::bindings::Shape shape;
  bool with_cscope = false;
  // Knows the names of materials, objects and targets of that frame.
  std::shared_ptr<const fanbeam::scenes::Scene> scene;
};
