#include "scenes/object_names.h"

#include <utility>

namespace fanbeam::scenes {

ObjectNames::ObjectNames(std::filesystem::path file, double frequency_Hz)
    : file_(std::move(file)), frequency_Hz_(frequency_Hz) {}

const materials::TypicalObject* ObjectNames::find(core::ConfigTable& table, std::string_view key) {
  const std::string name = table.required_text(key);
  if (name.empty() || file_.empty()) return nullptr;
  core::ProblemList& problems = table.problems();
  if (!library_) library_ = materials::ObjectLibrary::from_file(file_, problems);
  const materials::TypicalObject* object =
      library_->find(name, table.place(key), table.path(key), problems);
  if (object != nullptr && frequency_Hz_ > 0.0 && checked_.insert(name).second)
    materials::warn_if_extrapolated(*object, frequency_Hz_, problems);
  return object;
}

}  // namespace fanbeam::scenes
