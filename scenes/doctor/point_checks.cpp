// Point targets: below the ground (T13), and wires in pieces too long (R09).
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <utility>
#include <variant>

#include "scenes/doctor/parts_private.h"

namespace fanbeam::scenes {
namespace {

constexpr double kBelow_m = 0.01;
constexpr int kPartsOfLeg = 8;

struct Depth {
  double deepest_m = 0.0, shallowest_m = 1e300;
  glm::dvec3 where_m{0.0};
};

// How far below the ground a point comes on its way.
Depth depth_of(const renderer::PointTarget& target, const terrain::HeightField& field) {
  Depth depth;
  const auto look = [&](const glm::dvec3& at_m) {
    const auto ground_m = field.height_at(at_m.x, at_m.y);
    const double below_m = ground_m ? *ground_m - at_m.z : 0.0;
    depth.shallowest_m = std::min(depth.shallowest_m, below_m);
    if (below_m <= depth.deepest_m) return;
    depth.deepest_m = below_m;
    depth.where_m = at_m;
  };
  for (std::size_t i = 0; i < target.path.size(); ++i) {
    look(target.path[i].position_m);
    if (i + 1 < target.path.size())
      for (int k = 1; k < kPartsOfLeg; ++k)
        look(glm::mix(target.path[i].position_m, target.path[i + 1].position_m,
                      static_cast<double>(k) / kPartsOfLeg));
  }
  return depth;
}

struct Buried {
  std::size_t points = 0, below = 0;
  double deepest_m = 0.0;
  glm::dvec3 where_m{0.0};
};

void add(const Depth& depth, Buried& buried) {
  ++buried.points;
  if (depth.deepest_m <= kBelow_m) return;
  if (depth.shallowest_m > kBelow_m) ++buried.below;
  if (depth.deepest_m <= buried.deepest_m) return;
  buried.deepest_m = depth.deepest_m;
  buried.where_m = depth.where_m;
}

// Of the radar's sights the nearest to a point of the group.
struct Nearest {
  double range_m = 1e300;
  glm::dvec3 where_m{0.0};
};

Nearest nearest_sight(const DoctorParts& parts, const PointGroup& group) {
  Nearest nearest;
  for (std::size_t i = group.begin; i < group.end; ++i) {
    const glm::dvec3& at_m = parts.scene.world.targets[i].path.front().position_m;
    for (const Sight& sight : parts.sights) {
      const double range_m = range_in_view_m(parts, sight, at_m);
      if (range_m > 0.0 && range_m < nearest.range_m) nearest = {range_m, at_m};
    }
  }
  return nearest;
}

}  // namespace

void check_targets(const DoctorParts& parts, Findings& findings) {
  // A line is one thing; targets, lights and posts of one name are told as one.
  std::map<std::pair<std::string, int>, Buried> all;
  for (const PointGroup& group : parts.point_groups) {
    Buried& buried = all[{group.name, group.is_line ? group.place.line : 0}];
    for (std::size_t i = group.begin; i < group.end; ++i)
      add(depth_of(parts.scene.world.targets[i], parts.ground.field()), buried);
  }
  for (const auto& [name, buried] : all) {
    if (!(buried.deepest_m > 0.0)) continue;
    const bool whole = buried.below == buried.points;
    findings.push_back(
        {whole ? Severity::wrong : Severity::delicate, "target-below-ground",
         (whole
              ? "every point of it lies"
              : "of " + std::to_string(buried.points) + " points " + std::to_string(buried.below) +
                    " lie always, others on a part of their way,") +
             std::string(" below the ground, the deepest by this much"),
         "\"" + name.first + "\", " + place_text(parts.scene, buried.where_m), buried.deepest_m,
         "m", "The ground hides it, and a straight line between two ends does not follow a hill.",
         "Raise it with above_ground_m, or put more waypoints or shorter lines over the hill."});
  }
}

void check_wires(const DoctorParts& parts, Findings& findings) {
  const double wavelength_m = parts.sensor().wavelength_m();
  for (const PointGroup& group : parts.point_groups) {
    // All pieces of a line are alike.
    const auto* wire =
        std::get_if<materials::RoundWire>(&parts.scene.world.targets[group.begin].rcs);
    if (!group.is_line || wire == nullptr) continue;
    const double coherence_m =
        wire->coherence_length_m > 0.0 ? wire->coherence_length_m : wire->length_m;
    const double limit_m = 2.0 * coherence_m * wire->length_m / wavelength_m;
    const Nearest nearest = nearest_sight(parts, group);
    if (!(nearest.range_m < limit_m)) continue;
    findings.push_back(
        {Severity::delicate, "wire-pieces-too-long",
         "its pieces are steady only beyond this range, and it is seen from " +
             core::number_text(std::round(nearest.range_m)) + " m",
         place_text(group.place) + ", line \"" + group.name + "\", " +
             place_text(parts.scene, nearest.where_m),
         limit_m, "m",
         "Nearer, the flash of a piece is narrower than the angle between two pieces, and the wire "
         "flickers.",
         "Take a smaller spacing_m: the range is 2 coherence_length_m spacing_m / wavelength."});
  }
}

}  // namespace fanbeam::scenes
