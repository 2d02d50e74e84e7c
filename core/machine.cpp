#include "core/machine.h"

#include <fstream>

#include "core/errors.h"

namespace fanbeam::core {
namespace {

constexpr InstructionLevel kLevels[] = {InstructionLevel::v2, InstructionLevel::v3,
                                        InstructionLevel::v4};

constinit std::atomic<InstructionLevel> limit{InstructionLevel::unknown};

}  // namespace

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

InstructionLevel machine_level() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                  __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
  if (v3 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0)
    return InstructionLevel::v4;
  if (v3) return InstructionLevel::v3;
#endif
  return InstructionLevel::v2;
}

void limit_instructions(std::optional<InstructionLevel> level, const std::string& field) {
  const InstructionLevel machine = machine_level();
  if (level && *level > machine) {
    std::string has;
    for (const InstructionLevel known : kLevels)
      if (known <= machine) has += (has.empty() ? "" : ", ") + std::string(short_name_of(known));
    throw_input_error(ErrorClass::unsupported, field, std::string(short_name_of(*level)),
                      "what this machine has: " + has + " (" + processor_name() + ")");
  }
  limit = level.value_or(InstructionLevel::unknown);
  detail::chosen_level = level.value_or(machine);
}

std::optional<InstructionLevel> instruction_limit() {
  const InstructionLevel level = limit;
  return level == InstructionLevel::unknown ? std::nullopt : std::optional(level);
}

InstructionLevel detail::choose_level() {
  // A limit set meanwhile by another thread stays.
  InstructionLevel expected = InstructionLevel::unknown;
  chosen_level.compare_exchange_strong(expected, machine_level());
  return chosen_level;
}

std::string_view short_name_of(InstructionLevel level) {
  switch (level) {
    case InstructionLevel::v4:
      return "v4";
    case InstructionLevel::v3:
      return "v3";
    default:
      return "v2";
  }
}

std::string name_of(InstructionLevel level) {
  return "x86-64-" + std::string(short_name_of(level));
}

std::optional<InstructionLevel> instruction_level_named(std::string_view short_name) {
  for (const InstructionLevel level : kLevels)
    if (short_name == short_name_of(level)) return level;
  return std::nullopt;
}

}  // namespace fanbeam::core
