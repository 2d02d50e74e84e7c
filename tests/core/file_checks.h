// What a call that reads or writes is refused with, and what it leaves.
#pragma once

#include <filesystem>
#include <functional>
#include <iterator>
#include <string>

#include "core/errors.h"

namespace fanbeam::tests {

inline std::string code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.problems().at(0).code;
  }
  return "accepted";
}

inline std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

}  // namespace fanbeam::tests
