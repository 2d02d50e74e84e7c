// Expecting a certain class of input error.
#pragma once

#include <catch2/catch.hpp>

#include "core/errors.h"

namespace fanbeam::tests {

// True when the call throws an InputError of this class.
template <class Call>
bool refuses(Call&& call, core::ErrorClass error_class) {
  try {
    call();
  } catch (const core::InputError& error) {
    UNSCOPED_INFO(error.what());
    return error.has(error_class);
  }
  return false;
}

}  // namespace fanbeam::tests
