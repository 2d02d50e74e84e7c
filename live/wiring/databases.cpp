#include "live/wiring/databases.h"

#include <chrono>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace fanbeam::live {
namespace {

// A scene beside that of the list, or one that is shipped.
std::string scene_named(const std::string& name, const std::filesystem::path& folder) {
  const std::filesystem::path beside = folder.parent_path() / name;
  std::error_code refused;
  return std::filesystem::exists(beside / "scene.toml", refused) ? beside.string() : name;
}

}  // namespace

Databases::Databases(const std::string& first_scene, const scenes::SceneDescription& first,
                     Opener opener)
    : opener_(std::move(opener)) {
  scenes_[current_] = first_scene;
  for (const scenes::DatabaseDescription& one : first.databases)
    scenes_[static_cast<std::int8_t>(one.number)] = scene_named(one.scene, first.folder);
}

Databases::~Databases() { leaving_.request(); }

std::vector<std::int8_t> Databases::others() const {
  std::vector<std::int8_t> numbers;
  for (const auto& [number, scene] : scenes_)
    if (number != current_) numbers.push_back(number);
  return numbers;
}

bool Databases::is_ready(std::int8_t wanted) {
  if (future_.valid()) {
    if (future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    try {
      ready_ = future_.get();
    } catch (const std::exception&) {
      if (opening_ == wanted) throw;
    }
  }
  if (ready_ && opening_ == wanted) return true;
  ready_.reset();  // the host has changed its mind
  if (wanted == current_ || !scenes_.contains(wanted)) return false;
  opening_ = wanted;
  future_ = std::async(std::launch::async, [this, scene = scenes_.at(wanted)] {
    const core::StopToken token = leaving_.token();
    const core::StopScope scope(token);
    return opener_(scene);
  });
  return false;
}

std::unique_ptr<session::Session> Databases::take() {
  if (ready_) current_ = opening_;
  return std::move(ready_);
}

}  // namespace fanbeam::live
