// Triangles that lie in each other (T08): what the loader removed from a mesh, and what two bodies
// share corner by corner, as the ray caster keeps it. Point targets that do: as told on building.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>
#include <map>
#include <unordered_map>
#include <utility>

#include "scenes/doctor/parts_private.h"
#include "scenes/doctor/triangles_private.h"

namespace fanbeam::scenes {
namespace {

using Corner_m = std::array<float, 3>;
using Key = std::array<Corner_m, 3>;  // in order

struct KeyHash {
  std::size_t operator()(const Key& key) const noexcept {
    std::uint64_t hash = 0;
    for (const Corner_m& corner : key)
      for (const float value_m : corner) {
        // Both zeros are one coordinate.
        hash = (hash ^ std::bit_cast<std::uint32_t>(value_m + 0.0F)) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 32;
      }
    return static_cast<std::size_t>(hash);
  }
};

Corner_m as_kept(const DoctorParts& parts, const glm::dvec3& point_m) {
  const glm::dvec3 at_m = parts.in_caster_m(point_m);
  return {static_cast<float>(at_m.x), static_cast<float>(at_m.y), static_cast<float>(at_m.z)};
}

struct Bounds {
  glm::vec3 low_m{1e30F}, high_m{-1e30F};

  void hold(const Corner_m& corner) {
    const glm::vec3 point_m(corner[0], corner[1], corner[2]);
    low_m = glm::min(low_m, point_m);
    high_m = glm::max(high_m, point_m);
  }
  bool empty() const { return low_m.x > high_m.x || low_m.y > high_m.y || low_m.z > high_m.z; }
  bool holds(const Corner_m& corner) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float value_m = corner[static_cast<std::size_t>(axis)];
      if (value_m < low_m[axis] || value_m > high_m[axis]) return false;
    }
    return true;
  }
};

// By body: the space where another body may share a triangle with it.
std::vector<Bounds> meeting_places(const DoctorParts& parts) {
  std::vector<Bounds> bounds(parts.bodies.size()), meetings(parts.bodies.size());
  std::vector<std::size_t> from_west;
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    for (const glm::dvec3& vertex : parts.bodies[b].placed.mesh.vertices_m)
      bounds[b].hold(as_kept(parts, vertex));
    if (!bounds[b].empty()) from_west.push_back(b);
  }
  std::sort(from_west.begin(), from_west.end(),
            [&](std::size_t a, std::size_t b) { return bounds[a].low_m.x < bounds[b].low_m.x; });
  for (std::size_t i = 0; i < from_west.size(); ++i)
    for (std::size_t j = i + 1; j < from_west.size(); ++j) {
      const std::size_t a = from_west[i], b = from_west[j];
      if (bounds[b].low_m.x > bounds[a].high_m.x) break;
      const Bounds common{glm::max(bounds[a].low_m, bounds[b].low_m),
                          glm::min(bounds[a].high_m, bounds[b].high_m)};
      if (common.empty()) continue;
      for (const std::size_t body : {a, b}) {
        meetings[body].low_m = glm::min(meetings[body].low_m, common.low_m);
        meetings[body].high_m = glm::max(meetings[body].high_m, common.high_m);
      }
    }
  return meetings;
}

// Triangles of one body that lie in those of another.
struct Shared {
  std::size_t count = 0, differing = 0;  // in material
  glm::dvec3 where_m{0.0};
};
using SharedByBodies = std::map<std::pair<std::size_t, std::size_t>, Shared>;

SharedByBodies shared_triangles(const DoctorParts& parts) {
  struct First {
    std::size_t body = 0;
    terrain::MaterialId material = 0;
  };
  const std::vector<Bounds> meetings = meeting_places(parts);
  std::unordered_map<Key, First, KeyHash> seen;
  SharedByBodies shared;
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    if (meetings[b].empty()) continue;
    const terrain::PlacedMesh& placed = parts.bodies[b].placed;
    for_triangles(placed.mesh, [&](std::size_t i, const Corners& corners) {
      Key key{};
      for (std::size_t c = 0; c < 3; ++c) {
        key[c] = as_kept(parts, corners[c]);
        if (!meetings[b].holds(key[c])) return;
      }
      std::sort(key.begin(), key.end());
      const terrain::MaterialId material =
          placed.material_of_name.at(placed.mesh.triangle_material[i]);
      const auto [at, is_new] = seen.try_emplace(key, First{b, material});
      if (is_new || at->second.body == b) return;  // two sides of a sheet share their corners
      Shared& pair = shared[{at->second.body, b}];
      if (pair.count++ == 0) pair.where_m = corners[0];
      if (at->second.material != material) ++pair.differing;
    });
  }
  return shared;
}

void tell_removed(const DoctorParts& parts, Findings& findings) {
  for (const core::Problem& problem : parts.warnings)
    if (problem.code == "W-DEGENERATE")
      findings.push_back(
          {Severity::note, "degenerate-triangles",
           "removed on loading: " + problem.value + ", " + problem.field, place_text(problem.place),
           std::strtod(problem.value.c_str(), nullptr), "",
           "They have no direction or lie in each other; left in, they would make NaN or chance.",
           "Nothing has to be done; clean the model if the number is a surprise."});
}

}  // namespace

void check_duplicates(const DoctorParts& parts, Findings& findings) {
  tell_removed(parts, findings);
  for (const core::Problem& problem : parts.warnings)
    if (problem.code == "W-DUPLICATE")
      findings.push_back({Severity::delicate, "duplicate-targets", problem.value,
                          place_text(problem.place), 10.0 * std::log10(2.0), "dB",
                          "Both echo: the picture shows them brighter by this much than one.",
                          "Remove one of the two, unless two things stand there."});
  for (const auto& [pair, found] : shared_triangles(parts))
    findings.push_back(
        {found.differing > 0 ? Severity::wrong : Severity::note, "duplicate-triangles",
         std::to_string(found.count) + " triangles lie exactly in those of " +
             parts.bodies[pair.first].name +
             (found.differing > 0
                  ? ", " + std::to_string(found.differing) + " with another material"
                  : ", all of the same material"),
         parts.bodies[pair.second].name + ", " + place_text(parts.scene, found.where_m),
         static_cast<double>(found.count), "",
         found.differing > 0 ? "Which of the two a ray meets is chance, and with it the material."
                             : "The picture is the same, each ray just takes longer.",
         "Remove one of the two objects."});
}

}  // namespace fanbeam::scenes
