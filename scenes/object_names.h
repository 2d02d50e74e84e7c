// The typical objects that a scene names. Their library is read when the first name is looked up.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "core/config_table.h"
#include "materials/rcs/object_library.h"

namespace fanbeam::scenes {

class ObjectNames {
 public:
  // `frequency_Hz` of the sensor; 0 where there is none, then nothing is warned about.
  ObjectNames(std::filesystem::path file, double frequency_Hz);

  // The object that the text under `key` names, or nothing after E-REF. W-EXTRAPOLATED once for
  // each object that is not known at the frequency.
  const materials::TypicalObject* find(core::ConfigTable& table, std::string_view key);

  // The same for a name that stands in no key.
  const materials::TypicalObject* named(const std::string& name, const core::Place& place,
                                        core::ProblemList& problems);

  bool used() const { return library_.has_value(); }
  const std::filesystem::path& file() const { return file_; }

 private:
  const materials::TypicalObject* look_up(const std::string& name, const core::Place& place,
                                          const std::string& field, core::ProblemList& problems);

  std::filesystem::path file_;
  double frequency_Hz_ = 0.0;
  std::optional<materials::ObjectLibrary> library_;
  std::set<std::string> checked_;
};

}  // namespace fanbeam::scenes
