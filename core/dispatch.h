// Hot functions are compiled for three levels of x86-64, and each call takes the version for
// instruction_level() (machine.h): the machine's level or the limit that was set. Results do not
// depend on the level: contraction into fused multiply-add is off everywhere. Sanitizers would look
// at three copies of the same code, so there, and on other processors, one plain version runs.
//
//   FANBEAM_HOT(void, scale, (double* values, int count, double by), (values, count, by)) {
//     for (int i = 0; i < count; ++i) values[i] *= by;
//   }
//
// defines `void scale(double* values, int count, double by)`. Whatever the body calls is inlined
// into it, so that the callees are compiled for its level too (by Clang 14 only what it inlines by
// itself).
#pragma once

#include "core/machine.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__x86_64__)
#define FANBEAM_ONE_LEVEL
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FANBEAM_ONE_LEVEL
#endif
#endif

#if defined(FANBEAM_ONE_LEVEL)
#define FANBEAM_HOT(Result, name, parameters, arguments) Result name parameters
#else

#if defined(__clang__)
#define FANBEAM_FOR_LEVEL(level) __attribute__((target("arch=x86-64-" level)))
#else
#define FANBEAM_FOR_LEVEL(level) __attribute__((target("arch=x86-64-" level), flatten))
#endif

#define FANBEAM_HOT(Result, name, parameters, arguments)                                       \
  static inline __attribute__((always_inline)) Result name##_body parameters;                  \
  FANBEAM_FOR_LEVEL("v4") static Result name##_v4 parameters { return name##_body arguments; } \
  FANBEAM_FOR_LEVEL("v3") static Result name##_v3 parameters { return name##_body arguments; } \
  FANBEAM_FOR_LEVEL("v2") static Result name##_v2 parameters { return name##_body arguments; } \
  Result name parameters {                                                                     \
    switch (::fanbeam::core::instruction_level()) {                                            \
      case ::fanbeam::core::InstructionLevel::v4:                                              \
        return name##_v4 arguments;                                                            \
      case ::fanbeam::core::InstructionLevel::v3:                                              \
        return name##_v3 arguments;                                                            \
      default:                                                                                 \
        return name##_v2 arguments;                                                            \
    }                                                                                          \
  }                                                                                            \
  static inline Result name##_body parameters
#endif
