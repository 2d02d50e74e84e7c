// Counter-based random numbers: a draw is a pure function of (seed, stream, frame, cell, draw), so
// pictures do not depend on threads or on the order of frames.
//
// Philox 4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC'11) from the
// Random123 package.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace fanbeam::core {

// Names one independent sequence of draws.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t stream = 0;  // what the numbers are for; each use has its own
  std::uint64_t frame = 0;
};

inline constexpr std::uint32_t kStreamTurbulence = 1;
inline constexpr std::uint32_t kStreamTerrain = 2;
inline constexpr std::uint32_t kStreamReferenceJitter = 3;
inline constexpr std::uint32_t kStreamSpeckle = 4;
inline constexpr std::uint32_t kStreamCscopeSpeckle = 5;
inline constexpr std::uint32_t kStreamTarget = 6;  // phases and fluctuation
inline constexpr std::uint32_t kStreamReceiverNoise = 7;
inline constexpr std::uint32_t kStreamPhaseNoise = 8;
inline constexpr std::uint32_t kStreamCfarCalibration = 9;
inline constexpr std::uint32_t kStreamCampaign = 11;        // values of runs
inline constexpr std::uint32_t kStreamCampaignFlight = 12;  // how their flights wander
inline constexpr std::uint32_t kStreamHighway = 20;         // measurements of road scenarios
inline constexpr std::uint32_t kStreamFrameEcho = 10;       // places and phases of scatterers

// The key that Philox gets of seed, stream and the upper half of the frame; the counter gets cell,
// draw and the lower half. For one seed, no two pairs of a stream and an upper half share a key: the
// numbers of a session that runs for years never come back (2^32 frames are 8.5 years at 16 Hz).
constexpr std::array<std::uint32_t, 2> philox_key(const RandomKey& key) {
  const auto frame_high = static_cast<std::uint32_t>(key.frame >> 32U);
  return {static_cast<std::uint32_t>(key.seed) ^ (frame_high * 0x85EBCA6BU),
          static_cast<std::uint32_t>(key.seed >> 32U) ^ (key.stream * 0x9E3779B9U)};
}

// Four words for (cell, draw).
std::array<std::uint32_t, 4> random_words(const RandomKey& key, std::uint64_t cell,
                                          std::uint32_t draw);

// (word + 0.5) / 2^32: in the open interval (0, 1), so that its logarithm is finite.
constexpr double uniform_from(std::uint32_t word) {
  return (static_cast<double>(word) + 0.5) * 0x1p-32;
}

// Two independent standard normal numbers (Box-Muller).
std::array<double, 2> normal_pair(const RandomKey& key, std::uint64_t cell, std::uint32_t draw);

// Of each of the cells from `first` on the sum of `count` exponentials of mean 1, of draws 0, 1, ...,
// four to a draw; 1 to kMostExponentials, whose product of uniform numbers of at least 2^-33 stays
// above the smallest double, so that one logarithm does for all. Error: `count` times 1.2e-16 of the
// product's roundings, and 1e-15 of the sum.
inline constexpr int kMostExponentials = 28;
void sums_of_exponentials(const RandomKey& key, std::uint64_t first, int count,
                          std::span<double> sums);

}  // namespace fanbeam::core
