// What a refused input must look like.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "core/errors.h"

namespace fanbeam::tests {

// `call` must throw an InputError of exactly one problem with this class, whose text has `part`.
template <typename Call>
void check_rejected(Call call, core::ErrorClass error_class, const std::string& part) {
  try {
    call();
    FAIL("accepted; expected " << core::code(error_class) << " with '" << part << "'");
  } catch (const core::InputError& error) {
    CHECK(error.problems().size() == 1);
    CHECK(error.has(error_class));
    CHECK_THAT(error.what(), Catch::Contains(part));
  }
}

}  // namespace fanbeam::tests
