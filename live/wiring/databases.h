// Other scenes that a CIGI host may switch to, by the numbers of [[database]] in the scene that was
// opened; that one is number 1. A scene is opened beside the one that is flown.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/stop.h"
#include "scenes/description.h"
#include "session/session.h"

namespace fanbeam::live {

class Databases {
 public:
  // Opens a scene by the name or path that a command line takes. Throws InputError.
  using Opener = std::function<std::unique_ptr<session::Session>(const std::string& scene)>;
  Databases(const std::string& first_scene, const scenes::SceneDescription& first, Opener opener);
  ~Databases();  // stops what is being opened
  Databases(const Databases&) = delete;
  Databases& operator=(const Databases&) = delete;

  std::int8_t current() const { return current_; }
  // Besides the current one.
  std::vector<std::int8_t> others() const;

  // Call it each frame with the number that the host wants: begins to open that scene, and gives true
  // once it is open. Throws what opening it threw; asked again, it tries again.
  bool is_ready(std::int8_t wanted);
  // That scene, which is the current one from now on; null where none is ready.
  std::unique_ptr<session::Session> take();
  // The same, which is not the current one yet.
  const session::Session* ready() const { return ready_.get(); }

 private:
  Opener opener_;
  std::map<std::int8_t, std::string> scenes_;
  std::int8_t current_ = 1, opening_ = 0;
  core::StopSource leaving_;
  std::unique_ptr<session::Session> ready_;
  std::future<std::unique_ptr<session::Session>> future_;
};

}  // namespace fanbeam::live
