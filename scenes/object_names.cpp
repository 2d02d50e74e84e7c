#include "scenes/object_names.h"

#include <utility>

namespace fanbeam::scenes {

ObjectNames::ObjectNames(std::filesystem::path file, double frequency_Hz)
    : file_(std::move(file)), frequency_Hz_(frequency_Hz) {}

const materials::TypicalObject* ObjectNames::find(core::ConfigTable& table, std::string_view key) {
  const std::string name = table.required_text(key);
  if (name.empty() || file_.empty()) return nullptr;
  return look_up(name, table.place(key), table.path(key), table.problems());
}

const materials::TypicalObject* ObjectNames::named(const std::string& name,
                                                   const core::Place& place,
                                                   core::ProblemList& problems) {
  return file_.empty() ? nullptr : look_up(name, place, "rcs", problems);
}

const materials::TypicalObject* ObjectNames::look_up(const std::string& name,
                                                     const core::Place& place,
                                                     const std::string& field,
                                                     core::ProblemList& problems) {
  if (!library_) library_ = materials::ObjectLibrary::from_file(file_, problems);
  const materials::TypicalObject* object = library_->find(name, place, field, problems);
  if (object != nullptr && frequency_Hz_ > 0.0 && checked_.insert(name).second)
    materials::warn_if_extrapolated(*object, frequency_Hz_, problems);
  return object;
}

}  // namespace fanbeam::scenes
