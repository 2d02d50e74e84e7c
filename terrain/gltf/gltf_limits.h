// How much a glTF file may ask for. Every limit is checked before memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fanbeam::terrain {

// The .gltf or .glb file itself.
inline constexpr std::uint64_t kLargestGltfFile_bytes = std::uint64_t{256} << 20;
// All buffers of one file together.
inline constexpr std::uint64_t kLargestGltfBuffers_bytes = std::uint64_t{512} << 20;
// Nesting of the JSON text. The format itself needs fewer than ten levels; parsers recurse.
inline constexpr int kDeepestGltfJson = 64;
// Values in the JSON text; each costs a parser some hundred bytes.
inline constexpr std::size_t kMostGltfJsonValues = 4'000'000;
// Elements of an accessor without a buffer view: all zero but for sparse values, so that a few
// bytes may ask for any number of them.
inline constexpr std::size_t kMostGltfUnbackedElements = 1'000'000;
inline constexpr std::size_t kMostGltfNodes = 250'000;
// Of the scene when every node has its own copy of its mesh.
inline constexpr std::uint64_t kMostGltfVertices = 10'000'000;
inline constexpr std::uint64_t kMostGltfTriangles = 20'000'000;

}  // namespace fanbeam::terrain
