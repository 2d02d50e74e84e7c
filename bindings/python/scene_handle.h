// A scene held open for Python.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>

#include "core/errors.h"
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

 private:
  std::unique_ptr<session::Session> session_;
  pid_t opened_by_;
};

// To be called before anything starts threads. Throws as Scene::session.
void refuse_in_fork();

}  // namespace fanbeam::bindings
