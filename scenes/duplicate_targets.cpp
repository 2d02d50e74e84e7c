#include "scenes/duplicate_targets.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/matrix.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/units.h"

namespace fanbeam::scenes {
namespace {

using renderer::PointTarget;

constexpr double kSamePlace_m = 1e-3;
constexpr int kAzimuths = 16;
// A radar looks at things on the ground from the level to some ten degrees above.
constexpr double kElevations_deg[] = {0.0, 3.0, 30.0};

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const noexcept {
    std::uint64_t hash = 0;
    for (const std::int64_t number : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32U;
    }
    return static_cast<std::size_t>(hash);
  }
};

Cell cell_of(const glm::dvec3& position_m) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] = std::llround(position_m[axis] / kSamePlace_m);
  return cell;
}

// Equal for targets that echo alike from the same places.
std::vector<std::int64_t> signature_of(const PointTarget& target, double wavelength_m) {
  std::vector<std::int64_t> signature;
  for (const PointTarget::Waypoint& waypoint : target.path) {
    signature.push_back(std::llround(waypoint.time_s * 1e3));
    for (const std::int64_t number : cell_of(waypoint.position_m)) signature.push_back(number);
  }
  const glm::dmat3 into_target = glm::transpose(target.axes);
  for (const double elevation_deg : kElevations_deg)
    for (int k = 0; k < kAzimuths; ++k) {
      const double azimuth_rad = 2.0 * core::kPi * (k + 0.5) / kAzimuths;
      const double elevation_rad = core::radians(elevation_deg);
      const glm::dvec3 direction(std::cos(elevation_rad) * std::sin(azimuth_rad),
                                 std::cos(elevation_rad) * std::cos(azimuth_rad),
                                 std::sin(elevation_rad));
      // In float, as turning the axes by 360 deg leaves the last digits different; both zeros are
      // one.
      const auto rcs =
          static_cast<float>(materials::rcs_m2(target.rcs, into_target * direction, wavelength_m));
      signature.push_back(std::bit_cast<std::int32_t>(rcs + 0.0F));
    }
  return signature;
}

class Duplicates {
 public:
  explicit Duplicates(const PointTargets& targets, double wavelength_m)
      : targets_(targets), wavelength_m_(wavelength_m) {
    find_shared_cells();
    std::map<std::vector<std::int64_t>, std::size_t> group_of_signature;
    for (std::size_t g = 0; g < targets_.groups.size(); ++g)
      for (std::size_t i = targets_.groups[g].begin; i < targets_.groups[g].end; ++i) {
        const PointTarget& target = targets_.points[i];
        if (!cells_.at(cell_of(target.path.front().position_m)).shared) continue;
        const auto [first, is_new] =
            group_of_signature.try_emplace(signature_of(target, wavelength_m_), g);
        if (!is_new && first->second != g) ++points_[{g, first->second}];
      }
  }

  // Points by the later object and the earlier one.
  const std::map<std::pair<std::size_t, std::size_t>, std::size_t>& points() const {
    return points_;
  }

 private:
  // Most points are alone where they are, and need no closer look.
  void find_shared_cells() {
    cells_.reserve(targets_.points.size());
    for (std::size_t g = 0; g < targets_.groups.size(); ++g)
      for (std::size_t i = targets_.groups[g].begin; i < targets_.groups[g].end; ++i) {
        const Cell cell = cell_of(targets_.points[i].path.front().position_m);
        const auto [known, is_new] = cells_.try_emplace(cell, Owner{g, false});
        if (!is_new && known->second.group != g) known->second.shared = true;
      }
  }

  struct Owner {
    std::size_t group = 0;
    bool shared = false;
  };

  const PointTargets& targets_;
  double wavelength_m_;
  std::unordered_map<Cell, Owner, CellHash> cells_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> points_;
};

}  // namespace

void tell_duplicate_targets(const PointTargets& targets, double wavelength_m,
                            core::ProblemList& problems) {
  const Duplicates duplicates(targets, wavelength_m);
  for (const auto& [objects, count] : duplicates.points()) {
    const PointGroup& later = targets.groups[objects.first];
    const PointGroup& earlier = targets.groups[objects.second];
    const std::size_t size = later.end - later.begin;
    problems.warning(
        "DUPLICATE", later.place, later.is_line ? "line" : "target",
        (size > 1 ? std::to_string(count) + " of the " + std::to_string(size) + " points of "
                  : "") +
            "\"" + later.name + "\" at the place of \"" + earlier.name + "\" of line " +
            std::to_string(earlier.place.line) + ", with the same RCS",
        "both are kept, and two echo 3 dB more than one");
  }
}

}  // namespace fanbeam::scenes
