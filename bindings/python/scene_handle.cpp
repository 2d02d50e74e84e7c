#include "bindings/python/scene_handle.h"

#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace fanbeam::bindings {
namespace {

// The first process that opened a scene: threads were started in it, which no child of a fork has.
std::atomic<pid_t> first_user{0};

[[noreturn]] void refuse_fork(pid_t opened_by) {
  throw std::runtime_error(
      "fanbeam was used in process " + std::to_string(opened_by) +
      ", of which this is a fork: its threads are not here. Start processes with "
      "multiprocessing.get_context(\"spawn\") or \"forkserver\".");
}

}  // namespace

void refuse_in_fork() {
  pid_t none = 0;
  if (!first_user.compare_exchange_strong(none, ::getpid()) && none != ::getpid())
    refuse_fork(none);
}

Scene::Scene(const std::filesystem::path& scene, const session::Setup& setup,
             core::ProblemList& problems)
    : session_(std::make_unique<session::Session>(scene, setup, problems)),
      opened_by_(::getpid()) {}

Scene::~Scene() {
  // Its threads are not here: what it holds is left to the end of the process.
  if (opened_by_ != ::getpid()) static_cast<void>(session_.release());
}

session::Session& Scene::session() const {
  if (opened_by_ != ::getpid()) refuse_fork(opened_by_);
  return *session_;
}

std::shared_ptr<const session::Labeller> Scene::labeller(
    const std::shared_ptr<const scenes::Scene>& scene) const {
  const std::lock_guard<std::mutex> lock(labelling_);
  if (labelled_ != scene) {
    labeller_ = std::make_shared<const session::Labeller>(*scene);
    labelled_ = scene;
  }
  return labeller_;
}

}  // namespace fanbeam::bindings
