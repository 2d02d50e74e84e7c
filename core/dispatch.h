// Hot functions are compiled for three levels of x86-64 and the best one is chosen when the program
// starts. Results do not depend on the level: contraction into fused multiply-add is off
// everywhere. Sanitizers cannot look through the choice, so there the plain version runs.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__x86_64__)
#define FANBEAM_HOT
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FANBEAM_HOT
#endif
#endif
#ifndef FANBEAM_HOT
#define FANBEAM_HOT __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif

// Inlines whatever a hot function calls into it, so that the callees are compiled for its level
// too. Clang 14 does not combine the two: there only what it inlines by itself is.
#if defined(__clang__)
#define FANBEAM_INLINE_ALL
#else
#define FANBEAM_INLINE_ALL __attribute__((flatten))
#endif
