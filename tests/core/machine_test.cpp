#include "core/machine.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/dispatch.h"
#include "core/errors.h"

using namespace fanbeam;
using core::InstructionLevel;

namespace {

// Any work that a compiler vectorises.
FANBEAM_HOT(void, root_all, (double* values, int count), (values, count)) {
  for (int i = 0; i < count; ++i) values[i] = std::sqrt(values[i]) + 1.0 / values[i];
}

struct Unlimited {
  ~Unlimited() { core::limit_instructions(std::nullopt, ""); }
};

}  // namespace

TEST_CASE("Without a limit hot functions run at the machine's level", "[machine]") {
  CHECK(core::instruction_level() == core::machine_level());
  CHECK_FALSE(core::instruction_limit().has_value());
}

TEST_CASE("A limit holds until it is lifted, and results do not depend on it", "[machine]") {
  const Unlimited at_end;
  std::vector<double> first;
  for (const char* name : {"v2", "v3", "v4"}) {
    const InstructionLevel level = *core::instruction_level_named(name);
    if (level > core::machine_level()) continue;
    core::limit_instructions(level, "--isa");
    CHECK(core::instruction_level() == level);
    CHECK(core::instruction_limit() == level);
    CHECK(core::name_of(core::instruction_level()) == std::string("x86-64-") + name);
    std::vector<double> values;
    for (int i = 1; i < 1000; ++i) values.push_back(i * 0.37);
    root_all(values.data(), static_cast<int>(values.size()));
    if (first.empty()) first = values;
    CHECK(values == first);
  }
  core::limit_instructions(std::nullopt, "");
  CHECK(core::instruction_level() == core::machine_level());
}

TEST_CASE("A level that the machine lacks is refused with those that it has", "[machine]") {
  if (core::machine_level() == InstructionLevel::v4) return;
  const Unlimited at_end;
  try {
    core::limit_instructions(InstructionLevel::v4, "--isa");
    FAIL("took AVX-512 on a machine without it");
  } catch (const core::InputError& error) {
    REQUIRE(error.problems().size() == 1);
    const core::Problem& problem = error.problems().front();
    CHECK(problem.code == "E-UNSUPPORTED");
    CHECK(problem.field == "--isa");
    CHECK(problem.value == "v4");
    CHECK(problem.expected.find("v2") != std::string::npos);
    CHECK(problem.expected.find(core::processor_name()) != std::string::npos);
  }
  CHECK_FALSE(core::instruction_limit().has_value());
}

TEST_CASE("Only levels that exist have names", "[machine]") {
  CHECK(core::instruction_level_named("v3") == InstructionLevel::v3);
  for (const char* name : {"", "v1", "v5", "V3", "x86-64-v3", "unknown"})
    CHECK_FALSE(core::instruction_level_named(name).has_value());
}

TEST_CASE("The processor has a name", "[machine]") { CHECK_FALSE(core::processor_name().empty()); }
