#include "renderer/casting/profile/slice_scene.h"

#include <cmath>

#include "core/errors.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/profile/slice_exclusion.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

// A tilted antenna looks anywhere.
constexpr double kSteepest = 1e9;

}  // namespace

SliceScene::SliceScene(const World& world)
    : world_(world), rings_(plan_rings(world)), tables_(world), path_loss_(world) {
  if (world.surfaces().terrain() == nullptr)
    throw core::InternalError("slices without a ground to cut");
}

// Tangent of the elevation below which nothing comes back.
double SliceScene::dark_below(const sensors::AntennaFrame& antenna) const {
  if (!azimuths_are_upright(antenna, world_.sensor.scan.surface)) return -kSteepest;
  const sensors::Antenna& beams = world_.sensor.antenna;
  const double lowest_rad =
      std::max(beams.boresight_elevation_rad - sensors::reach_rad(beams.elevation) - kLeaning_rad,
               -std::atan(kSteepest));
  return std::tan(lowest_rad);
}

}  // namespace fanbeam::renderer
