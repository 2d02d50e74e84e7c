// The processor: its name, the instructions that hot functions may use on it, and a limit to them.
//
// Levels are those of the x86-64 psABI: v2 has SSE4.2, v3 AVX2 and fused multiply-add, v4 AVX-512
// (F, BW, CD, DQ, VL). A limit holds for the kernels of this program (dispatch.h) and for Embree
// (terrain/ray_scene.h). The C library and FFTW go on choosing for themselves.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>

namespace fanbeam::core {

enum class InstructionLevel { unknown, v2, v3, v4 };

// As the operating system calls it; "unknown" where it does not.
std::string processor_name();

// The highest level that this processor and its operating system have. Processors of another kind,
// and those before 2009, count as v2, which is where hot functions begin.
InstructionLevel machine_level();

// No function uses more than `level` from here on; no limit without one. Not while frames are
// rendered: a frame would mix two levels. Throws InputError E-UNSUPPORTED for `field` when the
// machine has less, with what it has.
void limit_instructions(std::optional<InstructionLevel> level, const std::string& field);

// What was last asked for, for records; absent without a limit.
std::optional<InstructionLevel> instruction_limit();

namespace detail {
inline constinit std::atomic<InstructionLevel> chosen_level{InstructionLevel::unknown};
InstructionLevel choose_level();
}  // namespace detail

// The level that hot functions run at: the limit, else the machine's.
inline InstructionLevel instruction_level() {
  const InstructionLevel level = detail::chosen_level.load(std::memory_order_relaxed);
  return level != InstructionLevel::unknown ? level : detail::choose_level();
}

// "v3", as options and records write it.
std::string_view short_name_of(InstructionLevel level);
// "x86-64-v3", as measurements write it.
std::string name_of(InstructionLevel level);
// Of a short name; absent for anything else.
std::optional<InstructionLevel> instruction_level_named(std::string_view short_name);

}  // namespace fanbeam::core
