// The aircraft's way (T13), and the accuracy asked for.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "scenes/doctor/parts_private.h"
#include "sensors/display/grey_scale.h"
#include "terrain/polygon.h"

namespace fanbeam::scenes {
namespace {

// Sine of the depression of the nearest cell at which an error of height is one of range a hundred
// times as large.
constexpr double kLowSine = 0.01;
// RMS of what rounding to whole grey levels changes: 1 / sqrt(12).
constexpr double kRounding_grey = 0.28867513459481287;

// Where the antenna comes, from above.
struct Extent {
  glm::dvec2 low_m{1e300}, high_m{-1e300};

  void hold(const glm::dvec2& point_m) {
    low_m = glm::min(low_m, point_m);
    high_m = glm::max(high_m, point_m);
  }
  bool meets(const Extent& other) const {
    return low_m.x <= other.high_m.x && other.low_m.x <= high_m.x && low_m.y <= other.high_m.y &&
           other.low_m.y <= high_m.y;
  }
  bool holds(const glm::dvec2& point_m) const { return meets({point_m, point_m}); }
};

bool inside(const terrain::Solid& solid, const glm::dvec3& point_m) {
  if (point_m.z >= solid.top_m) return false;
  bool odd = false;
  for (const std::vector<glm::dvec2>& ring_m : solid.rings_m)
    if (terrain::crosses_odd(ring_m, point_m.x, point_m.y)) odd = !odd;
  return odd;
}

// By frame, whether a building holds the antenna. Most buildings of a town lie nowhere near the
// flight and cost one look at their outline.
std::vector<bool> frames_inside(const DoctorParts& parts) {
  std::vector<bool> within(parts.flight.size(), false);
  Extent flight;
  for (const Sight& sight : parts.flight) flight.hold(glm::dvec2(sight.antenna.position_m));
  for (const terrain::Solid& solid : parts.scene.world.solids().prisms) {
    Extent outline;
    for (const std::vector<glm::dvec2>& ring_m : solid.rings_m)
      for (const glm::dvec2& corner_m : ring_m) outline.hold(corner_m);
    if (!outline.meets(flight)) continue;
    for (std::size_t i = 0; i < parts.flight.size(); ++i) {
      const glm::dvec3& at_m = parts.flight[i].antenna.position_m;
      if (!within[i] && outline.holds(glm::dvec2(at_m))) within[i] = inside(solid, at_m);
    }
  }
  return within;
}

void check_solids(const DoctorParts& parts, Findings& findings) {
  const std::vector<bool> within = frames_inside(parts);
  const auto frames = std::count(within.begin(), within.end(), true);
  if (frames == 0) return;
  const auto first_index = std::find(within.begin(), within.end(), true) - within.begin();
  const Sight& first = parts.flight[static_cast<std::size_t>(first_index)];
  findings.push_back({Severity::wrong, "flight-through-building",
                      "the antenna is inside a building, first in frame " +
                          std::to_string(first.frame) + ", for this many frames",
                      place_text(parts.scene.description.trajectory.place) + ", trajectory, " +
                          place_text(parts.scene, first.antenna.position_m),
                      static_cast<double>(frames), "",
                      "Walls seen from inside hide all of the scene.",
                      "Move the building or the trajectory; check the building's height."});
}

}  // namespace

void check_flight_height(const DoctorParts& parts, Findings& findings) {
  if (parts.flight.empty()) return;
  const auto lowest = std::min_element(
      parts.flight.begin(), parts.flight.end(),
      [](const Sight& a, const Sight& b) { return a.above_ground_m < b.above_ground_m; });
  const double low_m = kLowSine * parts.sensor().range.minimum_m;
  // In the ground it cannot be: such a flight is refused when the scene is built.
  if (lowest->above_ground_m < low_m)
    findings.push_back(
        {Severity::delicate, "antenna-near-ground",
         "the antenna comes down to this height over the ground",
         place_text(parts.scene.description.trajectory.place) + ", trajectory, frame " +
             std::to_string(lowest->frame) + ", " +
             place_text(parts.scene, lowest->antenna.position_m),
         lowest->above_ground_m, "m",
         "Below " + core::number_text(low_m) +
             " m an error of the terrain's height moves even the nearest cell's ground a hundred "
             "times as far.",
         "End the trajectory earlier, or read the last frames as such."});
  check_solids(parts, findings);
}

void check_accuracy(const DoctorParts& parts, Findings& findings) {
  const double asked_grey = parts.scene.accuracy_grey;
  if (!(asked_grey > 0.0) || asked_grey >= kRounding_grey) return;
  const double grey_dB = sensors::GreyScale(parts.sensor()).dB_per_grey();
  findings.push_back({Severity::delicate, "accuracy-below-grey-step",
                      "the accuracy asked for, " + core::number_text(asked_grey) +
                          " grey levels, is finer than what rounding to whole levels alone changes",
                      "accuracy, one grey level being " +
                          core::number_text(std::round(1000.0 * grey_dB) / 1000.0) + " dB",
                      kRounding_grey, "grey levels",
                      "No picture can show it; time is spent on what rounding takes away.",
                      "Ask for 0.3 or more, or compare the power images, which are not rounded."});
}

}  // namespace fanbeam::scenes
