// The job that runs tests with floating-point traps (tests/fp_traps.h) would notice: a program that
// is told to fail does, in every thread, and what is no fault of ours passes.
#include "tests/fp_traps.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"

using namespace fanbeam;

namespace {

// volatile: the compiler must leave the work to the processor.
volatile double zero = 0.0, one = 1.0, near_largest = 1e308;
volatile double not_a_number = std::numeric_limits<double>::quiet_NaN();
volatile double last_result = 0.0;
volatile int whole = 0;
volatile bool truth = false;

const std::vector<std::pair<std::string, std::function<void()>>> kFaults = {
    {"invalid", [] { last_result = zero / zero; }},
    {"division by zero", [] { last_result = one / zero; }},
    {"overflow", [] { last_result = near_largest * 10.0; }},
    {"invalid", [] { last_result = std::log(-one); }},
    {"overflow", [] { last_result = std::exp(1000.0 * one); }},
    {"invalid", [] { whole = static_cast<int>(near_largest); }},
    {"invalid", [] { core::parallel_for(64, [](std::size_t) { last_result = zero / zero; }); }},
};

std::pair<bool, std::string> run_itself(const std::string& tag, int number) {
  const std::string command = "FANBEAM_FP_TRAPS=1 FANBEAM_FAULT=" + std::to_string(number) +
                              " '" FANBEAM_BINARY_DIR "/bin/test_core' '" + tag + "' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  std::array<char, 4096> chunk{};
  for (std::size_t count = 0; (count = fread(chunk.data(), 1, chunk.size(), pipe)) > 0;)
    output.append(chunk.data(), count);
  return {pclose(pipe) == 0, output};
}

}  // namespace

// The two that the test below runs in a process of their own; by themselves they do nothing.
TEST_CASE("makes the floating-point fault it is told to", "[fault]") {
  const char* const number = std::getenv("FANBEAM_FAULT");
  if (number != nullptr) kFaults.at(static_cast<std::size_t>(std::atoi(number))).second();
}

TEST_CASE("makes no floating-point fault", "[no_fault]") {
  if (std::getenv("FANBEAM_FAULT") == nullptr) return;
  REQUIRE(tests::fp_traps_are_set());
  truth = not_a_number >= 0.0;                      // how a check finds a NaN
  last_result = std::max(0.0, not_a_number + one);  // goes on quietly
  last_result = 1e-300 * (one * 1e-300);            // underflow is rounding
  last_result = std::numeric_limits<double>::infinity() * one;
  core::parallel_for(64, [](std::size_t) { truth = not_a_number < 1.0; });
}

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("Floating-point traps end a test at invalid, division by zero and overflow of ours",
          "[fp_traps]") {
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    const auto [passed, output] = run_itself("[fault]", static_cast<int>(i));
    INFO(i << ": " << output);
    CHECK_FALSE(passed);
    CHECK(output.find("floating-point trap: " + kFaults[i].first) != std::string::npos);
    CHECK(output.find("makes the floating-point fault") != std::string::npos);  // says which test
  }
  const auto [passed, output] = run_itself("[no_fault]", 0);
  INFO(output);
  CHECK(passed);
}
#endif
