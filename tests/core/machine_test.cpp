#include "core/machine.h"

#include <catch2/catch.hpp>
#include <set>

using namespace fanbeam;

TEST_CASE("The instruction level is one that hot functions are compiled for", "[machine]") {
  CHECK(std::set<std::string>{"x86-64", "x86-64-v3", "x86-64-v4"}.count(
            core::instruction_level()) == 1);
}

TEST_CASE("The processor has a name", "[machine]") { CHECK_FALSE(core::processor_name().empty()); }
