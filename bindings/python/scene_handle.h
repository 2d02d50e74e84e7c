// A scene held open for Python.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <mutex>

#include "core/errors.h"
#include "session/labels/frame_labels.h"
#include "session/session.h"

namespace fanbeam::bindings {

class Scene {
 public:
  // Warnings stay in `problems`.
  Scene(const std::filesystem::path& scene, const session::Setup& setup,
        core::ProblemList& problems);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // Throws std::runtime_error (RuntimeError) in a process forked from the one that opened it: the
  // threads that it renders with are not there.
  session::Session& session() const;
  // Of a scene that the session gave; made anew when the conditions have changed.
  std::shared_ptr<const session::Labeller> labeller(
      const std::shared_ptr<const scenes::Scene>& scene) const;

 private:
  mutable std::mutex labelling_;
  mutable std::shared_ptr<const scenes::Scene> labelled_;
  mutable std::shared_ptr<const session::Labeller> labeller_;
  std::unique_ptr<session::Session> session_;
  pid_t opened_by_;
};

// To be called before anything starts threads. Throws as Scene::session.
void refuse_in_fork();

}  // namespace fanbeam::bindings
